#pragma once

#include "myoid/forces/force_sharing.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/model/body_model.h"

namespace myoid::simulation {

/// Of the muscles whose force is shared.
struct MuscleForceOptions {
  bool elastic_tendon = false;  ///< Else rigid: its length is the slack length.
  bool passive_force = false;   ///< The fiber's passive spring and damper pull too.
};

/// F(x) of every muscle along a motion, by the curves of its class (muscle/musculotendon.h): the
/// tendon's force where fiber and tendon pull alike, and dF/dx exactly. With an elastic tendon the
/// length of the fiber follows from the force by the tendon's law; its velocity is what the path
/// leaves it while the tendon's own length rests, dl_m/dt = v cos(alpha), so that every frame
/// stands for itself. Muscles that apply no force have none. Throws InvalidInput, naming the
/// muscle, if its numbers make no unit.
[[nodiscard]] forces::MuscleForceLaw muscle_force_law(const model::BodyModel& model,
                                                      const kinematics::MuscleKinematics& muscles,
                                                      const MuscleForceOptions& options);

}  // namespace myoid::simulation
