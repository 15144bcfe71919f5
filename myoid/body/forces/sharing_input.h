#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/forces/force_sharing.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

/// The input of force sharing along a motion, on its clock (force_sharing.h).
struct SharingInput {
  std::vector<TimeSeries> moment_arms;  ///< One for each channel of `torques` [m].
  TimeSeries torques;                   ///< [N m, N]
  Eigen::MatrixXd optimal_force_n;      ///< Frames x muscles.
  Eigen::VectorXd max_isometric_force_n;
  double min_activation = 0.0;  ///< The least control that a muscle of the model allows.
  body::MuscleKinematics muscles;
  std::vector<Remark> notes;  ///< Remarks to the user, a sentence each.
};

/// Computes the input from the muscles' paths along the motion: torques of inverse dynamics (with passive forces of the
/// model and `loads`, if any), moment arms, and the forces at full activation with a rigid tendon under the curves of
/// each muscle's own class. `coordinates`: the coordinates whose torque the muscles balance; empty: all independent
/// ones. Coordinates that follow another by a coupler add to the other's torque and moment arms by their rate, so that
/// the couplers' own forces do no work. Throws ModelError if a coordinate is not in the model or not independent, or
/// the model has no muscles.
[[nodiscard]] SharingInput sharing_input(const body::BodyModel& model,
                                         const body::JointMotion& motion,
                                         body::MuscleKinematics muscles,
                                         const std::vector<std::string>& coordinates,
                                         const body::ExternalLoads* loads = nullptr);

/// The same for torques that are known: a channel for each coordinate. Without inverse dynamics and couplers.
[[nodiscard]] SharingInput sharing_input(const body::BodyModel& model,
                                         TimeSeries torques,
                                         body::MuscleKinematics muscles,
                                         const std::vector<std::string>& coordinates);

/// Shares forces on this input; the model gives the least activation, not `options`.
[[nodiscard]] MuscleForces share(const SharingInput& input, SharingOptions options);

}  // namespace myoid::body
