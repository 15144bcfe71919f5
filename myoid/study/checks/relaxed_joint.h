#pragma once

#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// The EMG, the dynamometer's torque and the measured angles of a trial.
struct EffortTrial {
  const TrialSpec* spec = nullptr;
  const TimeSeries* external_torque = nullptr;  ///< `<coordinate>_moment` [N m], or nullptr.
  TimeSeries envelopes;                         ///< The study's EMG channels, in any scale; may be empty.
  const TimeSeries* motion = nullptr;           ///< Coordinates of the study [rad], or nullptr.
};

/// The change of the surroundings' torque over the angles of a joint at rest, in all passive trials.
struct RelaxedJoint {
  double change_nm = 0.0;  ///< Over the range of the angle, by the line through all samples.
  double range_rad = 0.0;
  std::vector<const TrialSpec*> trials;

  [[nodiscard]] bool resists() const { return change_nm > 0.0; }
  [[nodiscard]] bool yields() const { return change_nm < 0.0; }
};

/// Returns the change; it is 0 where the torque does not follow the angle, or where four times the limb's weight may
/// explain it.
[[nodiscard]] RelaxedJoint relaxed_joint(const std::vector<EffortTrial>& trials,
                                         const std::string& coordinate,
                                         double weight_nm);

/// Warns of each relaxed trial if the torque of the surroundings falls as the angle rises: a joint at rest resists, so
/// that angle or torque have the wrong sign. `right_log_odds` of the torque's sign, by the EMG, tells which.
[[nodiscard]] std::vector<Remark> yielding_joint(const RelaxedJoint& joint,
                                                 const std::string& coordinate,
                                                 double right_log_odds);

}  // namespace myoid::study
