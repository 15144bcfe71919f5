#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/run/study_forces.h"
#include "myoid/run/trial_motion.h"
#include "myoid/study/intake/study_activation.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// All results about one trial, stage by stage.
struct TrialResult {
  study::TrialSpec spec;
  study::TrialInput input;      ///< read
  study::TrialActivation emg;   ///< activation
  TrialMotion motion;           ///< motion
  TrialForces forces;           ///< forces
  std::vector<Remark> faults;   ///< findings: about its recordings, unprocessed.
  std::vector<Remark> remarks;  ///< All stages: repairs and doubts, with file and line.

  /// Returns the reason why the trial could not be computed; empty otherwise.
  [[nodiscard]] const std::string& failure() const { return motion.failure.empty() ? forces.failure : motion.failure; }
  [[nodiscard]] bool has_motion() const { return motion.joints.q.sample_count() > 0 && failure().empty(); }
};

/// Returns the number of trials that could not be computed.
[[nodiscard]] inline int failed_trials(const std::vector<TrialResult>& trials) {
  return static_cast<int>(
      std::ranges::count_if(trials, [](const TrialResult& trial) { return !trial.failure().empty(); }));
}

}  // namespace myoid::run
