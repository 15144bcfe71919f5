#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/fit/methods/cross_validation.h"
#include "myoid/ground/core/remark.h"
#include "myoid/run/design/design_study.h"
#include "myoid/run/fit_input.h"
#include "myoid/run/study_fit.h"
#include "myoid/run/study_forces.h"
#include "myoid/run/study_inputs.h"
#include "myoid/run/trial_result.h"
#include "myoid/study/intake/study_activation.h"

namespace myoid::run {

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// All results of a run, stage by stage. The writers of files and reports receive this struct.
struct StudyResult {
  std::optional<double> start_s, end_s;  ///< As in RunOptions.
  StudySource source;                    ///< read
  std::vector<TrialResult> trials;       ///< read, activation, motion, forces; in the study's order.
  study::EmgScale emg;                   ///< activation
  std::vector<Remark> level_faults;      ///< findings: about EMG channels, over all trials.
  std::vector<RestingJoint> resting;     ///< forces
  FitInput fit_input;                    ///< data
  StudyFit fit;                          ///< fit
  std::vector<fit::Fold> folds;          ///< validation
  /// Movements that would determine more; empty without method torque, or if none is asked for.
  std::optional<DesignStudyResult> next;
  /// Not the same on another day and computer, and empty where results have to be.
  std::vector<StageTime> times;
  std::string analysed;               ///< Day of the analysis (UTC), "2026-03-01".
  std::vector<std::string> recorded;  ///< Days that the recordings state, each once, the first one first.
};

/// The quantity that is predicted for parts left out of the fit.
struct PredictedByFolds {
  std::string_view name, unit;
};
[[nodiscard]] inline PredictedByFolds predicted_by_folds(const StudyResult& result) {
  return torque_of(result.fit) == nullptr ? PredictedByFolds{"muscle force", "N"}
                                          : PredictedByFolds{"joint torque", "N m"};
}

/// Returns the run's own trials as the source of a fit.
[[nodiscard]] inline FitSource fit_source(const StudyResult& result) {
  FitSource source{result.source.study, *result.source.model, result.trials, result.resting, {}, result.emg};
  for (const TrialResult& trial : result.trials) source.activation.push_back(&trial.emg.activation);
  return source;
}

}  // namespace myoid::run
