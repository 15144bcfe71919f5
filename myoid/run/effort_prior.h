#pragma once

#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/study/study.h"

namespace myoid {

/// True if activation 1 is a maximal effort: a trial of the study is one, or the EMG came as
/// activation, whose 1 is taken at its word.
[[nodiscard]] bool from_maximal_effort(const EmgSpec& emg);

/// What is known beforehand of F_max where activation 1 is not a maximal contraction but the
/// greatest EMG that happened to be recorded: F_max is then the force of that effort, the muscle's
/// own times a share that the study does not tell.
///
/// Antagonists of resisted movements reach 5 to 20 % of their maximum (Kellis 1998, Sports Med
/// 25:37-62), the muscles of walking 10 to 80 % of a manual test's (Perry & Burnfield 2010), a
/// trial that strives for it all: any ratio between identification::beliefs::kLeastEffort and 1 is
/// as likely as any other, so that ln(share) = ln 0.22 +- 0.86, and the literature's own spread is
/// added. Muscles without a prior for F_max stay without.
void expect_any_effort(std::vector<identification::MuscleSetup>& muscles);

}  // namespace myoid
