#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/design/design_study.h"
#include "myoid/intake/study_activation.h"
#include "myoid/methods/cross_validation.h"
#include "myoid/run/fit_input.h"
#include "myoid/run/study_fit.h"
#include "myoid/run/study_forces.h"
#include "myoid/run/study_inputs.h"
#include "myoid/run/trial_motion.h"
#include "myoid/run/trial_result.h"

namespace myoid {

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// All that a run found, stage by stage: the writers of files and reports take it whole.
struct StudyResult {
  std::optional<double> start_s, end_s;  ///< As RunOptions had them.
  StudySource source;                    ///< read
  std::vector<TrialResult> trials;   ///< read, activation, motion, forces; in the study's order.
  EmgScale emg;                      ///< activation
  std::vector<Remark> level_faults;  ///< findings: of EMG channels, over all trials.
  std::vector<identification::RestingJoint> resting;  ///< forces
  FitInput fit_input;                                 ///< data
  StudyFit fit;                                       ///< fit
  std::vector<identification::Fold> folds;            ///< validation
  /// Movements that would tell more; empty without method torque, or if none is asked for.
  std::optional<DesignStudyResult> next;
  std::vector<StageTime> times;
};

}  // namespace myoid
