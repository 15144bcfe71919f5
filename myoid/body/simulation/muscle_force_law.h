#pragma once

#include "myoid/body/forces/force_sharing.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// Options of muscles between which force is shared.
struct MuscleForceOptions {
  bool elastic_tendon = false;  ///< Elastic tendon; a rigid one has its slack length.
  bool passive_force = false;   ///< The fiber's passive spring and damper pull too.
};

/// Returns F(x) of every muscle along a motion with exact dF/dx, by the curves of its class (muscle/musculotendon.h). F
/// is the tendon's force in the equilibrium of fiber and tendon. With an elastic tendon the length of the fiber follows
/// from the force by the tendon's law. Its velocity is dl_m/dt = v cos(alpha), as if the tendon's length were constant,
/// so that frames are independent. Muscles that apply no force have none. Throws InvalidInput, naming the muscle, if
/// its parameters are impossible.
[[nodiscard]] body::MuscleForceLaw muscle_force_law(const body::BodyModel& model,
                                                    const body::MuscleKinematics& muscles,
                                                    const MuscleForceOptions& options);

}  // namespace myoid::body
