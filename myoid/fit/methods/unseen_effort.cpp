#include "myoid/fit/methods/unseen_effort.h"

#include <algorithm>

#include "myoid/ground/math/statistics.h"

namespace myoid::fit {

UnseenEffort unseen_effort(const StudyData& data) {
  constexpr double kWindow_s = 0.5;
  UnseenEffort found;
  for (const MuscleSetup& muscle : data.muscles) {
    double seen = 0.0, unseen = 0.0;
    for (const TrialData& trial : data.trials) {
      if (trial.time_s.size() == 0 || !trial.activation.find(muscle.emg_channel)) continue;
      const TimeSeries within = trial.activation.slice(trial.time_s[0], trial.time_s[trial.time_s.size() - 1]);
      if (within.sample_count() < 2) continue;
      double& most = trial.calibration ? seen : unseen;
      most = std::max(most, math::greatest_mean(within.column(muscle.emg_channel), within.mean_rate_hz(), kWindow_s));
    }
    if (seen > 0.0 && unseen > found.ratio * seen) found = {muscle.emg_channel, unseen / seen};
  }
  return found;
}

}  // namespace myoid::fit
