#pragma once

#include <string>

#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// The EMG channel whose greatest effort a fit has seen least of.
struct UnseenEffort {
  std::string channel;  ///< Empty: no channel works harder than in the trials that are fitted.
  double ratio = 1.0;   ///< Greatest effort of the trials held back over that of those fitted.
};

/// Compares the greatest efforts (mean of the activation over half a second, within the trial) of
/// the trials that are held back with those of the trials that are fitted, and returns the channel
/// with the greatest ratio. A prediction beyond the efforts of a fit rests on the law alone: force
/// grows in proportion to activation.
[[nodiscard]] UnseenEffort unseen_effort(const StudyData& data);

}  // namespace myoid::identification
