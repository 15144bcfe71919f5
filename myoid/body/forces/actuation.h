#pragma once

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

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
[[nodiscard]] Actuation actuation(const body::BodyModel& model,
                                  const body::JointMotion& motion,
                                  const TimeSeries& forces,
                                  const ActuationOptions& options = {});

}  // namespace myoid::body
