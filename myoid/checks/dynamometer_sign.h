#pragma once

#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// A trial as its EMG and its dynamometer see it.
struct EffortTrial {
  const TrialSpec* spec = nullptr;
  const TimeSeries* external_torque = nullptr;  ///< `<coordinate>_moment` [N m]; nullptr: none.
  TimeSeries envelopes;                         ///< Of the study's EMG channels, any scale.
};

/// Tells if the dynamometers push against the muscles that are active, or, with the sign reversed,
/// with them. What the muscles pull is taken as a F_max r with r the mean over the coordinate's
/// range and a relative to the channel's largest of all trials; it is compared with minus the
/// dynamometer's torque, by the cosine of both, in the half of a trial's torque that is largest. A
/// trial below -0.5 is a warning; an error where all trials are and the cosine of all is below
/// -0.8. Torques below a tenth of what the muscles can hold or four times what the limb weighs,
/// in which that and its inertia count, tell nothing, nor do passive trials.
[[nodiscard]] std::vector<Remark> dynamometer_signs(const Study& study,
                                                    const model::BodyModel& model,
                                                    const std::vector<EffortTrial>& trials);

}  // namespace myoid
