#include "myoid/pipeline/opensim_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/model/osim_reader.h"
#include "myoid/recording/text_file.h"

namespace myoid::pipeline {
namespace {

constexpr const char* kTools[] = {
    "InverseKinematicsTool", "IKTool",    "InverseDynamicsTool",     "AnalyzeTool", "ScaleTool",
    "ForwardTool",           "IMUPlacer", "IMUInverseKinematicsTool"};

/// What answers the question of a tool that is not run.
std::string in_place_of(std::string_view tool) {
  if (tool == "CMCTool") {
    return "; in place of computed muscle control: AnalyzeTool with StaticOptimization gives the "
           "muscles' forces along a motion, with MuscleAnalysis their fibers";
  }
  if (tool == "RRATool") {
    return "; in place of residual reduction: InverseDynamicsTool shows the residual forces of the "
           "pelvis, and ScaleTool adjusts the model's mass";
  }
  return "";
}

template <typename Force>
void drop(std::vector<Force>& forces, const auto& is_dropped) {
  forces.erase(std::remove_if(forces.begin(), forces.end(), is_dropped), forces.end());
}

}  // namespace

OpensimSetup::OpensimSetup(const std::filesystem::path& path)
    : path_(path),
      text_(recording::read_text_file(path)),
      xml_(text_, path_, model::OsimXml::Root::any) {
  const pugi::xml_node root = xml_.root();
  for (const char* kind : kTools) {
    if (const auto node = root.child(kind)) {
      tool_ = node;
      break;
    }
  }
  if (!tool_) {
    const auto first = model::OsimXml::first_element(root, {"defaults"});
    xml_.fail(
        first ? first : root,
        fmt::format(
            "found <{}>, expected a set-up of InverseKinematicsTool, "
            "InverseDynamicsTool, ForwardTool, ScaleTool, IMUPlacer, IMUInverseKinematicsTool or "
            "AnalyzeTool (StaticOptimization, MuscleAnalysis, Kinematics, ...); other "
            "tools are not run{}",
            first ? first.name() : "nothing", first ? in_place_of(first.name()) : std::string()));
  }
  if (const auto defaults = root.child("defaults")) xml_.set_prototypes(defaults);
}

std::optional<std::filesystem::path> OpensimSetup::file(pugi::xml_node object,
                                                        const char* name) const {
  std::string text = xml_.word(object, name);
  std::replace(text.begin(), text.end(), '\\', '/');
  if (text.empty() || recording::equal_ignoring_case(text, "Unassigned")) return {};
  return path_.parent_path() / text;
}

std::filesystem::path OpensimSetup::required_file(pugi::xml_node object, const char* name) const {
  const auto found = file(object, name);
  if (!found) {
    const auto node = xml_.property(object, name);
    xml_.fail(node ? node : object, fmt::format("<{}> expected: a file's name, relative to this "
                                                "set-up",
                                                name));
  }
  return *found;
}

std::vector<std::filesystem::path> OpensimSetup::inputs() const {
  std::vector<std::filesystem::path> files{path_};
  for (const char* name : {"model_file", "marker_file", "marker_set_file", "coordinates_file",
                           "coordinate_file", "states_file", "speeds_file", "external_loads_file",
                           "orientations_file", "orientation_file_for_calibration"}) {
    // In the tool itself or, when scaling, in one of its stages.
    if (const auto found = file(tool_, name)) files.push_back(*found);
    for (const auto stage : tool_.children()) {
      if (stage.child(name))
        if (const auto found = file(stage, name)) files.push_back(*found);
    }
  }
  return files;
}

std::filesystem::path OpensimSetup::results_folder() const {
  return file(tool_, "results_directory").value_or(path_.parent_path());
}

std::pair<double, double> OpensimSetup::time_range(pugi::xml_node object, const char* name) const {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto node = xml_.property(object, name);
  if (!node || model::OsimXml::text_of(node).empty()) return {-infinity, infinity};
  const auto values = xml_.numbers(node);
  if (values.size() != 2 || !(values[0] <= values[1])) {
    xml_.fail(node, fmt::format("<{}>: expected two times, the first not after the second, found "
                                "'{}'",
                                name, model::OsimXml::text_of(node)));
  }
  return {values[0], values[1]};
}

void OpensimSetup::check_range(std::pair<double, double> asked_s,
                               const Eigen::VectorXd& recorded_s,
                               const std::filesystem::path& file,
                               std::vector<std::string>& notes) const {
  const auto [start_s, end_s] = asked_s;
  const Eigen::Index count = recorded_s.size();
  const double first_s = recorded_s[0], last_s = recorded_s[count - 1];
  const double interval_s = count > 1 ? (last_s - first_s) / static_cast<double>(count - 1) : 0.0;
  if (start_s > last_s + interval_s || end_s < first_s - interval_s) {
    xml_.fail(tool_, fmt::format("the set-up asks for {} to {} s, but {} holds {} to {} s; nothing "
                                 "is written",
                                 start_s, end_s, file.string(), first_s, last_s));
  }
  const bool early = start_s < first_s - interval_s && std::isfinite(start_s);
  const bool late = end_s > last_s + interval_s && std::isfinite(end_s);
  if (early || late) {
    notes.push_back(
        fmt::format("the set-up asks for {} to {} s; {} holds {} to {} s, and what it "
                    "holds is used, as in OpenSim",
                    start_s, end_s, file.string(), first_s, last_s));
  }
}

model::BodyModel setup_model(const OpensimSetup& setup,
                             const model::Compat& compat,
                             const std::vector<std::string>& excluded,
                             std::vector<std::string>& notes) {
  const auto& xml = setup.xml();
  const auto path = setup.required_file(setup.tool(), "model_file");
  model::BodyModel model = model::read_osim(path, {.compat = compat});
  const bool replaces = xml.flag(setup.tool(), "replace_force_set",
                                 xml.flag(setup.tool(), "replace_actuator_set", false));
  if (replaces) {
    model.muscles.clear();
    model.actuators.clear();
    model.point_actuators.clear();
    model.torque_actuators.clear();
    model.path_actuators.clear();
    model.passive_forces.clear();
    model.force_order.clear();
  }
  auto files = xml.words(setup.tool(), "force_set_files");
  for (std::string& old : xml.words(setup.tool(), "actuator_set_files"))
    files.push_back(std::move(old));
  for (const std::string& name : files) {
    if (recording::equal_ignoring_case(name, "Unassigned")) continue;
    std::string local = name;
    std::replace(local.begin(), local.end(), '\\', '/');
    model = model::with_force_set(std::move(model), xml.path().parent_path() / local);
  }
  for (const std::string& name : excluded) {
    const bool all = recording::equal_ignoring_case(name, "all");
    const bool muscles = all || recording::equal_ignoring_case(name, "muscles");
    const bool actuators = all || recording::equal_ignoring_case(name, "actuators");
    const auto named = [&](const auto& force) { return all || force.name == name; };
    const auto actuator = [&](const auto& force) { return actuators || force.name == name; };
    if (muscles || actuators) model.muscles.clear();  // a muscle is an actuator, too
    drop(model.muscles, named);
    drop(model.actuators, actuator);
    drop(model.point_actuators, actuator);
    drop(model.torque_actuators, actuator);
    drop(model.path_actuators, actuator);
    drop(model.passive_forces, named);
  }
  for (const std::string& text : model.unsupported)
    notes.push_back(fmt::format("{}: {}", path.string(), text));
  return model;
}

}  // namespace myoid::pipeline
