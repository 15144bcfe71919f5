#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/posterior/torque_signals.h"
#include "myoid/fit/posterior/trial_run.h"
#include "myoid/fit/posterior/unseen.h"

namespace myoid::fit {

/// The change of each ln F_max that acts as the unseen quantities x do: an estimate without
/// priors is that much too large, and the estimator takes its columns there. With
/// F_seen = F (1 + x sqrt(F_seen / F)), ln(F_seen / F) is 2 asinh(x / 2).
[[nodiscard]] Eigen::VectorXd log_strength(const ParameterMap& map,
                                           const std::vector<TrialRun>& runs,
                                           const std::vector<RunEvaluation>& at,
                                           const Unseen& unseen,
                                           const Eigen::VectorXd& x);

}  // namespace myoid::fit
