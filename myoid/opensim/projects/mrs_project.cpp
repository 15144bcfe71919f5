#include "myoid/opensim/projects/mrs_project.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/projects/calibration_plan.h"
#include "myoid/opensim/projects/matlab_script.h"
#include "myoid/opensim/projects/model_parts.h"
#include "myoid/opensim/projects/project_xml.h"
#include "myoid/opensim/projects/trial_files.h"
#include "myoid/recording/tables/csv_reader.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using Quantity = MuscleQuantity;

/// A number that the solver estimates: its list of muscles, its bounds as factors of the model's number, and the
/// muscles that share it.
struct Estimated {
  Quantity quantity;
  std::vector<const char*> muscles, coupled;  ///< By the spellings of its versions.
  const char *lower, *upper;
};
const std::vector<Estimated>& estimated() {
  static const std::vector<Estimated> kEstimated{{Quantity::tendon_stiffness,
                                                  {"Misc.Estimate_TendonStiffness", "Misc.Estimate_TendonStifness"},
                                                  {"Misc.Coupled_TendonStiffness", "Misc.Coupled_TendonStifness"},
                                                  "Misc.lb_kT_scaling",
                                                  "Misc.ub_kT_scaling"},
                                                 {Quantity::optimal_fiber_length,
                                                  {"Misc.Estimate_OptFL"},
                                                  {"Misc.Coupled_fiber_length"},
                                                  "Misc.lb_lMo_scaling",
                                                  "Misc.ub_lMo_scaling"},
                                                 {Quantity::tendon_slack_length,
                                                  {"Misc.Estimate_OptFL"},
                                                  {"Misc.Coupled_slack_length"},
                                                  "Misc.lb_lTs_scaling",
                                                  "Misc.ub_lTs_scaling"}};
  return kEstimated;
}

/// A project while it is read.
class MrsReader {
 public:
  MrsReader(const ProjectFolder& folder, const fs::path& script)
      : folder_(folder), script_(script), values_(matlab_assignments(read_text_file(script))) {
    project_.dialect = Dialect::mrs;
    project_.set_up = script;
  }

  Project run() {
    read_model();
    read_dofs();
    read_muscles();
    read_channels();
    plan_numbers();
    list_trials();
    for (const auto& [name, line] : computed_) {
      note_reading(project_.remarks, script_, fmt::format("line {}: {} is computed, and not known here", line, name),
                   name);
      project_.remarks.back().value = static_cast<double>(line);
    }
    read_trial_tables(project_);
    name_channels_as_files();
    return std::move(project_);
  }

 private:
  /// Returns the value of a name; null, with the line kept for a remark, if it is computed.
  const MatlabValue* value(const std::string& name) {
    const auto found = values_.find(name);
    if (found == values_.end()) return nullptr;
    if (!found->second.is_computed) return &found->second;
    computed_[name] = found->second.line;
    return nullptr;
  }
  std::vector<std::string> texts(const std::string& name) {
    const MatlabValue* found = value(name);
    return found == nullptr ? std::vector<std::string>() : found->all_texts();
  }
  std::vector<std::string> texts(const std::vector<const char*>& names) {
    for (const char* name : names)
      if (std::vector<std::string> found = texts(name); !found.empty()) return found;
    return {};
  }
  std::optional<double> number(const std::string& name) {
    const MatlabValue* found = value(name);
    if (found == nullptr || found->numbers.empty() || found->numbers[0].empty()) return std::nullopt;
    return found->numbers[0][0];
  }

  void read_model() {
    for (const char* name : {"Misc.model_path", "model_path"}) {
      const std::vector<std::string> named = texts(name);
      if (named.empty()) continue;
      const NamedFile found = folder_.find(script_, named.front());
      if (found.exists) {
        project_.model = found.path;
        model_ = read_model_parts(found.path);
        return;
      }
      note_reading(project_.remarks, script_,
                   fmt::format("the model '{}': {}; the numbers of its muscles are not known", named.front(),
                               missing_file(script_.parent_path(), named.front())));
      return;
    }
  }

  void read_dofs() {
    std::set<std::string> seen;
    for (const std::string& name : texts("Misc.DofNames_Input"))
      if (seen.insert(name).second) project_.dofs.push_back({name, {}, true});
  }

  void add_muscle(const std::string& name) {
    if (project_.find(name) != nullptr) return;
    const auto of_model =
        std::find_if(model_.muscles.begin(), model_.muscles.end(), [&](const auto& each) { return each.name == name; });
    if (of_model == model_.muscles.end() && !model_.muscles.empty()) {
      absent_.insert(name);
      return;
    }
    ProjectMuscle muscle = of_model == model_.muscles.end() ? ProjectMuscle{name, {}, {}} : *of_model;
    for (auto& [quantity, number] : muscle.numbers) number.start = number.value;
    project_.muscles.push_back(std::move(muscle));
  }

  /// Takes the muscles that are named; all of the model where the solver chooses them by their moment arms.
  void read_muscles() {
    for (const std::string& name : texts("Misc.MuscleNames_Input")) add_muscle(name);
    if (project_.muscles.empty())
      for (const ProjectMuscle& each : model_.muscles) add_muscle(each.name);
    for (const char* list : {"Misc.EMGSelection", "Misc.USSelection"})
      for (const std::string& name : texts(list)) add_muscle(name);
    for (const Estimated& each : estimated())
      for (const std::string& name : texts(each.muscles)) add_muscle(name);
    if (!absent_.empty())
      note_reading(project_.remarks, script_,
                   fmt::format("left out, since the model lacks the muscles: {}", name_list(absent_)),
                   name_list(absent_));
  }

  void drive(const std::string& muscle, const std::string& channel) {
    if (ProjectMuscle* found = project_.find(muscle); found != nullptr && found->inputs.empty())
      found->inputs.push_back({channel, 1.0});
  }

  void read_channels() {
    const std::vector<std::string> selected = texts("Misc.EMGSelection"), headers = texts("Misc.EMGheaders");
    if (selected.empty() || computed_.contains("Misc.EMGheaders")) return read_table_of_channels();
    project_.has_mapping = true;
    std::set<std::string> without;
    for (const std::string& name : selected) {
      drive(name, name);
      if (!headers.empty() && std::find(headers.begin(), headers.end(), name) == headers.end()) without.insert(name);
    }
    if (!without.empty())
      note_reading(project_.remarks, script_,
                   fmt::format("Misc.EMGheaders lacks channels of Misc.EMGSelection: {}", name_list(without)),
                   "Misc.EMGheaders");
    const MatlabValue* copies = value("Misc.EMG_MuscleCopies");
    for (const std::vector<std::string>& row :
         copies == nullptr ? std::vector<std::vector<std::string>>() : copies->texts)
      for (std::size_t k = 1; k < row.size(); ++k) drive(row[k], row.front());
  }

  /// Gives the muscles the channels of the EMG files. Misc.EMGheaders stands in place of the names of all their
  /// columns, that of the time first, whatever these are. Throws ReadError where files name such a column differently.
  void name_channels_as_files() {
    const std::vector<std::string> headers = texts("Misc.EMGheaders");
    std::set<std::string> renamed;
    for (ProjectMuscle& muscle : project_.muscles)
      for (ProjectInput& input : muscle.inputs) {
        const auto place = std::find(headers.begin(), headers.end(), input.channel);
        if (place == headers.end()) continue;
        const auto column = static_cast<std::size_t>(place - headers.begin());
        if (const auto name = column_of_emg(column); name && *name != input.channel) {
          renamed.insert(fmt::format("'{}' is '{}'", input.channel, *name));
          input.channel = *name;
        }
      }
    if (!renamed.empty())
      note_reading(
          project_.remarks, script_,
          fmt::format("Misc.EMGheaders names the columns of the EMG by their order: {}", fmt::join(renamed, ", ")),
          "Misc.EMGheaders");
  }

  /// Returns the name that the EMG files give a column, the time being column 0; nothing where they have none there.
  [[nodiscard]] std::optional<std::string> column_of_emg(std::size_t column) const {
    std::optional<std::string> name;
    for (const ProjectTrial& trial : project_.trials)
      for (const TrialFile& file : trial.files) {
        if (column == 0 || column > file.channels.size()) continue;
        const std::string& here = file.channels[column - 1];
        if (name && *name != here)
          throw ReadError(script_, values_.at("Misc.EMGheaders").line,
                          fmt::format("Misc.EMGheaders: column {} is '{}' in one file of EMG and '{}' in {}; give both "
                                      "one name",
                                      column + 1, *name, here, file.path.string()));
        name = here;
      }
    return name;
  }

  /// Reads the channels of the muscles from a table of names.
  void read_table_of_channels() {
    const bool has_emg = values_.contains("Misc.EMGfile") || values_.contains("Misc.EMGSelection");
    const NamedFile table = folder_.find(script_, "muscles.csv");
    if (!table.exists) {
      if (has_emg)
        note_reading(
            project_.remarks, script_,
            "the script does not tell the channels of the muscles in words; a table muscles.csv beside it with "
            "the columns muscle, emg would",
            "muscles.csv");
      return;
    }
    const recording::CsvTable cells = recording::read_csv_table(table.path);
    const auto column = [&](std::string_view name) {
      return std::find(cells.names.begin(), cells.names.end(), name) - cells.names.begin();
    };
    const std::ptrdiff_t muscle = column("muscle"), emg = column("emg");
    const auto count = static_cast<std::ptrdiff_t>(cells.names.size());
    if (muscle == count || emg == count)
      throw ReadError(table.path, cells.header_line,
                      fmt::format("expected columns muscle and emg, found {}", name_list(cells.names)));
    project_.has_mapping = true;
    for (const std::vector<std::string>& row : cells.rows) {
      const std::string &name = row[static_cast<std::size_t>(muscle)], &channel = row[static_cast<std::size_t>(emg)];
      if (name.empty()) continue;
      add_muscle(name);
      if (!channel.empty()) drive(name, channel);
    }
    note_reading(project_.remarks, table.path, "the channels of the muscles are those of this table");
  }

  void plan_numbers() {
    for (const Estimated& each : estimated()) {
      const std::vector<std::string> muscles = texts(each.muscles);
      const std::optional<double> lower = number(each.lower), upper = number(each.upper);
      const std::vector<std::string> coupled = texts(each.coupled);
      if (each.quantity == Quantity::tendon_stiffness)
        for (const std::string& name : muscles) give(name, each.quantity);
      PlannedQuantity planned{.quantity = each.quantity, .is_relative = true};
      if (lower && upper && *upper > *lower) planned.bounds = CalibrationBounds{*lower, *upper};
      planned.sharing = Sharing::groups;
      if (!coupled.empty()) planned.groups.push_back(coupled);
      for (const std::string& name : muscles)
        if (std::find(coupled.begin(), coupled.end(), name) == coupled.end()) planned.groups.push_back({name});
      plan(project_, planned, muscles);
    }
    if (number("Misc.EMGconstr").value_or(0.0) != 1.0) return;
    project_.objective = "EMG constrained";
    const std::vector<std::string> selected = texts("Misc.EMGSelection");
    for (const std::string& name : selected) give(name, Quantity::emg_scale);
    PlannedQuantity scale{.quantity = Quantity::emg_scale};
    if (const MatlabValue* bounds = value("Misc.BoundsScaleEMG"))
      if (bounds->numbers.size() == 1 && bounds->numbers[0].size() == 2 &&
          bounds->numbers[0][1] > bounds->numbers[0][0])
        scale.bounds = CalibrationBounds{bounds->numbers[0][0], bounds->numbers[0][1]};
    plan(project_, scale, selected);
  }

  /// Gives a muscle a factor that begins at 1.
  void give(const std::string& name, Quantity quantity) {
    if (ProjectMuscle* muscle = project_.find(name))
      muscle->numbers.try_emplace(quantity, ProjectNumber{.value = 1.0, .start = 1.0});
  }

  void list_trials() {
    struct List {
      TrialRole role;
      std::vector<std::string> names;
    };
    const std::vector<List> lists{{TrialRole::motion, texts("Misc.IKfile")},
                                  {TrialRole::torques, texts("Misc.IDfile")},
                                  {TrialRole::emg, texts("Misc.EMGfile")},
                                  {TrialRole::ultrasound, texts("Misc.USfile")}};
    const MatlabValue* time = value("time");
    std::size_t count = 0;
    for (const List& list : lists) count = std::max(count, list.names.size());
    for (std::size_t k = 0; k < count; ++k) {
      ProjectTrial trial{.is_calibrating = true};
      for (const List& list : lists) {
        if (k >= list.names.size()) continue;
        if (trial.name.empty()) trial.name = fs::path(last_part(list.names[k])).stem().string();
        const NamedFile found = folder_.find(script_, list.names[k]);
        trial.files.push_back({.role = list.role, .path = found.path.lexically_normal(), .exists = found.exists});
      }
      if (time != nullptr && !time->numbers.empty()) {
        const std::vector<double>& row = time->numbers[std::min(k, time->numbers.size() - 1)];
        if (row.size() == 2 && row[1] > row[0]) trial.used = Stretch{row[0], row[1]};
      }
      project_.trials.push_back(std::move(trial));
    }
    for (const List& list : lists)
      if (!list.names.empty() && list.names.size() != count)
        note_reading(project_.remarks, script_,
                     fmt::format("{} of {} trials have a file of {}", list.names.size(), count, choice_name(list.role)),
                     std::string(choice_name(list.role)));
  }

  const ProjectFolder& folder_;
  fs::path script_;
  std::map<std::string, MatlabValue> values_;
  std::map<std::string, std::size_t> computed_;  ///< Lines of computed names that were asked for.
  std::set<std::string> absent_;
  ModelParts model_;
  Project project_;
};

}  // namespace

bool is_mrs_script(const fs::path& path) {
  constexpr std::uintmax_t kLargestScript_bytes = std::uintmax_t{1} << 20U;
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  if (failed || size > kLargestScript_bytes) return false;
  try {
    const std::string text = read_text_file(path);
    return (text.find("solveMuscleRedundancy") != std::string::npos ||
            text.find("MuscleTendonEstimator") != std::string::npos) &&
           matlab_assignments(text).contains("Misc.IKfile");
  } catch (const InvalidInput&) {
    return false;
  }
}

Project read_mrs_project(const ProjectFolder& folder, const fs::path& script) {
  return MrsReader(folder, script).run();
}

}  // namespace myoid::opensim
