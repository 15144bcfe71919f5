#include "myoid/methods/trial_fit.h"

namespace myoid::identification {

TrialFit unfitted_trial(const TrialData& trial) {
  TrialFit fit;
  fit.trial = trial.name;
  fit.joint = trial.joint;
  fit.calibration = trial.calibration;
  fit.time_s = trial.time_s;
  fit.torque_nm = trial.torque_nm;
  return fit;
}

void add_torques_of_forces(const TrialData& trial, TrialFit& fit) {
  if (trial.moment_arm_m.rows() != trial.time_s.size()) return;
  const Eigen::VectorXd resting = resting_torque_nm(trial);
  fit.literature_torque_nm = trial.moment_arm_m.cwiseProduct(fit.literature_force_n).rowwise().sum() + resting;
  fit.torque_fit_nm = trial.moment_arm_m.cwiseProduct(fit.force_fit_n).rowwise().sum() + resting;
}

}  // namespace myoid::identification
