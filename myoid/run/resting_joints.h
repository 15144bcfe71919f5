#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/methods/resting_torque.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// A passive trial of a study; nothing is owned.
struct RelaxedTrial {
  std::size_t index = 0;  ///< In the study.
  const TrialSpec* spec = nullptr;
  const TimeSeries* activation = nullptr;  ///< Empty: no EMG.
  const TimeSeries* q = nullptr;
  const TimeSeries* qdot = nullptr;
  const TimeSeries* muscle_torque = nullptr;  ///< Of the study's coordinates, in their order [N m].
  const kinematics::MuscleKinematics* muscles = nullptr;
};

struct RestingJoints {
  std::vector<identification::RestingJoint> joints;
  std::vector<Remark> remarks;  ///< `where` is the trial.
};

/// The torques that the joints of a study make by themselves, from its passive trials that a
/// dynamometer measured: all of them together, joint by joint. The muscles must have been at rest:
/// a trial is left out, with a warning of its own, if an EMG channel is on average above 2 % of its
/// maximal contraction (5 % of its greatest EMG where none was recorded), or if the torque beside a
/// weight's (`identification::beside_weight`) exceeds a quarter of what the joint's muscles could
/// exert, sum of the largest |r| times F_max, or all of it that quarter and 25 N m of weight: no
/// relaxed joint resists that much within its range. A trial without EMG is taken at the study's
/// word, with a note. A trial whose torque nobody measured tells nothing.
[[nodiscard]] RestingJoints resting_joints(const Study& study,
                                           const model::BodyModel& model,
                                           const std::vector<RelaxedTrial>& trials);

/// The resting torque of a coordinate at these angles, one a sample; empty where it was not
/// measured.
[[nodiscard]] Eigen::VectorXd resting_torque_nm(
    const std::vector<identification::RestingJoint>& joints,
    const std::string& coordinate,
    const Eigen::VectorXd& angle_rad);

}  // namespace myoid
