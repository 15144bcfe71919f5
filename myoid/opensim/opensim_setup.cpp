#include "myoid/opensim/opensim_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::opensim {
namespace {

constexpr const char* kTools[] = {
    "InverseKinematicsTool", "IKTool",    "InverseDynamicsTool",     "AnalyzeTool", "ScaleTool",
    "ForwardTool",           "IMUPlacer", "IMUInverseKinematicsTool"};

/// Returns advice on tools that replace a tool that is not run.
std::string in_place_of(std::string_view tool) {
  if (tool == "CMCTool") {
    return "; in place of computed muscle control: AnalyzeTool with StaticOptimization gives the muscles' forces along "
           "a motion, with MuscleAnalysis their fibers";
  }
  if (tool == "RRATool") {
    return "; in place of residual reduction: InverseDynamicsTool shows the residual forces of the pelvis, and "
           "ScaleTool adjusts the model's mass";
  }
  return "";
}

/// Returns true if the name of a result is from another computer: a Windows path, or an absolute
/// path whose folder does not exist.
bool is_elsewhere(const std::filesystem::path& folder, const std::string& name) {
  if (name.empty()) return false;
  if (is_windows_path(name)) return true;
  const auto path = native_path(folder, name).lexically_normal();
  const auto above = path.has_filename() ? path.parent_path() : path.parent_path().parent_path();
  std::error_code ignored;
  return std::filesystem::path(name).is_absolute() && !std::filesystem::exists(path, ignored) &&
         (above == above.root_path() || !std::filesystem::exists(above, ignored));
}

/// Returns the elements that may name files: the tool, its stages, and the objects of its sets.
std::vector<pugi::xml_node> holders_of(pugi::xml_node tool) {
  std::vector<pugi::xml_node> holders{tool};
  for (const auto stage : tool.children()) {
    holders.push_back(stage);
    for (const auto object : body::OsimXml::objects(stage)) holders.push_back(object);
  }
  return holders;
}

}  // namespace

OpensimSetup::OpensimSetup(const std::filesystem::path& path, SetupFiles instead)
    : path_(path), xml_(read_text_file(path), path_, body::OsimXml::Root::any), instead_(std::move(instead)) {
  const pugi::xml_node root = xml_.root();
  for (const char* kind : kTools) {
    if (const auto node = root.child(kind)) {
      tool_ = node;
      break;
    }
  }
  if (!tool_) {
    const auto first = body::OsimXml::first_element(root, {"defaults"});
    xml_.fail(first ? first : root,
              "found <{}>, expected a set-up of InverseKinematicsTool, InverseDynamicsTool, ForwardTool, ScaleTool, "
              "IMUPlacer, IMUInverseKinematicsTool or AnalyzeTool (StaticOptimization, MuscleAnalysis, Kinematics, "
              "...); other tools are not run{}",
              first ? first.name() : "nothing", first ? in_place_of(first.name()) : std::string());
  }
  if (const auto defaults = root.child("defaults")) xml_.set_prototypes(defaults);
  if (!instead_.external_loads.empty() && kind() != "AnalyzeTool" && kind() != "InverseDynamicsTool") {
    throw InvalidInput(fmt::format("--external-loads: {} holds a {}, which reads no loads", path_.string(), kind()));
  }
}

bool OpensimSetup::names_file(pugi::xml_node object, const char* name) const {
  return !named_in(object, name).empty() || !replacement(name).empty();
}

std::string OpensimSetup::named_in(pugi::xml_node object, const char* name) const {
  std::string text = xml_.word(object, name);
  return equal_ignoring_case(text, "Unassigned") ? std::string() : text;
}

std::string_view OpensimSetup::option_for(std::string_view name) const {
  if (name == "model_file") return "--model";
  if (name == "external_loads_file" && (kind() == "AnalyzeTool" || kind() == "InverseDynamicsTool"))
    return "--external-loads";
  // The states, where the set-up names them, else the coordinates.
  const bool by_states = kind() == "ForwardTool" || !named_in(tool_, "states_file").empty();
  std::vector<std::string_view> motion{"coordinates_file", "marker_file", "orientations_file",
                                       "orientation_file_for_calibration"};
  if (kind() == "AnalyzeTool" || by_states) motion = {by_states ? "states_file" : "coordinates_file"};
  return std::find(motion.begin(), motion.end(), name) != motion.end() ? "--motion" : "";
}

std::filesystem::path OpensimSetup::replacement(std::string_view name) const {
  const std::string_view option = option_for(name);
  if (option == "--model") return instead_.model;
  if (option == "--external-loads") return instead_.external_loads;
  return option == "--motion" ? instead_.motion : std::filesystem::path();
}

std::filesystem::path OpensimSetup::file_named(pugi::xml_node node, std::string_view name) const {
  const NamedFile found = find_named_file(path_.parent_path(), name);
  if (found.exists) return found.path;
  const std::string_view option = option_for(node.name());
  xml_.fail(node, "<{}> names '{}', and {}{}", node.name(), name, missing_file(path_.parent_path(), name),
            option.empty() ? std::string() : fmt::format("; {} FILE names another", option));
}

std::optional<std::filesystem::path> OpensimSetup::file(pugi::xml_node object, const char* name) const {
  if (const auto given = replacement(name); !given.empty()) return given;
  const std::string text = named_in(object, name);
  if (text.empty()) return {};
  return file_named(xml_.property(object, name), text);
}

std::filesystem::path OpensimSetup::required_file(pugi::xml_node object, const char* name) const {
  if (const auto found = file(object, name)) return *found;
  const auto node = object.child(name);
  xml_.fail(node ? node : object, "<{}> expected: a file's name, relative to this set-up{}", name,
            option_for(name).empty() ? std::string() : fmt::format(", or {} FILE", option_for(name)));
}

std::vector<std::filesystem::path> OpensimSetup::files(pugi::xml_node object, const char* name) const {
  const std::string text = named_in(object, name);
  if (text.empty()) return {};
  // A name may hold blanks: the whole text is tried first, then each word.
  const auto folder = path_.parent_path();
  if (find_named_file(folder, text).exists) return {find_named_file(folder, text).path};
  std::vector<std::filesystem::path> found;
  for (const std::string_view word : split_words(text))
    if (!equal_ignoring_case(word, "Unassigned")) found.push_back(file_named(xml_.property(object, name), word));
  return found;
}

std::optional<std::filesystem::path> OpensimSetup::output_file(pugi::xml_node object, const char* name) const {
  const std::string text = named_in(object, name);
  if (text.empty()) return {};
  if (!instead_.out.empty()) return instead_.out / last_part(text);
  if (is_elsewhere(path_.parent_path(), text)) return path_.parent_path() / last_part(text);
  return native_path(path_.parent_path(), text);
}

std::vector<std::pair<const char*, NamedFile>> OpensimSetup::named_inputs() const {
  std::vector<std::pair<const char*, NamedFile>> found;
  for (const char* name : {"model_file", "marker_file", "marker_set_file", "coordinates_file", "coordinate_file",
                           "states_file", "speeds_file", "external_loads_file", "force_set_files", "actuator_set_files",
                           "forces_file", "orientations_file", "orientation_file_for_calibration"}) {
    const NamedFile given{replacement(name), true};
    if (!given.path.empty()) found.emplace_back(name, given);
    for (const auto holder : holders_of(tool_)) {
      if (!holder.child(name)) continue;
      found.emplace_back(name,
                         given.path.empty() ? find_named_file(path_.parent_path(), named_in(holder, name)) : given);
    }
  }
  return found;
}

std::vector<std::filesystem::path> OpensimSetup::inputs() const {
  std::vector<std::filesystem::path> files{path_};
  const auto add_parts = [&](const std::vector<std::filesystem::path>& parts) {
    files.insert(files.end(), parts.begin(), parts.end());
  };
  add_parts(xml_.files());
  for (const auto& [element, file] : named_inputs()) {
    if (!file.exists) continue;
    files.push_back(file.path);
    if (std::string_view(element) == "model_file") add_parts(body::files_of(file.path));
  }
  return files;
}

std::vector<std::filesystem::path> OpensimSetup::missing_inputs() const {
  std::vector<std::filesystem::path> files;
  for (const auto& [element, file] : named_inputs())
    if (!file.exists && file.path.has_filename()) files.push_back(file.path);
  return files;
}

std::vector<std::string> OpensimSetup::notes() const {
  std::vector<std::string> notes;
  const auto add = [&](const char* name, const std::string& text) {
    std::string note = fmt::format("<{}>: {}", name, text);
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
  };
  for (const auto& [element, file] : named_inputs())
    if (!file.note.empty()) add(element, file.note);
  if (!instead_.out.empty()) return notes;
  for (const auto holder : holders_of(tool_)) {
    for (const char* name :
         {"results_directory", "output_motion_file", "output_model_file", "output_scale_file", "output_marker_file"}) {
      const std::string text = holder.child(name) ? named_in(holder, name) : "";
      if (is_elsewhere(path_.parent_path(), text))
        add(name,
            fmt::format("'{}' is not on this computer; results go beside the set-up (--out DIR puts them elsewhere)",
                        text));
    }
  }
  return notes;
}

bool OpensimSetup::is_near(const std::filesystem::path& output) const {
  std::error_code ignored;
  const auto real = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::current_path() / path, ignored);
  };
  std::filesystem::path folder = real(instead_.out.empty() ? path_.parent_path() : instead_.out);
  if (!folder.has_filename()) folder = folder.parent_path();
  const std::filesystem::path file = real(output);
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

std::filesystem::path OpensimSetup::results_folder() const {
  if (!instead_.out.empty()) return instead_.out;
  const std::string text = named_in(tool_, "results_directory");
  if (text.empty() || is_elsewhere(path_.parent_path(), text)) return path_.parent_path();
  return native_path(path_.parent_path(), text);
}

std::pair<double, double> OpensimSetup::time_range(pugi::xml_node object, const char* name) const {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto node = xml_.property(object, name);
  if (!node || body::OsimXml::text_of(node).empty()) return {-infinity, infinity};
  const auto values = xml_.numbers(node);
  if (values.size() != 2 || !(values[0] <= values[1])) {
    xml_.fail(node, "<{}>: expected two times, the first not after the second, found '{}'", name,
              body::OsimXml::text_of(node));
  }
  return {values[0], values[1]};
}

void OpensimSetup::check_range(std::pair<double, double> asked_s,
                               const Eigen::VectorXd& recorded_s,
                               const std::filesystem::path& file,
                               std::vector<Remark>& remarks) const {
  const auto [start_s, end_s] = asked_s;
  const Eigen::Index count = recorded_s.size();
  const double first_s = recorded_s[0], last_s = recorded_s[count - 1];
  const double interval_s = count > 1 ? (last_s - first_s) / static_cast<double>(count - 1) : 0.0;
  if (start_s > last_s + interval_s || end_s < first_s - interval_s) {
    xml_.fail(tool_, "the set-up asks for {} to {} s, but {} holds {} to {} s; nothing is written", start_s, end_s,
              file.string(), first_s, last_s);
  }
  const bool early = start_s < first_s - interval_s && std::isfinite(start_s);
  const bool late = end_s > last_s + interval_s && std::isfinite(end_s);
  if (early || late) {
    remarks.push_back(
        {.says =
             fmt::format("the set-up asks for {} to {} s; {} holds {} to {} s, and these times are used, as in OpenSim",
                         start_s, end_s, file.string(), first_s, last_s)});
  }
}

body::BodyModel setup_model(const OpensimSetup& setup,
                            const body::Compat& compat,
                            const std::vector<std::string>& excluded,
                            std::vector<Remark>& remarks) {
  const auto& xml = setup.xml();
  const auto path = setup.required_file(setup.tool(), "model_file");
  body::BodyModel model = body::read_osim(path, {.compat = compat});
  body::require_lengths_in_m(model, path);
  const bool replaces =
      xml.flag(setup.tool(), "replace_force_set", xml.flag(setup.tool(), "replace_actuator_set", false));
  if (replaces) {
    model.muscles.clear();
    body::visit_actuators(model, [](auto& list) { list.clear(); });
    model.passive_forces.clear();
    model.force_order.clear();
  }
  const std::size_t noted = model.notes.size();
  for (const char* element : {"force_set_files", "actuator_set_files"}) {
    for (const auto& file : setup.files(setup.tool(), element)) model = body::with_force_set(std::move(model), file);
  }
  for (std::size_t k = noted; k < model.notes.size(); ++k)
    remarks.push_back({.code = model.notes[k].code, .says = sentence(model.notes[k])});
  for (const std::string& name : excluded) {
    const bool all = equal_ignoring_case(name, "all");
    const bool muscles = all || equal_ignoring_case(name, "muscles");
    const bool actuators = all || equal_ignoring_case(name, "actuators");
    const auto named = [&](const auto& force) { return all || force.name == name; };
    const auto actuator = [&](const auto& force) { return actuators || force.name == name; };
    if (muscles || actuators) model.muscles.clear();  // a muscle is an actuator, too
    std::erase_if(model.muscles, named);
    body::visit_actuators(model, [&](auto& list) { std::erase_if(list, actuator); });
    std::erase_if(model.passive_forces, named);
  }
  for (const std::string& text : model.unsupported)
    remarks.push_back({.code = RemarkCode::model_unsupported, .says = fmt::format("{}: {}", path.string(), text)});
  return model;
}

}  // namespace myoid::opensim
