#pragma once

#include <string>
#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/forces/force_sharing.h"
#include "myoid/body/forces/sharing_input.h"
#include "myoid/ground/core/remark.h"

namespace myoid::body {

/// Share of the frames in which a reserve may act without a word.
inline constexpr double kReserveShare = 0.05;

/// Returns "a reserve acts in 12.0 % of the frames".
[[nodiscard]] std::string reserve_words(double share);

/// Finds coordinates on which a reserve acts (SharingStatus::reserve_used) in kReserveShare of the frames or more: one
/// warning for those that muscles move, because the muscles are too weak for the torque; one note for those that no
/// muscle moves, whose torque a reserve always makes.
[[nodiscard]] std::vector<Remark> reserves_act(const SharingInput& input, const MuscleForces& shared);

/// The same of OpenSim's static optimization: `forces` has a channel for each CoordinateActuator of the model.
[[nodiscard]] std::vector<Remark> reserves_act(const body::BodyModel& model,
                                               const body::JointMotion& motion,
                                               const TimeSeries& forces,
                                               const body::ExternalLoads* loads);

}  // namespace myoid::body
