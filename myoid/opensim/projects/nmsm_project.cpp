#include "myoid/opensim/projects/nmsm_project.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/projects/calibration_plan.h"
#include "myoid/opensim/projects/model_parts.h"
#include "myoid/opensim/projects/osimx_file.h"
#include "myoid/opensim/projects/project_xml.h"
#include "myoid/opensim/projects/trial_files.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using Quantity = MuscleQuantity;
using body::OsimXml;

/// A project while it is read.
class NmsmReader {
 public:
  explicit NmsmReader(const ProjectFolder& folder) : folder_(folder) { project_.dialect = Dialect::nmsm; }

  Project run(const RootedFile& main) {
    const OsimXml xml = read_document(main.path);
    if (osimx_model(xml)) {
      take_osimx(xml);
      read_model(xml, osimx_model(xml), "associated_osim_model", false);
      plan_numbers(xml, {});
    } else {
      const pugi::xml_node document = OsimXml::first_element(xml.root());
      const pugi::xml_node tool = std::string_view(document.name()) == kTool ? document : document.child(kTool);
      if (!tool) xml.fail(document, "<{}> expected, found none", kTool);
      project_.set_up = main.path;
      read_settings(xml, tool);
    }
    read_trial_tables(project_);
    return std::move(project_);
  }

 private:
  static constexpr const char* kTool = "MuscleTendonPersonalizationTool";

  void take_osimx(const OsimXml& xml) {
    project_.subject = xml.path();
    project_.muscles = read_osimx(xml);
    project_.is_calibrated = !project_.muscles.empty();
    note_unknown_elements(xml, osimx_model(xml), osimx_elements(), project_.remarks);
  }

  void read_model(const OsimXml& xml, pugi::xml_node parent, const char* name, bool is_required) {
    const std::string named = xml.word(parent, name);
    const NamedFile found = folder_.find(xml.path(), named);
    if (!found.exists) {
      const std::string missing = named.empty() ? "is not named" : missing_file(xml.path().parent_path(), named);
      if (is_required) xml.fail(parent, "<{}> {}: {}", name, named, missing);
      note_reading(project_.remarks, xml.path(),
                   fmt::format("the model '{}': {}; the lengths before the calibration and the muscles of each channel "
                               "are not known",
                               named, missing));
      return;
    }
    project_.model = found.path;
    parts_ = read_model_parts(found.path);
    if (project_.muscles.empty()) project_.muscles = parts_.muscles;
    if (project_.is_calibrated) set_starts(project_, parts_.muscles);
  }

  void read_settings(const OsimXml& xml, pugi::xml_node tool) {
    take_result(xml, tool);
    read_model(xml, tool, "input_model_file", true);
    take_start(xml, tool);
    for (std::string& name : xml.words(tool, "coordinate_list")) project_.dofs.push_back({std::move(name), {}, true});
    read_channels(xml, tool);
    plan_numbers(xml, tool);
    list_trials(xml, tool);
  }

  /// Takes the .osimx of the folder that the settings do not name as an input.
  void take_result(const OsimXml& xml, pugi::xml_node tool) {
    const NamedFile input = folder_.find(xml.path(), xml.word(tool, "input_osimx_file"));
    std::vector<fs::path> results;
    for (const RootedFile& each : folder_.with_root("NMSMPipelineDocument"))
      if (each.roots.back() == "OsimxModel" && (!input.exists || !fs::equivalent(each.path, input.path)))
        results.push_back(each.path);
    if (results.empty()) {
      note_reading(project_.remarks, xml.path(), "an .osimx of results is missing: nothing is calibrated yet");
      return;
    }
    take_osimx(read_document(results.back()));
    if (results.size() > 1)
      note_reading(project_.remarks, xml.path(),
                   fmt::format("{} of {} .osimx files is taken", results.back().string(), results.size()));
  }

  void take_start(const OsimXml& xml, pugi::xml_node tool) {
    const NamedFile input = folder_.find(xml.path(), xml.word(tool, "input_osimx_file"));
    if (!input.exists || !project_.is_calibrated) return;
    project_.start = input.path;
    set_starts(project_, read_osimx(read_document(input.path)));
  }

  void read_channels(const OsimXml& xml, pugi::xml_node tool) {
    std::vector<std::string> missing;
    const auto members = [&](const char* element, const auto& take) {
      for (const std::string& name : xml.words(tool, element)) {
        const auto group = parts_.groups.find(name);
        if (group == parts_.groups.end()) {
          missing.push_back(name);
          continue;
        }
        for (const std::string& muscle : group->second) take(name, muscle);
      }
    };
    members("collected_emg_channel_muscle_groups", [&](const std::string& channel, const std::string& name) {
      project_.has_mapping = true;
      if (ProjectMuscle* muscle = project_.find(name)) muscle->inputs.push_back({channel, 1.0});
    });
    members("missing_emg_channel_muscle_groups",
            [&](const std::string&, const std::string& name) { project_.synthesized.push_back(name); });
    if (!missing.empty())
      note_reading(project_.remarks, project_.model,
                   fmt::format("the model lacks the muscle groups {}", name_list(missing)));
  }

  /// Counts what the enabled tasks vary, which is every number that they do not leave by `false`; without tasks, all
  /// that the .osimx holds.
  void plan_numbers(const OsimXml& xml, pugi::xml_node tool) {
    if (!project_.is_calibrated) return;
    std::vector<std::string> muscles;
    for (const ProjectMuscle& muscle : project_.muscles) muscles.push_back(muscle.name);
    std::vector<pugi::xml_node> tasks;
    // Each spelling of a version.
    for (const std::string name : {"MTPTask", "MuscleTendonPersonalizationTask"})
      for (const pugi::xml_node task : tool.child((name + "List").c_str()).children(name.c_str()))
        if (xml.flag(task, "is_enabled", true)) tasks.push_back(task);
    if (tasks.empty()) {
      note_reading(
          project_.remarks, project_.subject,
          "no task tells what was calibrated: all its numbers within the optimizer's usual ranges are counted");
      tasks.emplace_back();
    }
    for (const pugi::xml_node task : tasks) {
      for (const OsimxNumber& number : osimx_numbers()) {
        if (*number.flag == '\0' || (task && !xml.flag(task, number.flag, true))) continue;
        const bool is_shared = number.quantity == Quantity::delay && task &&
                               !xml.flag(task, "muscle_specific_electromechanical_delays", true);
        plan(project_,
             {.quantity = number.quantity,
              .sharing = is_shared ? Sharing::all : Sharing::single,
              .bounds = number.bounds,
              .is_relative = number.is_length},
             muscles);
      }
    }
  }

  /// Lists the trials of the data folder by their EMG. Where none is named, it is the folder of the settings.
  void list_trials(const OsimXml& xml, pugi::xml_node tool) {
    const std::string named = xml.word(tool, "data_directory");
    const fs::path beside = xml.path().parent_path();
    fs::path data = named.empty() ? beside : native_path(beside, named);
    std::error_code ignored;
    if (!named.empty() && !fs::is_directory(data, ignored)) data = beside / last_part(named);
    const std::vector<std::string> prefixes = xml.words(tool, "trial_prefixes");
    std::set<std::string> other_coordinates;
    for (const fs::path& file : folder_.files()) {
      if (format_of(file) != FileFormat::storage || !fs::equivalent(file.parent_path(), data / "EMGData", ignored))
        continue;
      ProjectTrial trial{.name = file.stem().string(), .is_calibrating = true};
      if (!prefixes.empty() && std::none_of(prefixes.begin(), prefixes.end(),
                                            [&](const std::string& prefix) { return trial.name.starts_with(prefix); }))
        continue;
      trial.files.push_back({.role = TrialRole::emg, .path = file, .exists = true});
      for (const auto& [folder, role] :
           {std::pair{"IDData", TrialRole::torques}, std::pair{"IKData", TrialRole::motion}}) {
        const fs::path path = data / folder / file.filename();
        trial.files.push_back({.role = role, .path = path, .exists = fs::exists(path, ignored)});
      }
      add_muscle_analysis(data / "MAData" / trial.name, trial, other_coordinates);
      project_.trials.push_back(std::move(trial));
    }
    if (project_.trials.empty())
      note_reading(project_.remarks, xml.path(), fmt::format("no trial is in {}", (data / "EMGData").string()));
    if (!other_coordinates.empty())
      note_reading(project_.remarks, xml.path(),
                   fmt::format("moment arms of coordinates that <coordinate_list> lacks are not used: {}",
                               name_list(other_coordinates)));
  }

  void add_muscle_analysis(const fs::path& analysis, ProjectTrial& trial, std::set<std::string>& other_coordinates) {
    constexpr std::string_view kArm = "_MomentArm_";
    for (const fs::path& file : folder_.files()) {
      if (file.parent_path() != analysis || format_of(file) != FileFormat::storage) continue;
      const std::string stem = file.stem().string();
      const auto at = stem.find(kArm);
      if (at != std::string::npos) {
        const std::string dof = stem.substr(at + kArm.size());
        const bool is_used =
            std::any_of(project_.dofs.begin(), project_.dofs.end(), [&](const auto& each) { return each.name == dof; });
        if (!is_used) {
          other_coordinates.insert(dof);
          continue;
        }
        trial.files.push_back({.role = TrialRole::moment_arms, .path = file, .exists = true, .dof = dof});
      } else if (stem.ends_with("_Length")) {
        trial.files.push_back({.role = TrialRole::lengths, .path = file, .exists = true});
      } else if (stem.ends_with("_Velocity")) {
        trial.files.push_back({.role = TrialRole::velocities, .path = file, .exists = true});
      }
    }
  }

  const ProjectFolder& folder_;
  Project project_;
  ModelParts parts_;
};

}  // namespace

Project read_nmsm_project(const ProjectFolder& folder, const RootedFile& main) { return NmsmReader(folder).run(main); }

}  // namespace myoid::opensim
