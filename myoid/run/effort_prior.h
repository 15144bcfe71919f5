#pragma once

#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/study/study.h"

namespace myoid {

/// Returns true if activation 1 is a maximal effort: the study has a trial of maximal effort, or
/// the EMG came as activation.
[[nodiscard]] bool from_maximal_effort(const EmgSpec& emg);

/// Widens the priors of F_max where activation 1 is not a maximal contraction but the greatest EMG
/// of the recording. F_max is then the force of that effort: the muscle's own times an unknown
/// share.
///
/// Antagonists of resisted movements reach 5 to 20 % of their maximum (Kellis 1998, Sports Med
/// 25:37-62), the muscles of walking 10 to 80 % of a manual test's (Perry & Burnfield 2010). Any
/// ratio between identification::beliefs::kLeastEffort and 1 is as likely as any other, so that
/// ln(share) = ln 0.22 +- 0.86, and the literature's own spread is added. Muscles without a prior
/// for F_max stay without.
void expect_any_effort(std::vector<identification::MuscleSetup>& muscles);

}  // namespace myoid
