#include "myoid/run/study_validation.h"

#include <algorithm>
#include <utility>

#include "myoid/fit/methods/force.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/run/prediction_gates.h"

namespace myoid::run {
namespace {

/// Returns the study with the trials that a split leaves out held back for validation.
study::Study with_uses_of(const fit::StudyData& split, study::Study study) {
  for (study::TrialSpec& trial : study.trials) {
    for (const fit::TrialData& data : split.trials) {
      if (data.name == trial.name && !data.calibration) trial.use = study::Use::validation;
    }
  }
  return study;
}

/// Returns the data of a fold as if its left-out trials had been held back for validation.
FitInput without_left_out(const FitSource& source, const fit::StudyData& split, bool hold, const Progress& progress) {
  const study::Study study = with_uses_of(split, source.study);
  study::EmgOfTrials emg;
  std::vector<const study::TrialActivation*> known;
  for (const TrialResult& trial : source.trials) {
    emg.push_back(trial.input.emg ? &*trial.input.emg : nullptr);
    known.push_back(&trial.emg);
  }
  const study::StudyActivation seen = study::activation_with_uses(study, emg, known, source.scale);
  FitSource of_fold{study, source.model, source.trials, source.resting, {}, seen.scale};
  for (const study::TrialActivation& trial : seen.trials) of_fold.activation.push_back(&trial.activation);
  FitInput input = fit_input(of_fold, progress, hold);
  std::erase_if(input.data.trials, [&](const fit::TrialData& trial) {
    return std::ranges::none_of(split.trials, [&](const auto& of_split) { return of_split.name == trial.name; });
  });
  return input;
}

}  // namespace

StudyValidation study_validation(const FitSource& source,
                                 const FitInput& input,
                                 const fit::IdentificationResult& whole,
                                 const Progress& progress) {
  const fit::CrossValidationOptions how{.kind = source.study.identify.folds,
                                        .setting = "folds of [identify] (identify: --folds)"};
  const auto fit = [&](fit::StudyData& split, fit::EstimatorOptions& options) {
    if (how.kind != fit::FoldKind::block) {
      FitInput of_fold = without_left_out(source, split, input.nuisances_held, progress);
      split = std::move(of_fold.data);
      of_fold.options.drives = options.drives;
      of_fold.options.begin_at = options.begin_at;
      options = fit::of_a_fold(std::move(of_fold.options));
    }
    if (whole.exact) {
      if (auto exact = fit::identify_exactly(split, options)) return std::move(*exact);
    }
    return fit::identify_torque(split, options);
  };
  StudyValidation found;
  fit::EstimatorOptions options = beginning_at(whole, input.options);
  options.progress.report = progress.report;
  if (whole.method == fit::Method::force && whole.exact) return found;
  found.folds = whole.method == fit::Method::force ? fit::cross_validate_force(input.data, input.options, how)
                                                   : fit::cross_validate(input.data, fit, options, how);
  std::string why_not;
  (void)fit::splits(input.data, how, &why_not);
  if (!why_not.empty())
    found.remarks.push_back({.says = "nothing was left out of the fit to be predicted: " + why_not});
  if (std::string bad = generalises_badly(found.folds); !bad.empty())
    found.remarks.push_back({.code = RemarkCode::not_predicted, .says = std::move(bad)});
  return found;
}

}  // namespace myoid::run
