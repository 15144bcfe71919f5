#pragma once

#include "myoid/core/progress.h"
#include "myoid/core/time_series.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_model.h"

namespace myoid::forces {

struct ActuationOptions {
  /// True, as OpenSim 4.5.2: a point actuator's speed is the length of its point's velocity, and the axis of a torque
  /// actuator is fixed in ground. False: both speeds are the rate at which the actuator works.
  bool speeds_of_opensim = false;
  Progress progress{};
};

struct Actuation {
  TimeSeries speed;    ///< [m/s, rad/s]; of muscles and other paths the rate of lengthening.
  TimeSeries power_w;  ///< Work done on the model: -force * speed of paths, force * speed else.
};

/// Computes speeds and powers of all actuators of `actuators_of` along a motion while they exert
/// `forces`, by name [N, N m]. Postures first meet the constraints. Throws as force_rows.
[[nodiscard]] Actuation actuation(const model::BodyModel& model,
                                  const kinematics::JointMotion& motion,
                                  const TimeSeries& forces,
                                  const ActuationOptions& options = {});

}  // namespace myoid::forces
