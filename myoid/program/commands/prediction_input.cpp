#include "myoid/program/commands/prediction_input.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/run/effort_prior.h"
#include "myoid/run/run_study.h"
#include "myoid/study/read_study.h"
#include "myoid/study/run_identity.h"
#include "myoid/study/run_record.h"

namespace myoid::program {
namespace {

using fit::TrialData;

/// Returns the use of a trial in the run; empty: the run has no such trial. A trial that pauses is
/// in the run as parts, whose names begin with the trial's name.
std::optional<study::Use> use_in(const study::RunRecord& run, const std::string& trial) {
  const auto found = run.uses.lower_bound(trial);
  if (found == run.uses.end() || !found->first.starts_with(trial)) return std::nullopt;
  return choice_named<study::Use>(found->second);
}

/// Returns the study of the run: its trials keep their uses, further trials are held back.
study::Study study_of_run(const study::RunRecord& run) {
  study::Study study = study::read_study(run.study);
  study.identify.methods = {fit::Method::torque};
  for (const auto& [name, use] : run.uses) {
    const auto is_it = [&recorded = name](const study::TrialSpec& trial) { return recorded.starts_with(trial.name); };
    if (std::ranges::none_of(study.trials, is_it))
      throw InvalidInput(
          fmt::format("{}: the trial '{}' of the run is missing; run the study again", run.study.string(), name));
  }
  for (study::TrialSpec& trial : study.trials)
    trial.use = use_in(run, trial.name).value_or(study.fits(trial) ? study::Use::validation : trial.use);
  return study;
}

/// Returns muscles with their channels: "BIC by biceps".
std::vector<std::string> muscles_of(const run::FitInput& input) {
  std::vector<std::string> list;
  for (const fit::MuscleSetup& muscle : input.data.muscles)
    list.push_back(fmt::format("{} by {}", muscle.name, muscle.emg_channel));
  return list;
}

/// Returns the trials of another study of the same person and muscles, all held back; warns of another person.
std::vector<TrialData> other_trials(const std::filesystem::path& folder,
                                    const PredictionChoice& choice,
                                    PredictionInput& input) {
  study::Study study = study::read_study(choice.study);
  const study::IdentityDifferences unlike =
      study::differences(study::identity_of(study), study::read_run_identity(folder));
  for (const std::vector<std::string>& found : {unlike.grave, unlike.other})
    for (const std::string& text : found)
      input.remarks.push_back({.says = fmt::format("{}: {}, in the run; the bands hold for the run's person and model",
                                                   choice.study, text)});
  study.identify.methods = {fit::Method::torque};
  if (!run::from_maximal_effort(study.emg))
    input.remarks.push_back(
        {.code = RemarkCode::no_maximal_contraction,
         .says = fmt::format("{}: its EMG is not relative to a maximal contraction of its own; the prediction takes "
                             "the greatest effort of both studies for the same",
                             choice.study)});
  run::StudyResult other = run::study_data(
      study, {.start_s = choice.start_s, .end_s = choice.end_s, .progress = choice.progress, .share_forces = false});
  input.files.insert(input.files.end(), other.source.files.begin(), other.source.files.end());
  const std::vector<std::string> found = muscles_of(other.fit_input), wanted = muscles_of(input.fit);
  if (found != wanted)
    throw InvalidInput(fmt::format("{}: found the muscles {}, expected those of the run: {}", choice.study,
                                   fmt::join(found, ", "), fmt::join(wanted, ", ")));
  for (TrialData& trial : other.fit_input.data.trials) trial.calibration = false;
  fit::expect_activations_of(input.fit.data, other.fit_input.data.trials);
  return std::move(other.fit_input.data.trials);
}

/// Returns the trials of these names; without names all trials that took no part in the fit.
std::vector<TrialData> chosen(const std::vector<TrialData>& trials, const std::vector<std::string>& names) {
  std::vector<TrialData> found;
  for (const TrialData& trial : trials) {
    if (names.empty() && !trial.calibration) found.push_back(trial);
  }
  if (names.empty() && found.empty())
    throw InvalidInput(
        "every trial of the study took part in the fit: name with --trials which to predict, add trials with use = "
        "\"validation\" to the study, or give another study with --study");
  for (const std::string& name : names) {
    const auto at = std::ranges::find_if(trials, [&](const TrialData& trial) { return trial.name == name; });
    if (at == trials.end()) {
      throw InvalidInput(
          fmt::format("--trials: no trial '{}' has motion and EMG{}", name, not_among(name, trials, &TrialData::name)));
    }
    found.push_back(*at);
  }
  return found;
}

}  // namespace

PredictionInput prediction_input(const std::filesystem::path& folder, const PredictionChoice& choice) {
  const study::RunRecord run = study::read_run_record(folder);
  run::StudyResult base =
      run::study_data(study_of_run(run),
                      {.start_s = run.start_s, .end_s = run.end_s, .progress = choice.progress, .share_forces = false});
  study::refuse_changed(base.source.files, run, run.study);
  PredictionInput input{.study = std::move(base.source.study),
                        .fit = std::move(base.fit_input),
                        .trials = {},
                        .files = std::move(base.source.files),
                        .remarks = {}};
  const std::vector<TrialData> all = choice.study.empty() ? input.fit.data.trials : other_trials(folder, choice, input);
  input.trials = chosen(all, choice.trials);
  return input;
}

}  // namespace myoid::program
