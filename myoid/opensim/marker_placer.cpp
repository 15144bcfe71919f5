#include "myoid/opensim/marker_placer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/recording/recording.h"

namespace myoid::opensim {
namespace {

using body::OsimXml;

/// Returns one frame with every marker at its mean over the range.
MarkerSeries averaged(const ToolRun& run,
                      const MarkerSeries& markers,
                      std::pair<double, double> range,
                      double most_movement_m) {
  const auto [first, last] = frames_in(markers, range);
  MarkerSeries mean{markers.time_s.segment(first, 1), markers.names, Eigen::MatrixXd(1, markers.positions_m.cols())};
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    Vec3 sum = Vec3::Zero(), least = Vec3::Constant(INFINITY), most = -least;
    int seen = 0;
    for (Eigen::Index i = first; i <= last; ++i) {
      if (markers.missing(i, m)) continue;
      const Vec3 p = markers.position(i, m);
      sum += p;
      least = least.cwiseMin(p);
      most = most.cwiseMax(p);
      ++seen;
    }
    mean.positions_m.block<1, 3>(0, 3 * m) = (sum / seen).transpose();
    if (most_movement_m > 0.0 && seen > 0 && (most - least).maxCoeff() > most_movement_m) {
      run.note("marker '{}' moves by {:.1f} mm while the frames are averaged, more than <max_marker_movement>",
               markers.names[at(m)], 1000.0 * (most - least).maxCoeff());
    }
  }
  return mean;
}

/// Returns the pose as a row of OpenSim's states.
TimeSeries states_of(const body::BodyModel& model, const Eigen::VectorXd& q, double time_s) {
  ColumnTable table;
  const auto add = [&](const std::string& path, double value) {
    table.add(path, Unit::dimensionless, Eigen::VectorXd::Constant(1, value));
  };
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    const body::Coordinate& coordinate = model.coordinates[c];
    const std::string path = "/jointset/" + model.joints[at(coordinate.joint)].name + "/" + coordinate.name;
    add(path + "/value", q[static_cast<Eigen::Index>(c)]);
    add(path + "/speed", coordinate.default_speed);
  }
  for (const body::Muscle& muscle : model.muscles) {
    const body::MuscleProperties& p = muscle.properties;
    const auto* millard = std::get_if<body::MillardCurves>(&p.curves);
    if (millard == nullptr || !millard->ignore_activation_dynamics)
      add("/forceset/" + muscle.name + "/activation", p.default_activation);
    if (millard == nullptr || !millard->ignore_tendon_compliance)
      add("/forceset/" + muscle.name + "/fiber_length", p.default_fiber_length_m);
  }
  return table.at_times(Eigen::VectorXd::Constant(1, time_s));
}

std::string join_names(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

/// Notes coordinates at an end of their range: the static pose is then not the person's, and the
/// model takes over the misfit of the markers.
void note_limits(const ToolRun& run, const body::BodyModel& model, const Eigen::VectorXd& q, bool held_inside) {
  std::vector<std::string> at_limit;
  for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
    const body::Coordinate& c = model.coordinates[k];
    if (!c.clamped || c.locked || !(c.lower < c.upper)) continue;
    const double value = q[static_cast<Eigen::Index>(k)];
    const double near = 1e-6 * (c.upper - c.lower);
    if (value > c.lower + near && value < c.upper - near) continue;
    const bool angle = c.motion == body::MotionType::rotational;
    at_limit.push_back(fmt::format("'{}' at its limit of {:.4g} {}", c.name, angle ? value / kDegree : value,
                                   angle ? "degrees" : "m"));
  }
  if (at_limit.empty()) return;
  run.note(
      "static pose: the markers alone put {}{}; the markers placed from the pose take over what does not "
      "fit. Are the ranges right, and the markers' places in the model?",
      join_names(at_limit), held_inside ? " (the pose is held off there as in OpenSim's search)" : "");
}

/// Notes the coordinates that no marker of the static pose determines, and the markers that are
/// placed by these coordinates.
void note_undetermined(const ToolRun& run,
                       const body::BodyModel& model,
                       const std::vector<std::string>& undetermined,
                       const body::IkOptions& ik,
                       bool held_inside) {
  if (undetermined.empty()) return;
  std::vector<bool> carried(model.bodies.size(), false);
  for (const body::Joint& joint : model.joints) {
    bool moves = carried[at(joint.parent)];
    for (const int c : joint.coordinates)
      moves = moves ||
              std::find(undetermined.begin(), undetermined.end(), model.coordinates[at(c)].name) != undetermined.end();
    carried[at(joint.child)] = moves;
  }
  std::vector<std::string> placed;
  for (const body::Marker& marker : model.markers) {
    const auto weight = ik.marker_weights.find(marker.name);
    const bool counts = weight != ik.marker_weights.end() ? weight->second > 0.0 : !ik.only_named_markers;
    if (carried[at(marker.body)] && !counts) placed.push_back(marker.name);
  }
  run.note(
      "static pose: no marker with a weight determines {}: {}{}. Give weight to markers that do, or the "
      "coordinates a task",
      join_names(undetermined),
      held_inside ? "each in the middle of its range, if it is clamped to one, as OpenSim's search has it"
                  : "each at its default value",
      placed.empty() ? std::string() : fmt::format("; markers placed by that: {}", join_names(placed)));
}

/// Returns the barrier at which OpenSim's search for the static pose stops. For a model with constraints (locked
/// coordinates count) OpenSim uses an interior-point method with a tolerance of 1e-4 (of J, m^2), which a barrier of
/// tolerance / 11 meets (Waechter and Biegler 2006, eq. 7: error below ten barriers).
double barrier_of(const body::BodyModel& model) {
  const bool constrained = !model.couplers.empty() || !model.constraints.empty() ||
                           std::any_of(model.coordinates.begin(), model.coordinates.end(),
                                       [](const body::Coordinate& c) { return c.locked || c.prescribed; });
  return model.compat.static_pose_inside_ranges && constrained ? 1e-4 / 11.0 : 0.0;
}

}  // namespace

MarkerSeries markers_of(const ToolRun& run, const std::filesystem::path& file) {
  recording::MarkerFile markers = recording::read_markers(file);
  std::vector<Remark>& remarks = run.result.remarks;
  for (const Repair& repair : markers.repairs) {
    const std::string says = recording::to_string(file, repair);
    if (std::ranges::find(remarks, says, &Remark::says) == remarks.end())
      remarks.push_back({.code = RemarkCode::reading, .says = says});
  }
  return std::move(markers.markers);
}

std::pair<Eigen::Index, Eigen::Index> frames_in(const MarkerSeries& markers, std::pair<double, double> range) {
  const Eigen::Index n = markers.frame_count();
  Eigen::Index first = 0, last = n - 1;
  const double slack = 1e-9;
  if (range.second < markers.time_s[0] || range.first > markers.time_s[n - 1]) return {0, n - 1};
  while (first < n - 1 && markers.time_s[first] < range.first - slack) ++first;
  while (last > first && markers.time_s[last] > range.second + slack) --last;
  return {first, last};
}

void place_markers(const ToolRun& run, pugi::xml_node placer, body::OsimEditor& editor) {
  const OsimXml& xml = run.setup.xml();
  const auto file = run.setup.required_file(placer, "marker_file");
  const MarkerSeries all = markers_of(run, file);
  if (all.frame_count() == 0) throw InvalidInput(fmt::format("{}: there are no frames", file.string()));
  const auto range = run.setup.time_range(placer, "time_range");
  const MarkerSeries pose = averaged(run, all, range, 1e-3 * xml.number(placer, "max_marker_movement", -1.0));
  std::vector<std::string> removed;
  editor.remove_markers([&](const std::string& name) {
    if (std::find(pose.names.begin(), pose.names.end(), name) != pose.names.end()) return false;
    removed.push_back(name);
    return true;
  });
  if (!removed.empty()) {
    run.note("{}: the recording does not have {} of the model; the result lacks {}, as in OpenSim: {}", file.string(),
             counted(removed.size(), "marker"), removed.size() == 1 ? "it" : "them", join_names(removed));
  }
  body::BodyModel model = body::parse_osim(editor.text(), editor.path(), {.compat = run.options.compat});
  body::IkOptions ik = read_ik_tasks(run.setup, placer, model, pose, run.result.remarks);
  body::IkResult solved = body::inverse_kinematics(model, pose, ik);
  ik.range_barrier = barrier_of(model);
  const bool held_inside = ik.range_barrier > 0.0;
  note_limits(run, model, solved.q.values().row(0).transpose(), held_inside);
  note_undetermined(run, model, solved.open_coordinates, ik, held_inside);
  if (held_inside) solved = body::inverse_kinematics(model, pose, ik);
  if (solved.frames_not_converged > 0) ++run.result.frames_failed;
  const body::MarkerMisfit misfit = body::marker_misfit(model, pose, solved);
  if (!misfit.warning.empty()) run.note("static pose: {}", misfit.warning);
  run.result.wrong_unit = misfit.wrong_unit;
  const Eigen::VectorXd q = solved.q.values().row(0).transpose();
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, q, state);
  int moved = 0;
  for (const body::Marker& marker : model.markers) {
    if (editor.is_fixed(marker.name)) continue;
    const auto found = std::find(pose.names.begin(), pose.names.end(), marker.name);
    const Eigen::Index m = found - pose.names.begin();
    if (pose.missing(0, m)) {
      run.note("marker '{}' is never seen in the static pose: it stays where it is", marker.name);
      continue;
    }
    editor.move_marker(marker.name, state.X_GB[at(marker.body)].inverse() * pose.position(0, m));
    ++moved;
  }
  if (const auto out = run.setup.output_file(placer, "output_motion_file")) {
    write_opensim_storage(*out, states_of(model, q, pose.time_s[0]), {.title = "static pose"});
  }
  if (const auto out = run.setup.output_file(placer, "output_marker_file")) write_file(*out, editor.marker_set_text());
  run.result.summary += fmt::format("; static pose: marker error {:.1f} mm rms, {:.1f} mm at most; {} markers placed",
                                    1000.0 * solved.errors.column("marker_error_RMS")[0],
                                    1000.0 * solved.errors.column("marker_error_max")[0], moved);
}

}  // namespace myoid::opensim
