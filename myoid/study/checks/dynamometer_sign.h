#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/checks/relaxed_joint.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Tells whether the dynamometers push against the active muscles or, with a reversed sign, with them. The muscles'
/// torque is a F_max r, with r the mean over the coordinate's range and a relative to the channel's largest value over
/// all trials. It is compared with minus the dynamometer's torque, by the cosine of both, where a muscle is active, in
/// the half of a trial's torque that is largest. A trial below -0.5 is a warning. All trials of the sign are errors if
/// none has the other sign and together they are certain: by a mean below -0.8, or by odds of a thousand. Skipped are
/// passive trials and torques beyond the study's muscles. Torques below a tenth of the strength of the study's weaker
/// muscles, or below four times the limb's weight, where weight and inertia count, are no evidence.
///
/// The remedy names exchanged electrodes of opposite muscles beside the reversed sign, or in its place, where they
/// explain the torques as well, or better.
///
/// The check judges the relaxed trials (`yielding_joint`) where no torque is reversed.
[[nodiscard]] std::vector<Remark> dynamometer_signs(const Study& study,
                                                    const body::BodyModel& model,
                                                    const std::vector<EffortTrial>& trials);

}  // namespace myoid::study
