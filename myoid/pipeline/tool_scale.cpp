#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/model/constraints.h"
#include "myoid/model/kinematic_tree.h"
#include "myoid/model/muscle_path.h"
#include "myoid/model/osim_editor.h"
#include "myoid/model/osim_reader.h"
#include "myoid/pipeline/opensim_files.h"
#include "myoid/pipeline/tool_stages.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/text_file.h"

namespace myoid::pipeline {
namespace {

using model::OsimXml;

std::size_t at(Eigen::Index index) { return static_cast<std::size_t>(index); }

struct Scaling {
  const OpensimSetup& setup;
  const ToolOptions& options;
  ToolResult& result;
};

model::BodyState default_state(const model::BodyModel& model) {
  model::BodyState state = model::make_state(model);
  model::compute_poses(model, model::assemble(model, model.default_q()).q, state);
  return state;
}

/// Measuring and placing usually read one file: what its reader mended is noted once.
recording::MarkerSeries markers_of(const Scaling& scaling, const std::filesystem::path& file) {
  recording::MarkerFile markers = recording::read_markers(file);
  auto& notes = scaling.result.notes;
  for (const recording::Repair& repair : markers.repairs) {
    const std::string note = recording::to_string(file, repair);
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  }
  return std::move(markers.markers);
}

/// First and last frame of a time range; all frames where it says nothing.
std::pair<Eigen::Index, Eigen::Index> frames_in(const recording::MarkerSeries& markers,
                                                std::pair<double, double> range) {
  const Eigen::Index n = markers.frame_count();
  Eigen::Index first = 0, last = n - 1;
  const double slack = 1e-9;
  if (range.second < markers.time_s[0] || range.first > markers.time_s[n - 1]) return {0, n - 1};
  while (first < n - 1 && markers.time_s[first] < range.first - slack) ++first;
  while (last > first && markers.time_s[last] > range.second + slack) --last;
  return {first, last};
}

/// Factor of one measurement: the mean over its pairs of measured by model distance.
std::optional<double> measured_factor(const Scaling& scaling,
                                      pugi::xml_node measurement,
                                      const model::BodyModel& model,
                                      const model::BodyState& state,
                                      const recording::MarkerSeries& markers,
                                      std::pair<double, double> range) {
  double sum = 0.0;
  int count = 0;
  const std::string name = OsimXml::name_of(measurement);
  const auto refuse = [&](const std::string& why) {
    scaling.result.notes.push_back(fmt::format("measurement '{}' is not used: {}", name, why));
    return std::nullopt;
  };
  const auto [first, last] = frames_in(markers, range);
  for (const auto pair : OsimXml::objects(measurement.child("MarkerPairSet"))) {
    if (pair.type() != pugi::node_element) continue;
    const auto names = scaling.setup.xml().words(pair, "markers");
    if (names.size() != 2)
      scaling.setup.xml().fail(
          pair, fmt::format("<markers>: expected two names, found {}", names.size()));
    Vec3 p[2];
    Eigen::Index column[2];
    for (std::size_t k = 0; k < 2; ++k) {
      const auto in_model = model.find_marker(names[k]);
      if (!in_model) return refuse(fmt::format("the model has no marker '{}'", names[k]));
      const model::Marker& marker = model.markers[at(*in_model)];
      p[k] = state.X_GB[at(marker.body)] * marker.p_BM;
      const auto found = std::find(markers.names.begin(), markers.names.end(), names[k]);
      if (found == markers.names.end())
        return refuse(fmt::format("the recording has no marker '{}'", names[k]));
      column[k] = found - markers.names.begin();
    }
    double distance = 0.0;
    Eigen::Index seen = 0;
    for (Eigen::Index i = first; i <= last; ++i) {
      if (markers.missing(i, column[0]) || markers.missing(i, column[1])) continue;
      distance += (markers.position(i, column[1]) - markers.position(i, column[0])).norm();
      ++seen;
    }
    if (seen == 0)
      return refuse(fmt::format("'{}' and '{}' are never seen together", names[0], names[1]));
    const double own = (p[1] - p[0]).norm();
    if (!(own > 0.0))
      return refuse(fmt::format("'{}' and '{}' coincide in the model", names[0], names[1]));
    sum += distance / static_cast<double>(seen) / own;
    ++count;
  }
  if (count == 0) return refuse("it has no pair of markers");
  return sum / count;
}

model::OsimEditor::Factors factors_of(const Scaling& scaling,
                                      pugi::xml_node scaler,
                                      const model::BodyModel& model) {
  const OsimXml& xml = scaling.setup.xml();
  model::OsimEditor::Factors factors;
  for (const model::Body& body : model.bodies) factors[body.name] = Vec3::Ones();
  const auto known = [&](pugi::xml_node node, const std::string& body) {
    if (factors.contains(body)) return true;
    scaling.result.notes.push_back(
        fmt::format("{}: the model has no body '{}'; its factor is not used", node.name(), body));
    return false;
  };
  for (const std::string& method : xml.words(scaler, "scaling_order")) {
    if (method == "measurements") {
      std::optional<recording::MarkerSeries> markers;
      const model::BodyState state = default_state(model);
      for (const auto node : OsimXml::objects(scaler.child("MeasurementSet"))) {
        if (node.type() != pugi::node_element || !xml.flag(node, "apply", true)) continue;
        if (!markers)
          markers = markers_of(scaling, scaling.setup.required_file(scaler, "marker_file"));
        const auto factor = measured_factor(scaling, node, model, state, *markers,
                                            scaling.setup.time_range(scaler, "time_range"));
        if (!factor) continue;
        for (const auto body : OsimXml::objects(node.child("BodyScaleSet"))) {
          if (body.type() != pugi::node_element) continue;
          const std::string name = OsimXml::name_of(body);
          if (!known(node, name)) continue;
          for (const std::string& axis : xml.words(body, "axes")) {
            const auto k = std::string_view("XYZxyz").find(axis);
            if (axis.size() != 1 || k == std::string_view::npos)
              xml.fail(body, fmt::format("<axes>: expected X, Y, Z, found '{}'", axis));
            factors[name][static_cast<Eigen::Index>(k % 3)] = *factor;
          }
        }
      }
    } else if (method == "manualScale") {
      for (const auto node : OsimXml::objects(scaler.child("ScaleSet"))) {
        if (node.type() != pugi::node_element || !xml.flag(node, "apply", true)) continue;
        const std::string name = xml.word(node, "segment");
        if (known(node, name)) factors[name] = xml.vec3(node, "scales", Vec3::Ones());
      }
    } else {
      xml.fail(
          scaler.child("scaling_order"),
          fmt::format("<scaling_order>: expected measurements or manualScale, found '{}'", method));
    }
  }
  for (const auto& [name, f] : factors) {
    if (!(f.cwiseAbs().minCoeff() > 0.0) || !f.allFinite())
      xml.fail(scaler, fmt::format("the factors of body '{}' are {} {} {}, expected other than 0",
                                   name, f[0], f[1], f[2]));
  }
  return factors;
}

/// Every path of the model and what it is called.
std::vector<std::pair<std::string, const model::MusclePath*>> paths_of(
    const model::BodyModel& model) {
  std::vector<std::pair<std::string, const model::MusclePath*>> paths;
  for (const model::Muscle& m : model.muscles) paths.emplace_back(m.name, &m.path);
  for (const model::PathActuator& a : model.path_actuators) paths.emplace_back(a.name, &a.path);
  for (const model::PassiveForce& f : model.passive_forces) {
    if (const auto* spring = std::get_if<model::PathSpring>(&f.law))
      paths.emplace_back(f.name, &spring->path);
    if (const auto* ligament = std::get_if<model::Ligament>(&f.law))
      paths.emplace_back(f.name, &ligament->path);
  }
  return paths;
}

void scale(const Scaling& scaling,
           pugi::xml_node scaler,
           model::OsimEditor& editor,
           const model::OsimEditor::Factors& factors) {
  const OsimXml& xml = scaling.setup.xml();
  const model::OsimOptions as_opensim{.compat = scaling.options.compat};
  const model::BodyModel before = model::parse_osim(editor.text(), editor.path(), as_opensim);
  editor.scale_geometry(factors);
  editor.scale_masses(factors, xml.flag(scaler, "preserve_mass_distribution", false),
                      xml.number(scaling.setup.tool(), "mass", -1.0));
  const model::BodyModel after = model::parse_osim(editor.text(), editor.path(), as_opensim);
  const model::BodyState state_before = default_state(before), state_after = default_state(after);
  const auto paths_before = paths_of(before), paths_after = paths_of(after);
  model::PathWorkspace workspace;
  model::PathResult path;
  for (std::size_t i = 0; i < paths_before.size() && i < paths_after.size(); ++i) {
    model::compute_path(before, *paths_before[i].second, state_before, workspace, path);
    const double length = path.length_m;
    model::compute_path(after, *paths_after[i].second, state_after, workspace, path);
    if (length > 0.0) editor.scale_lengths(paths_before[i].first, path.length_m / length);
  }
}

std::string scale_set_text(const model::OsimEditor::Factors& factors,
                           const model::BodyModel& model) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40500\">\n"
      "\t<ScaleSet name=\"ScaleSet\">\n\t\t<objects>\n";
  for (const model::Body& body : model.bodies) {
    const Vec3& f = factors.at(body.name);
    text += fmt::format(
        "\t\t\t<Scale>\n\t\t\t\t<scales> {} {} {}</scales>\n\t\t\t\t<segment>{}</segment>\n"
        "\t\t\t\t<apply>true</apply>\n\t\t\t</Scale>\n",
        f[0], f[1], f[2], body.name);
  }
  return text + "\t\t</objects>\n\t\t<groups />\n\t</ScaleSet>\n</OpenSimDocument>\n";
}

/// One frame: every marker at its mean over the range.
recording::MarkerSeries averaged(const recording::MarkerSeries& markers,
                                 std::pair<double, double> range,
                                 double most_movement_m,
                                 std::vector<std::string>& notes) {
  const auto [first, last] = frames_in(markers, range);
  recording::MarkerSeries mean{markers.time_s.segment(first, 1), markers.names,
                               Eigen::MatrixXd(1, markers.positions_m.cols())};
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
      notes.push_back(
          fmt::format("marker '{}' moves by {:.1f} mm while the frames are averaged, more "
                      "than <max_marker_movement>",
                      markers.names[at(m)], 1000.0 * (most - least).maxCoeff()));
    }
  }
  return mean;
}

/// The pose as a row of OpenSim's states.
TimeSeries states_of(const model::BodyModel& model, const Eigen::VectorXd& q, double time_s) {
  std::vector<Channel> channels;
  std::vector<double> values;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    const model::Coordinate& coordinate = model.coordinates[c];
    const std::string path =
        "/jointset/" + model.joints[at(coordinate.joint)].name + "/" + coordinate.name;
    channels.push_back({path + "/value", Unit::dimensionless});
    channels.push_back({path + "/speed", Unit::dimensionless});
    values.push_back(q[static_cast<Eigen::Index>(c)]);
    values.push_back(coordinate.default_speed);
  }
  for (const model::Muscle& muscle : model.muscles) {
    bool activation = true, fiber = true;
    if (const auto* millard = std::get_if<model::MillardCurves>(&muscle.properties.curves)) {
      activation = !millard->ignore_activation_dynamics;
      fiber = !millard->ignore_tendon_compliance;
    }
    if (activation) {
      channels.push_back({"/forceset/" + muscle.name + "/activation", Unit::dimensionless});
      values.push_back(muscle.properties.default_activation);
    }
    if (fiber) {
      channels.push_back({"/forceset/" + muscle.name + "/fiber_length", Unit::dimensionless});
      values.push_back(muscle.properties.default_fiber_length_m);
    }
  }
  return {Eigen::VectorXd::Constant(1, time_s), std::move(channels),
          Eigen::Map<Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size()))};
}

/// A static pose that leans on the end of a coordinate's range is not the person's: the markers
/// that do not fit are then placed into the model for good.
void note_limits(const model::BodyModel& model,
                 const Eigen::VectorXd& q,
                 std::vector<std::string>& notes) {
  for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
    const model::Coordinate& c = model.coordinates[k];
    if (!c.clamped || c.locked || !(c.lower < c.upper)) continue;
    const double value = q[static_cast<Eigen::Index>(k)];
    const double near = 1e-6 * (c.upper - c.lower);
    if (value > c.lower + near && value < c.upper - near) continue;
    const bool angle = c.motion == model::MotionType::rotational;
    notes.push_back(fmt::format(
        "static pose: '{}' is at its limit of {:.4g} {}; the markers placed from it take over what "
        "does not fit. Is the range right, and the markers' places in the model?",
        c.name, angle ? value / kDegree : value, angle ? "degrees" : "m"));
  }
}

void place_markers(const Scaling& scaling, pugi::xml_node placer, model::OsimEditor& editor) {
  const OsimXml& xml = scaling.setup.xml();
  auto& notes = scaling.result.notes;
  const auto file = scaling.setup.required_file(placer, "marker_file");
  const recording::MarkerSeries all = markers_of(scaling, file);
  if (all.frame_count() == 0)
    throw InvalidInput(fmt::format("{}: there are no frames", file.string()));
  const auto range = scaling.setup.time_range(placer, "time_range");
  const recording::MarkerSeries pose =
      averaged(all, range, 1e-3 * xml.number(placer, "max_marker_movement", -1.0), notes);
  editor.remove_markers([&](const std::string& name) {
    return std::find(pose.names.begin(), pose.names.end(), name) == pose.names.end();
  });
  model::BodyModel model =
      model::parse_osim(editor.text(), editor.path(), {.compat = scaling.options.compat});
  const kinematics::IkOptions ik = read_ik_tasks(scaling.setup, placer, model, pose, notes);
  const kinematics::IkResult solved = kinematics::inverse_kinematics(model, pose, ik);
  if (solved.frames_not_converged > 0) ++scaling.result.frames_failed;
  const Eigen::VectorXd q = solved.q.values().row(0).transpose();
  note_limits(model, q, notes);
  model::BodyState state = model::make_state(model);
  model::compute_poses(model, q, state);
  int moved = 0;
  for (const model::Marker& marker : model.markers) {
    if (editor.is_fixed(marker.name)) continue;
    const auto found = std::find(pose.names.begin(), pose.names.end(), marker.name);
    const Eigen::Index m = found - pose.names.begin();
    if (pose.missing(0, m)) {
      notes.push_back(fmt::format(
          "marker '{}' is never seen in the static pose: it stays where it is", marker.name));
      continue;
    }
    editor.move_marker(marker.name, state.X_GB[at(marker.body)].inverse() * pose.position(0, m));
    ++moved;
  }
  if (const auto out = scaling.setup.file(placer, "output_motion_file")) {
    write_opensim_storage(*out, states_of(model, q, pose.time_s[0]), {.title = "static pose"});
  }
  if (const auto out = scaling.setup.file(placer, "output_marker_file"))
    recording::write_file(*out, editor.marker_set_text());
  scaling.result.summary +=
      fmt::format("; static pose: marker error {:.1f} mm rms, {:.1f} mm at most; {} markers placed",
                  1000.0 * solved.errors.column("marker_error_RMS")[0],
                  1000.0 * solved.errors.column("marker_error_max")[0], moved);
}

}  // namespace

void run_scale(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result) {
  const OsimXml& xml = setup.xml();
  const auto tool = setup.tool();
  const Scaling scaling{setup, options, result};
  const auto maker = tool.child("GenericModelMaker");
  const auto scaler = tool.child("ModelScaler");
  const auto placer = tool.child("MarkerPlacer");
  const bool scales = scaler && xml.flag(scaler, "apply", true);
  const bool places = placer && xml.flag(placer, "apply", true);
  if (!scales && !places) xml.fail(tool, "neither <ModelScaler> nor <MarkerPlacer> applies");
  const auto claim = [&](bool on, pugi::xml_node stage, const char* name) {
    const auto file = on ? setup.file(stage, name) : std::nullopt;
    if (file) claim_file(options, *file, result);
    return file;
  };
  const auto scaled_file = claim(scales, scaler, "output_model_file");
  const auto factors_file = claim(scales, scaler, "output_scale_file");
  const auto placed_file = claim(places, placer, "output_model_file");
  (void)claim(places, placer, "output_motion_file");
  (void)claim(places, placer, "output_marker_file");

  const auto model_file = setup.required_file(maker, "model_file");
  model::OsimEditor editor(recording::read_text_file(model_file), model_file);
  if (!setup.name().empty()) editor.set_name(setup.name());
  if (const auto markers = setup.file(maker, "marker_set_file")) editor.add_markers(*markers);
  const model::BodyModel generic =
      model::parse_osim(editor.text(), editor.path(), {.compat = options.compat});
  for (const std::string& text : generic.unsupported)
    result.notes.push_back(fmt::format("{}: {}", model_file.string(), text));
  if (scales) {
    const auto factors = factors_of(scaling, scaler, generic);
    scale(scaling, scaler, editor, factors);
    if (factors_file) recording::write_file(*factors_file, scale_set_text(factors, generic));
    if (scaled_file) recording::write_file(*scaled_file, editor.text());
  }
  double mass = 0.0;
  for (const model::Body& body : model::parse_osim(editor.text(), editor.path()).bodies)
    mass += body.mass_kg;
  result.summary = fmt::format("model of {:.4g} kg", mass);
  if (places) place_markers(scaling, placer, editor);
  if (placed_file) recording::write_file(*placed_file, editor.text());
  result.notes.insert(result.notes.end(), editor.notes().begin(), editor.notes().end());
  result.frames = 1;
}

}  // namespace myoid::pipeline
