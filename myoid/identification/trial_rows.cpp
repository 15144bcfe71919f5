#include "myoid/identification/trial_rows.h"

namespace myoid::identification {

TrialData at_rows(const TrialData& trial, const std::vector<Eigen::Index>& rows) {
  TrialData t = trial;
  t.time_s = trial.time_s(rows);
  const auto pick = [&](auto& x) {
    if (x.rows() == trial.time_s.size()) x = x(rows, Eigen::all).eval();
  };
  for (Eigen::MatrixXd* x : {&t.length_m, &t.velocity_mps, &t.moment_arm_m, &t.force_n}) pick(*x);
  for (Eigen::VectorXd* x : {&t.torque_nm, &t.angle_rad, &t.velocity_radps, &t.acceleration_radps2, &t.resting_nm})
    pick(*x);
  for (JointData& joint : t.more_joints) {
    pick(joint.moment_arm_m);
    for (Eigen::VectorXd* x :
         {&joint.torque_nm, &joint.angle_rad, &joint.velocity_radps, &joint.acceleration_radps2, &joint.resting_nm})
      pick(*x);
  }
  return t;
}

}  // namespace myoid::identification
