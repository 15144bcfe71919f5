#pragma once

#include <string>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// The EMG channel whose effort exceeds the fitted effort most.
struct UnseenEffort {
  std::string channel;  ///< Empty: no channel exceeds its effort in the fitted trials.
  double ratio = 1.0;   ///< Greatest effort in held-back trials divided by that in fitted trials.
};

/// Compares the greatest efforts (mean of the activation over half a second, within the trial) of
/// held-back and fitted trials, and returns the channel with the greatest ratio. A prediction
/// beyond the fitted efforts depends on the law alone: force is proportional to activation.
[[nodiscard]] UnseenEffort unseen_effort(const StudyData& data);

}  // namespace myoid::fit
