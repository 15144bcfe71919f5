#include "myoid/program/commands/info.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/named_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/opensim_setup.h"
#include "myoid/program/contents/project_contents.h"
#include "myoid/program/contents/recording_contents.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/recording/recording.h"
#include "myoid/study/read_study.h"

namespace myoid::program {
namespace {

using nlohmann::ordered_json;

constexpr const char* kPart = "part of an OpenSim document";

ordered_json study_contents(const std::string& path) {
  const study::Study study = study::read_study(path);
  ordered_json j{{"kind", "study"},
                 {"subject", study.subject.name},
                 {"coordinate", study.model.coordinate},
                 {"methods", ordered_json::array()}};
  for (const fit::Method method : study.identify.methods) j["methods"].push_back(std::string(choice_name(method)));
  for (const auto& m : study.muscles) j["muscles"].push_back({{"name", m.name}, {"emg", m.emg}});
  for (const auto& t : study.trials)
    j["trials"].push_back({{"name", t.name}, {"use", std::string(choice_name(t.use))}});
  return j;
}

ordered_json contents_of_model(const InfoOptions& o) {
  const body::OsimOptions options{.compat = body::compat_of(o.compat)};
  ModelQuestions ask = o.ask;
  ask.seed = o.call.seed;
  return model_contents(
      o.file == "arm4" ? body::parse_osim(body::arm4_osim(), "arm4.osim", options) : body::read_osim(o.file, options),
      ask);
}

/// Returns the forces of an <ExternalLoads> with their bodies, and the file of their numbers.
ordered_json loads_contents(const body::OsimXml& xml, pugi::xml_node loads) {
  ordered_json j{{"kind", kPart}, {"class", loads.name()}, {"name", body::OsimXml::name_of(loads)}};
  for (const pugi::xml_node force : body::OsimXml::objects(loads)) {
    const std::string body = xml.word(force, "applied_to_body");
    j["forces"].push_back(
        {{"name", body::OsimXml::name_of(force)}, {"on", body.empty() ? xml.word(force, "body") : body}});
  }
  const std::string data = xml.word(loads, "datafile");
  const NamedFile file = find_named_file(xml.path().parent_path(), data);
  if (!data.empty()) j[file.exists ? "reads" : "missing"].push_back(file.path.string());
  j["read_by"] = {"myoid id --loads", "myoid so --loads", "external_loads of study.toml"};
  return j;
}

/// Returns the weights of an <IKTaskSet>; "off" for a task that is not applied.
ordered_json tasks_contents(const body::OsimXml& xml, pugi::xml_node set) {
  ordered_json j{{"kind", kPart}, {"class", set.name()}, {"name", body::OsimXml::name_of(set)}};
  for (const pugi::xml_node task : body::OsimXml::objects(set)) {
    ordered_json& told =
        j[std::string_view(task.name()) == "IKCoordinateTask" ? "coordinates" : "markers"].emplace_back();
    told["name"] = body::OsimXml::name_of(task);
    told["weight"] = xml.flag(task, "apply", true) ? ordered_json(xml.number(task, "weight", 1.0)) : "off";
  }
  j["read_by"] = {"myoid run-tool"};
  return j;
}

/// Lists the objects of another set that stands in a file of its own, by their classes.
ordered_json set_contents(pugi::xml_node set) {
  ordered_json j{{"kind", kPart}, {"class", set.name()}, {"name", body::OsimXml::name_of(set)}};
  for (const pugi::xml_node object : body::OsimXml::objects(set)) {
    std::string name = body::OsimXml::name_of(object);
    if (name.empty()) name = object.child("segment").text().get();
    j[object.name()].push_back(std::string(trim(name)));
  }
  j["read_by"] = {fmt::format("<{} file>", set.name())};
  return j;
}

/// Describes a part of set-ups that stands in a file of its own, or names the tool of a set-up and the command that
/// runs it.
ordered_json setup_contents(const std::string& path) {
  const body::OsimXml xml(read_text_file(path), path, body::OsimXml::Root::any);
  if (const auto loads = xml.root().child("ExternalLoads")) return loads_contents(xml, loads);
  for (const char* name : {"IKTaskSet", "TaskSet"})
    if (const auto tasks = xml.root().child(name)) return tasks_contents(xml, tasks);
  const auto first = body::OsimXml::first_element(xml.root(), {"defaults"});
  if (std::string_view(first.name()).ends_with("Set")) return set_contents(first);
  const opensim::OpensimSetup setup(path);
  ordered_json j{{"kind", "set-up of an OpenSim tool"}, {"tool", setup.kind()}, {"name", setup.name()}};
  for (const std::filesystem::path& input : setup.inputs()) {
    if (input != path) j["reads"].push_back(input.string());
  }
  for (const std::filesystem::path& input : setup.missing_inputs()) j["missing"].push_back(input.string());
  j["run"] = fmt::format("myoid run-tool {}", path);
  return j;
}

ordered_json contents_of(const InfoOptions& o) {
  if (auto contents = recording_contents(o.file)) return *std::move(contents);
  if (is_model(o.file)) return contents_of_model(o);
  if (auto contents = project_contents(o.file)) return *std::move(contents);
  const auto format = format_of(o.file);
  if (format == FileFormat::toml) return study_contents(o.file);
  if (format == FileFormat::set_up) return setup_contents(o.file);
  recording::refuse_folder(o.file);
  (void)read_text_file(o.file);  // reports a missing or empty file
  throw ReadError(o.file, 0,
                  fmt::format("files of kind '{}' are not known; known are {}", extension_of(o.file), known_endings()));
}

}  // namespace

std::string known_endings() {
  return endings_text([](const FormatEntry& entry) {
    return is_recording(entry.format) || entry.format == FileFormat::model || entry.format == FileFormat::toml ||
           entry.format == FileFormat::set_up;
  });
}

bool is_model(const std::string& file) {
  return format_of(file) == FileFormat::model || (file == "arm4" && !std::filesystem::exists(file));
}

void visit(InfoOptions& o, study::SettingVisitor& v) {
  v.path("file", o.file,
         {.says = "A recording, table, model or study; or arm4.", .required = "a file", .option = {.by_place = true}});
  visit_questions(o, v);
}

void visit_questions(InfoOptions& o, study::SettingVisitor& v) {
  v.flag("compare-compat", o.ask.compare_compat,
         {.says = "Of a model: for which muscles exact paths differ from OpenSim 4.5.2's, and by how much, over random "
                  "postures."});
  v.count("postures", o.ask.postures,
          {.says = "Random postures for --compare-compat.", .limits = study::within(1, 1000000)});
  v.flag("jumps", o.ask.jumps,
         {.says = "Of a model: where a muscle's length or moment arm jumps over the range of a coordinate."});
  visit_compat(o.compat, v);
}

ordered_json info(const InfoOptions& options) {
  check_options(options);
  ordered_json j{{"file", options.file}};
  j.update(contents_of(options));
  return j;
}

}  // namespace myoid::program
