#include "myoid/study/read_study.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/toml_table.h"
#include "myoid/recording/recording.h"
#include "myoid/study/setting_reader.h"
#include "myoid/study/study_settings.h"

namespace myoid::study {
namespace {

using ground::TomlTable;

using Names = std::set<std::string>;

[[noreturn]] void refuse(const Study& study, const std::string& message) { throw ReadError(study.file, 0, message); }

/// Returns the names of the [[muscle]] tables; refuses repeated names.
Names muscle_names(const Study& study) {
  if (study.muscles.empty())
    refuse(study,
           "no [[muscle]]; add one table per muscle to identify, with name, osim and emg. Without EMG no muscle can be "
           "identified: `ik`, `id` and `so` do without");
  Names names;
  for (const MuscleSpec& muscle : study.muscles) {
    if (!names.insert(muscle.name).second) refuse(study, fmt::format("two [[muscle]] are named '{}'", muscle.name));
  }
  return names;
}

void check_muscles(const Study& study, const Names& names) {
  for (const MuscleSpec& muscle : study.muscles) {
    if (!muscle.same_as) continue;
    const auto other =
        std::ranges::find_if(study.muscles, [&](const MuscleSpec& m) { return m.name == *muscle.same_as; });
    if (other == study.muscles.end() || other->same_as)
      refuse(study, fmt::format("[[muscle]] {}: emg same_as \"{}\" names no muscle with an electrode{}", muscle.name,
                                *muscle.same_as, not_among(*muscle.same_as, names)));
  }
  const auto without = [](const MuscleSpec& m) { return m.without_emg.has_value(); };
  if (std::ranges::all_of(study.muscles, without))
    refuse(study,
           "every [[muscle]] has without_emg, expected emg of one at least: without EMG no muscle can be identified: "
           "`ik`, `id` and `so` do without");
  for (const std::string& wanted : study.identify.muscles) {
    if (!names.contains(wanted))
      refuse(study, fmt::format("[identify] muscles: '{}' is no [[muscle]]{}", wanted, not_among(wanted, names)));
  }
}

void check_rule(const Study& study, const fit::ParameterRule& rule, const Names& names) {
  if (fit::is_lag(rule.parameter) && !study.identify.dynamics)
    refuse(study, fmt::format("[[parameter]] {}: the lags of the activation act only with dynamics = true in "
                              "[identify]; add that, or leave the table out",
                              rule.parameter));
  if (fit::parameter_field(rule.parameter).scope != fit::Scope::muscle) return;
  for (const std::string& owner : rule.owners) {
    if (!names.contains(owner))
      refuse(study,
             fmt::format("[[parameter]] {}: '{}' is no [[muscle]]{}", rule.parameter, owner, not_among(owner, names)));
  }
}

/// Refuses a study whose trials give too little for a study without a body, or too many or few moment arms.
void check_given(const Study& study) {
  const std::size_t joints = study_coordinates(study.model).size();
  const bool to_torques =
      std::ranges::find(study.identify.methods, fit::Method::torque) != study.identify.methods.end();
  for (const TrialSpec& trial : study.trials) {
    const std::size_t arms = trial.given.moment_arms.size();
    if (arms > 0 && arms != joints)
      refuse(study, fmt::format("trial '{}': found {} files of moment_arms, expected {}: one for each coordinate of "
                                "[model]",
                                trial.name, arms, joints));
    if (study.model.is_none() && trial.markers)
      refuse(study, fmt::format("trial '{}' has markers, but the study has no model that carries them: give [model] "
                                "file, or 'motion'",
                                trial.name));
    if (!study.model.is_none() && trial.moves() && !trial.markers && !trial.motion)
      refuse(study,
             fmt::format("trial '{}' has neither markers nor motion, which the model of the study needs; without "
                         "a model ([model] builtin = \"none\") the given stages are enough",
                         trial.name));
    if (!study.model.is_none() || !trial.moves()) continue;
    if (to_torques ? !trial.given.tells_torques() : !trial.given.needs_no_body())
      refuse(study, fmt::format("trial '{}': the study has no model, so the trial must give lengths, moment_arms and "
                                "torques; methods force and paper take lengths and forces",
                                trial.name));
  }
  if (!study.model.is_none()) return;
  for (const MuscleSpec& muscle : study.muscles) {
    for (const char* name : {"max_isometric_force", "optimal_fiber_length"}) {
      if (!muscle.start.contains(name))
        refuse(study, fmt::format("[[muscle]] {}: the study has no model, so start must hold {}", muscle.name, name));
    }
  }
}

void check_trials(const Study& study) {
  if (study.trials.empty())
    refuse(study, "no [[trial]]; add one table per recording, with name, markers or motion, and emg");
  const bool any_to_learn_from = std::ranges::any_of(study.trials, [&](const TrialSpec& t) { return study.fits(t); });
  if (!any_to_learn_from && !study.identify.methods.empty())
    refuse(study,
           "no [[trial]] has use = \"calibration\" or \"isometric\", from which parameters are found; the others only "
           "test or scale them");
  Names names;
  for (const TrialSpec& trial : study.trials) {
    if (!names.insert(trial.name).second) refuse(study, fmt::format("two [[trial]] are named '{}'", trial.name));
    if (trial.load_cell && !study.load_cell)
      refuse(study, fmt::format("trial '{}' has a load_cell; a table [load_cell] must describe it", trial.name));
  }
}

void check_norms(const Study& study) {
  Names names;
  for (const TrialSpec& trial : study.trials) names.insert(trial.name);
  for (const NormSpec& norm : study.norms) {
    for (const std::string& trial : norm.trials)
      if (!names.contains(trial))
        refuse(study, fmt::format("[[norm]] {}: '{}' is no [[trial]]{}", norm.name, trial, not_among(trial, names)));
  }
}

/// Returns true if no trial needs a model.
bool gives_everything(const Study& study) {
  const auto moving = [](const TrialSpec& trial) { return trial.moves(); };
  return std::ranges::any_of(study.trials, moving) && std::ranges::all_of(study.trials, [](const TrialSpec& trial) {
           return !trial.moves() || (!trial.markers && trial.given.needs_no_body());
         });
}

/// Refuses tables with wrong references to each other.
void check_references(const Study& study) {
  const Names muscles = muscle_names(study);
  check_muscles(study, muscles);
  for (const fit::ParameterRule& rule : study.parameters) check_rule(study, rule, muscles);
  check_trials(study);
  check_given(study);
  check_norms(study);
}

}  // namespace

Study parse_study(std::string_view text, const std::filesystem::path& file) {
  const toml::table root = parse_toml(text, file);
  TomlTable table(root, file, "study");
  Study study;
  study.file = file;
  SettingReader reader(table, file.parent_path());
  visit(study, reader);
  table.finish();
  if (!study.model.file && study.model.builtin.empty()) study.model.builtin = gives_everything(study) ? "none" : "arm4";
  if (study.model.is_none() && !root["model"]["coordinate"])
    refuse(study, "the study has no model, so [model] coordinate must name the joint of the torques");
  for (MuscleSpec& muscle : study.muscles) {
    if (!muscle.same_as) continue;
    for (const MuscleSpec& other : study.muscles) {
      if (other.name == *muscle.same_as) muscle.emg = other.emg;
    }
  }
  const bool all_have_emg =
      std::ranges::none_of(study.muscles, [](const MuscleSpec& m) { return m.without_emg.has_value(); });
  if (!all_have_emg && !root["identify"]["method"]) {
    study.identify.methods = {fit::Method::torque};
    study.identify.leaves_out_paper = true;
  }
  study.emg.has_mvc = std::ranges::any_of(study.trials, [](const TrialSpec& t) { return t.use == Use::mvc; });
  check_references(study);
  return study;
}

fit::UnseenSpreads read_beliefs(const std::filesystem::path& file) {
  const toml::table root = parse_toml(read_text_file(file), file);
  TomlTable whole(root, file, "study");
  std::optional<TomlTable> table = whole.table("beliefs");
  if (!table) throw ReadError(file, 0, "there is no table [beliefs]");
  return read_spec<fit::UnseenSpreads>(*std::move(table), file.parent_path());
}

Study read_study(const std::filesystem::path& file) {
  recording::refuse_folder(file);
  const auto format = format_of(file);
  // A table of text may be a study with another ending.
  if (format && is_recording(*format) && *format != FileFormat::text_table && std::filesystem::is_regular_file(file))
    throw ReadError(file, 0, "this is a recording, and a study is asked for; draft one: myoid init STUDY --from {}",
                    shell_word(file.string()));
  return parse_study(read_text_file(file), file);
}

}  // namespace myoid::study
