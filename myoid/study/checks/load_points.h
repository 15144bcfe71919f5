#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/checks/contact_table.h"

namespace myoid::study {

/// Tells whether the measured forces on the ground act at the bodies to which they are applied: a center of pressure is
/// under its foot. Checks every force with a moving point in ground over the frames in which it is loaded (a fifth of
/// its largest value or more). The distance from a body is the median distance from its nearest marker or, for a motion
/// without markers, from the nearest of its markers, joints and center of mass in the model. It is an error
///
/// - if a turn by 90, 180 or 270 degrees about the vertical brings all forces within 0.2 m, and one is more than 0.4 m
///   away;
/// - if two forces are each nearer to the other's body (their feet are exchanged);
/// - if a force is more than 2 m away (wrong unit or axes).
///
/// It is a warning if a force is more than 0.2 m from its own body and half as far from another, or more than 0.4 m
/// from a body that is a foot: at most 0.4 m above the lowest one. `file` names the loads.
[[nodiscard]] std::vector<Remark> misplaced_loads(const body::BodyModel& model,
                                                  const ContactTable& table,
                                                  const std::string& file);

}  // namespace myoid::study
