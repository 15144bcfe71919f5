#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/kinematics/orientation_fit.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/body/osim/osim_named_frames.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/body/osim/osim_updater.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/opensim/tool_stages.h"
#include "myoid/recording/recording.h"

namespace myoid::opensim {
namespace {

using recording::OrientationSeries;

/// Returns the rotation about the axes of ground, x first: R = Rz Ry Rx.
Mat3 sensor_to_ground(const OpensimSetup& setup) {
  const Vec3 angles = setup.xml().vec3(setup.tool(), "sensor_to_opensim_rotations", Vec3::Zero());
  return (Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

/// Returns the series in other axes of the laboratory: R_new = R R_old.
OrientationSeries turned(OrientationSeries series, const Mat3& R) {
  const Eigen::Quaterniond turn(R);
  for (Eigen::Index i = 0; i < series.quaternions.rows(); ++i) {
    for (Eigen::Index k = 0; k < series.quaternions.cols(); k += 4) {
      auto q = series.quaternions.block<1, 4>(i, k);
      const Eigen::Quaterniond product = turn * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
      q << product.w(), product.x(), product.y(), product.z();
    }
  }
  return series;
}

OrientationSeries rows_between(const OrientationSeries& series,
                               std::pair<double, double> range_s,
                               const OpensimSetup& setup) {
  constexpr double kRounding_s = 1e-9;  // of times in files
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < series.time_s.size(); ++i) {
    const double t = series.time_s[i];
    if (t >= range_s.first - kRounding_s && t <= range_s.second + kRounding_s) rows.push_back(i);
  }
  if (rows.empty()) setup.xml().fail(setup.tool(), "<time_range> holds no row of the orientations");
  return {series.time_s(rows), series.names, series.quaternions(rows, Eigen::all)};
}

/// Reads orientations; notes the repairs of the reader.
OrientationSeries orientations_of(const ToolRun& run, const std::filesystem::path& path) {
  OrientationSeries series = recording::read_orientations(path);
  for (const Repair& repair : series.repairs)
    run.result.remarks.push_back({.code = RemarkCode::reading, .says = recording::to_string(path, repair)});
  return series;
}

/// Returns the axis that a name like "-z" means.
Vec3 heading_axis(const OpensimSetup& setup, const std::string& name) {
  const char letter = name.empty() ? ' ' : static_cast<char>(name.back() | 0x20);
  if (letter < 'x' || letter > 'z') {
    setup.xml().fail(setup.tool(), "<base_heading_axis>: expected x, -x, y, -y, z or -z, found '{}'", name);
  }
  return (name.front() == '-' ? -1.0 : 1.0) * Vec3::Unit(letter - 'x');
}

/// Returns the rotation about the vertical by the angle between the heading of the base sensor and
/// the x axis of the body that stands on ground, as in OpenSim.
Mat3 heading_correction(const OpensimSetup& setup,
                        const body::BodyModel& model,
                        const body::BodyState& state,
                        const OrientationSeries& series) {
  const std::string label = setup.xml().word(setup.tool(), "base_imu_label");
  const std::string axis = setup.xml().word(setup.tool(), "base_heading_axis");
  if (label.empty() || axis.empty()) return Mat3::Identity();
  const auto place = std::find(series.names.begin(), series.names.end(), label);
  if (place == series.names.end()) {
    setup.xml().fail(setup.tool(), "<base_imu_label>: there is no sensor '{}'{}", label,
                     not_among(label, series.names));
  }
  const body::Joint* base = nullptr;
  for (const body::Joint& joint : model.joints) {
    if (joint.parent == 0 && (base == nullptr || joint.place_in_file < base->place_in_file)) base = &joint;
  }
  if (base == nullptr) setup.xml().fail(setup.tool(), "no body of the model stands on ground");
  const Vec3 heading =
      series.rotation(0, static_cast<std::size_t>(place - series.names.begin())) * heading_axis(setup, axis);
  const Vec3 forward = state.X_GB[at(base->child)].R.col(0);
  double angle = std::acos(std::clamp(heading.dot(forward), -1.0, 1.0));
  if (forward.cross(heading).y() > 0.0) angle = -angle;
  return Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
}

std::vector<body::SensorPlace> place_sensors(const ToolRun& run,
                                             const body::BodyModel& model,
                                             const body::BodyState& state,
                                             const OrientationSeries& series,
                                             const std::map<std::string, body::NamedFrame>& frames) {
  std::vector<body::SensorPlace> places;
  for (std::size_t k = 0; k < series.names.size(); ++k) {
    const std::string& name = series.names[k];
    const auto end = name.rfind("_imu");
    const auto frame = end == std::string::npos ? frames.end() : frames.find(name.substr(0, end));
    const Mat3 R = series.rotation(0, k);
    if (frame == frames.end() || !R.allFinite()) {
      run.note("sensor '{}' is not placed: {}", name,
               frame == frames.end() ? "expected the name of a body or frame and '_imu'"
                                     : "its first orientation is not known");
      continue;
    }
    const int body = *model.find_body(frame->second.body);
    const Mat3 R_GF = state.X_GB[at(body)].R * frame->second.X_BF.R;
    const bool on_body = frame->second.path.ends_with("/" + frame->second.body);
    places.push_back({name, frame->second, on_body ? model.bodies[at(body)].p_BBcm_B : Vec3(Vec3::Zero()),
                      Mat3(R_GF.transpose() * R).eulerAngles(0, 1, 2)});
  }
  return places;
}

struct Sensors {
  std::vector<body::SensorOnBody> on_bodies;
  std::vector<std::string> without_frame;
};

Sensors sensors_of(const OpensimSetup& setup,
                   const body::BodyModel& model,
                   const OrientationSeries& series,
                   const std::map<std::string, body::NamedFrame>& frames) {
  std::map<std::string, double> weights;
  auto set = setup.tool().child("orientation_weights");
  if (!set) set = setup.tool().child("OrientationWeightSet");
  if (const auto inner = set.child("OrientationWeightSet")) set = inner;
  for (const auto node : body::OsimXml::objects(set)) {
    const double weight = setup.xml().number(node, "weight", 1.0);
    if (!(weight >= 0.0)) setup.xml().fail(node, "<weight> {}, expected 0 or more", weight);
    weights[body::OsimXml::name_of(node)] = weight;
  }
  Sensors sensors;
  for (std::size_t k = 0; k < series.names.size(); ++k) {
    const auto frame = frames.find(series.names[k]);
    if (frame == frames.end()) {
      sensors.without_frame.push_back(series.names[k]);
      continue;
    }
    const auto weight = weights.find(series.names[k]);
    sensors.on_bodies.push_back({k, *model.find_body(frame->second.body), frame->second.X_BF.R,
                                 weight == weights.end() ? 1.0 : weight->second});
  }
  return sensors;
}

/// Returns the file that OpenSim's tool writes: the name of <output_motion_file> (or
/// "ik_<orientations>") in the results folder or, without one, in the folder of
/// <output_motion_file>.
std::filesystem::path motion_file(const OpensimSetup& setup, const std::filesystem::path& orientations) {
  const auto wanted = setup.output_file(setup.tool(), "output_motion_file");
  std::filesystem::path folder = setup.results_folder();
  if (!setup.output_file(setup.tool(), "results_directory") && wanted) folder = wanted->parent_path();
  const std::string name = wanted ? wanted->filename().string() : "ik_" + orientations.stem().string();
  return folder / (name.find('.') == std::string::npos ? name + ".mot" : name);
}

void note_fit(const ToolRun& run, const body::OrientationFit& fit) {
  if (!fit.open_coordinates.empty()) {
    run.note("the sensors do not determine {}; they stay where they are", fmt::join(fit.open_coordinates, ", "));
  }
  if (fit.frames_without_sensors > 0) {
    run.note("{} frames without any orientation keep the pose of the one before", fit.frames_without_sensors);
  }
}

}  // namespace

void run_imu_placer(const ToolRun& run) {
  const OpensimSetup& setup = run.setup;
  ToolResult& result = run.result;
  const auto tool = setup.tool();
  const auto model_path = setup.required_file(tool, "model_file");
  const auto named = setup.output_file(tool, "output_model_file");
  if (!named) setup.xml().fail(tool, "<output_model_file> expected: a file's name, relative to this set-up");
  const std::filesystem::path& out = *named;
  run.claim(out);
  const std::string old_text = read_text_file(model_path);
  const body::UpdatedOsim updated =
      body::updated_osim(old_text, model_path, {.six_digits = run.options.compat.six_digit_offsets});
  run.add_notes(updated.notes);
  const body::BodyModel model = body::parse_osim(updated.text, model_path, {.compat = run.options.compat});
  const auto orientations = setup.required_file(tool, "orientation_file_for_calibration");
  OrientationSeries series = turned(orientations_of(run, orientations), sensor_to_ground(setup));
  const body::BodyState state = default_state(model);
  series = turned(std::move(series), heading_correction(setup, model, state, series));
  const auto places = place_sensors(run, model, state, series, body::named_frames(updated.text, model_path));
  if (places.empty()) {
    setup.xml().fail(
        tool, "{}: no sensor is named after a body or frame of the model and '_imu' (as pelvis_imu); there are {}",
        orientations.string(), fmt::join(series.names, ", "));
  }
  write_file(out, body::with_sensors(updated.text, model_path, places));
  result.summary = fmt::format("{} sensors placed by their orientations at {} s", places.size(), series.time_s[0]);
  result.frames = 1;
}

void run_imu_inverse_kinematics(const ToolRun& run) {
  const OpensimSetup& setup = run.setup;
  ToolResult& result = run.result;
  const auto tool = setup.tool();
  const auto path = setup.required_file(tool, "orientations_file");
  const auto motion_path = motion_file(setup, path);
  auto errors_path = motion_path;
  const auto wanted = setup.output_file(tool, "output_motion_file");
  errors_path.replace_filename((wanted ? wanted->filename().string() : motion_path.stem().string()) +
                               "_orientationErrors.sto");
  const bool report_errors = setup.xml().flag(tool, "report_errors", true);
  run.claim(motion_path);
  if (report_errors) run.claim(errors_path);
  const body::BodyModel model = setup_model(setup, run.options.compat, {}, result.remarks);
  run.add_remarks(body::implausible(model), setup.required_file(tool, "model_file").string());
  OrientationSeries series = orientations_of(run, path);
  const auto range_s = setup.time_range(tool, "time_range");
  setup.check_range(range_s, series.time_s, path, result.remarks);
  series = turned(rows_between(series, range_s, setup), sensor_to_ground(setup));
  const auto model_path = setup.required_file(tool, "model_file");
  const Sensors sensors = sensors_of(setup, model, series, body::named_frames(read_text_file(model_path), model_path));
  if (sensors.on_bodies.empty()) {
    setup.xml().fail(tool, "{}: the model has no frame of the name of a sensor ({}); run IMUPlacer first",
                     path.string(), fmt::join(series.names, ", "));
  }
  if (!sensors.without_frame.empty()) {
    run.note("the model has no frame {}: these orientations do not count", fmt::join(sensors.without_frame, ", "));
  }
  const body::OrientationFit fit = body::fit_orientations(model, series, sensors.on_bodies, run.options.progress);
  note_fit(run, fit);
  run.add_remarks(body::implausible_motion(fit.q), path.string());
  write_opensim_storage(motion_path, with_file_units(model, fit.q),
                        {.title = motion_path.filename().string(), .in_degrees = true, .decimals = 12});
  if (report_errors) {
    write_opensim_storage(errors_path, fit.errors_rad, {.title = "OrientationErrors", .decimals = 12});
  }
  result.frames = static_cast<int>(series.time_s.size());
  result.frames_failed = fit.frames_not_converged;
  result.summary = fmt::format("{} frames, {} not converged", result.frames, result.frames_failed);
}

}  // namespace myoid::opensim
