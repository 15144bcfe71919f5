#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// The EMG and the dynamometer's torque of a trial.
struct EffortTrial {
  const TrialSpec* spec = nullptr;
  const TimeSeries* external_torque = nullptr;  ///< `<coordinate>_moment` [N m], or nullptr.
  TimeSeries envelopes;                         ///< The study's EMG channels, in any scale.
};

/// Tells whether the dynamometers push against the active muscles or, with a reversed sign, with
/// them. The muscles' torque is a F_max r, with r the mean over the coordinate's range and a
/// relative to the channel's largest value over all trials. It is compared with minus the
/// dynamometer's torque, by the cosine of both, in the half of a trial's torque that is largest. A
/// trial below -0.5 is a warning; it is an error if all trials are and the cosine of all is below
/// -0.8. Skipped are passive trials and torques below a tenth of the muscles' strength or below
/// four times the limb's weight, where weight and inertia count.
[[nodiscard]] std::vector<Remark> dynamometer_signs(const Study& study,
                                                    const body::BodyModel& model,
                                                    const std::vector<EffortTrial>& trials);

}  // namespace myoid::study
