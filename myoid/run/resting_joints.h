#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/run/resting_torque.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// A passive trial of a study; the struct owns nothing.
struct RelaxedTrial {
  std::size_t index = 0;  ///< Index in the study.
  const study::TrialSpec* spec = nullptr;
  const TimeSeries* activation = nullptr;  ///< Empty: no EMG.
  const TimeSeries* q = nullptr;
  const TimeSeries* qdot = nullptr;
  /// For the study's coordinates, in their order [N m].
  const TimeSeries* muscle_torque = nullptr;
  const body::MuscleKinematics* muscles = nullptr;
};

struct RestingJoints {
  std::vector<RestingJoint> joints;
  std::vector<Remark> remarks;  ///< `where` is the trial.
};

/// Returns the resting torques of the study's joints from the passive trials with a dynamometer,
/// all trials together, joint by joint. The muscles must be at rest. A trial is left out, with a
/// warning of its own, if an EMG channel is on average above 2 % of its maximal contraction (5 % of
/// its greatest EMG if there is none), if the torque beside a weight's
/// (`beside_weight`) exceeds a quarter of the capacity of the joint's muscles (sum of the largest |r|
/// times F_max), or if the whole torque exceeds this quarter plus 25 N m of weight: no relaxed joint resists that much
/// within its range. A trial without EMG counts as relaxed, with a note. A trial without measured torque is not used.
[[nodiscard]] RestingJoints resting_joints(const study::Study& study,
                                           const body::BodyModel& model,
                                           const std::vector<RelaxedTrial>& trials);

/// Returns the resting torque of a coordinate at the angles of `q`, one per sample; empty if it was not measured.
/// Throws InvalidInput if it was and `q` lacks the angle.
[[nodiscard]] Eigen::VectorXd resting_torque_nm(const std::vector<RestingJoint>& joints,
                                                const std::string& coordinate,
                                                const TimeSeries& q);

}  // namespace myoid::run
