#pragma once

#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Tells if the measured forces on the ground act where the bodies are that they are applied to: a
/// center of pressure lies under its foot. Of every force with a moving point in ground, the median
/// distance over the frames in which it is loaded (a fifth of its largest or more) from the nearest
/// marker of each body, or, of a motion without markers, from the nearest of its markers, joints
/// and center of mass in the model. An error where two forces are each nearer to the other's body
/// (their feet are exchanged) or one is more than 2 m away (its unit or axes are others); a warning
/// where one is more than 0.2 m from its own body and half as far from another.
[[nodiscard]] std::vector<Remark> misplaced_loads(const model::BodyModel& model,
                                                  const TrialSpec& trial,
                                                  const TrialInput& input);

}  // namespace myoid
