#include "myoid/study/study.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/files/text_file.h"
#include "myoid/files/toml_table.h"
#include "myoid/identification/parameters.h"
#include "myoid/study/setting_reader.h"
#include "myoid/study/study_settings.h"

namespace myoid {
namespace {

using recording::TomlTable;

void check_references(const Study& study) {
  const auto refuse = [&](const std::string& message) { throw ReadError(study.file, 0, message); };
  if (study.muscles.empty()) {
    refuse("no [[muscle]]; add one table per muscle to identify, with name, osim and emg");
  }
  if (study.trials.empty())
    refuse("no [[trial]]; add one table per recording, with name, markers or motion, and emg");
  std::set<std::string> muscles;
  for (const MuscleSpec& muscle : study.muscles) {
    if (!muscles.insert(muscle.name).second)
      refuse(fmt::format("two [[muscle]] are named '{}'", muscle.name));
  }
  for (const MuscleSpec& muscle : study.muscles) {
    if (!muscle.same_as) continue;
    const auto other = std::find_if(study.muscles.begin(), study.muscles.end(),
                                    [&](const MuscleSpec& m) { return m.name == *muscle.same_as; });
    if (other == study.muscles.end() || other->same_as) {
      refuse(fmt::format(
          "[[muscle]] {}: emg same_as \"{}\" names no muscle with an electrode; there are {}",
          muscle.name, *muscle.same_as, fmt::join(muscles, ", ")));
    }
  }
  for (const std::string& wanted : study.identify.muscles) {
    if (!muscles.contains(wanted)) {
      refuse(fmt::format("[identify] muscles: '{}' is no [[muscle]]; there are {}", wanted,
                         fmt::join(muscles, ", ")));
    }
  }
  for (const identification::ParameterRule& rule : study.parameters) {
    if (identification::is_lag(rule.parameter) && !study.identify.dynamics) {
      refuse(
          fmt::format("[[parameter]] {}: the lags of the activation act only with dynamics = "
                      "true in [identify]; add that, or leave the table out",
                      rule.parameter));
    }
    if (identification::parameter_field(rule.parameter).scope != identification::Scope::muscle)
      continue;
    for (const std::string& owner : rule.owners) {
      if (!muscles.contains(owner)) {
        refuse(fmt::format("[[parameter]] {}: '{}' is no [[muscle]]; there are {}", rule.parameter,
                           owner, fmt::join(muscles, ", ")));
      }
    }
  }
  const bool any_to_learn_from = std::any_of(
      study.trials.begin(), study.trials.end(),
      [](const TrialSpec& t) { return t.use == Use::calibration || t.use == Use::isometric; });
  if (!any_to_learn_from && !study.identify.methods.empty()) {
    refuse(
        "no [[trial]] has use = \"calibration\" or \"isometric\", from which parameters are "
        "found; the others only test or scale them");
  }
  std::set<std::string> trials;
  for (const TrialSpec& trial : study.trials) {
    if (!trials.insert(trial.name).second)
      refuse(fmt::format("two [[trial]] are named '{}'", trial.name));
    if (trial.load_cell && !study.load_cell) {
      refuse(fmt::format("trial '{}' has a load_cell; a table [load_cell] must say what it is",
                         trial.name));
    }
  }
}

}  // namespace

Study parse_study(std::string_view text, const std::filesystem::path& file) {
  const toml::table root = recording::parse_toml(text, file);
  TomlTable table(root, file, "study");
  Study study;
  study.file = file;
  SettingReader reader(table, file.parent_path());
  visit(study, reader);
  table.finish();
  if (!study.model.file && study.model.builtin.empty()) study.model.builtin = "arm4";
  for (MuscleSpec& muscle : study.muscles) {
    if (!muscle.same_as) continue;
    for (const MuscleSpec& other : study.muscles) {
      if (other.name == *muscle.same_as) muscle.emg = other.emg;
    }
  }
  study.emg.has_mvc = std::any_of(study.trials.begin(), study.trials.end(),
                                  [](const TrialSpec& t) { return t.use == Use::mvc; });
  check_references(study);
  return study;
}

std::vector<std::string> study_coordinates(const ModelSpec& model) {
  std::vector<std::string> names{model.coordinate};
  names.insert(names.end(), model.more_coordinates.begin(), model.more_coordinates.end());
  return names;
}

std::optional<double> motion_cutoff_hz(const Study& study) {
  switch (study.motion.smoothing) {
    case Smoothing::none:
      return std::nullopt;
    case Smoothing::cutoff:
      return study.motion.cutoff_hz;
    case Smoothing::automatic:
      break;
  }
  return study.emg.lowpass_hz;
}

void restrict_trials(Study& study, std::optional<double> start_s, std::optional<double> end_s) {
  for (TrialSpec& trial : study.trials) {
    if (start_s) trial.start_s = std::max(*start_s, trial.start_s.value_or(*start_s));
    if (end_s) trial.end_s = std::min(*end_s, trial.end_s.value_or(*end_s));
    if (trial.start_s && trial.end_s && *trial.start_s >= *trial.end_s) {
      throw InvalidInput(
          fmt::format("trial '{}': it would begin at {} s and end at {} s; --start "
                      "must be before --end, and both within the trial's own times",
                      trial.name, *trial.start_s, *trial.end_s));
    }
  }
}

Study read_study(const std::filesystem::path& file) {
  return parse_study(recording::read_text_file(file), file);
}

}  // namespace myoid
