#pragma once

#include <string>
#include <vector>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// Returns true if activation 1 is a maximal effort: the study has a trial of maximal effort, or
/// the EMG came as activation.
[[nodiscard]] bool from_maximal_effort(const study::EmgSpec& emg);

/// Returns true if the share of the maximum that a channel's greatest EMG is counts as an unknown,
/// the channel's gain: there is no maximal contraction, and the posterior can carry a
/// share that nothing but beliefs tells apart from F_max.
[[nodiscard]] bool effort_is_unknown(const study::Study& study);

/// The prior of that share, of which a session's muscles have a part in common: a person pushes hard or does not.
struct AnyEffort {
  Prior own;               ///< With the muscle's own spread.
  double common_sd = 0.0;  ///< Spread of the common part; logarithm.
};

/// Returns true if F_max is the force at the greatest EMG and so carries the effort: no effort is maximal, and the gain
/// is held.
[[nodiscard]] bool effort_is_in_strength(const study::Study& study);

/// Returns the prior of that share. Antagonists of resisted movements reach 5 to 20 % of their maximum (Kellis 1998,
/// Sports Med 25:37-62), the muscles of walking 10 to 80 % of a manual test's (Perry & Burnfield 2010). Any ratio
/// between fit::beliefs::kLeastEffort and 1 is as likely as any other: ln(share) = ln 0.22 +- 0.86. Half of that
/// variance is the session's, half the muscle's: a judgment.
[[nodiscard]] AnyEffort any_effort();

/// Returns the spread of a maximal contraction's force about that of a completely active muscle,
/// (UnseenSpreads::effort): 0 where the gain carries the spread,
/// because the study states it or no effort is maximal.
[[nodiscard]] double unseen_effort(const study::Study& study);

/// Returns a sentence that says which force F_max is. `maximal`: the largest EMG is that of a maximal contraction.
[[nodiscard]] std::string meaning_of_strength(const study::Study& study, bool maximal);

/// Returns the bounds of the gains where the effort is unknown: from the least effort to 1.
[[nodiscard]] fit::ParameterRule effort_bounds();

/// Adds the own part of `any_effort` to the priors of F_max where the share is no unknown. F_max is then the force at
/// the greatest EMG of the recording: the muscle's own times the share. Muscles without a prior for F_max stay without.
void expect_any_effort(std::vector<fit::MuscleSetup>& muscles);

}  // namespace myoid::run
