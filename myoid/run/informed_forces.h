#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::run {

/// Options for sharing the torque of a joint among muscles with known laws.
struct InformedSharing {
  double emg_weight = 10.0;  ///< W; 0: static optimization without EMG.
  double reserve_nm = 1.0;   ///< Optimal torque of the reserve actuator.
};

/// Shared forces of one trial: n samples, m muscles.
struct InformedForces {
  std::string trial;
  Eigen::VectorXd time_s;
  Eigen::MatrixXd activation;  ///< n x m, result of the sharing.
  Eigen::MatrixXd measured;    ///< n x m, from the EMG at the same instants.
  Eigen::MatrixXd force_n;     ///< n x m
  Eigen::MatrixXd reserve_nm;  ///< n x joints: torque that no muscle carries.
  int frames_not_solved = 0;
};

/// Shares torque among given muscles, informed by their EMG. In every sample
///
///   minimize  W sum_i (a_i - e_i)^2 + sum_i a_i^2 + sum_j y_j^2   subject to
///   sum_i r_ij F_i(a_i) + y_j T = torque_j for each joint j,   0 <= a_i <= 1
///
/// where e is the `measured` activation of each muscle's EMG channel (n x m) times its share, T is `reserve_nm`, and
/// F_i is the fit::tension of muscle_law.h, taken as linear in a_i between 0 and 1. This is exact for the paper's law.
/// With gamma or an elastic tendon, the returned force follows the law at the activation found, and the reserve carries
/// the difference. Antagonists act together as far as the EMG shows it. Throws InvalidInput if sizes disagree.
[[nodiscard]] InformedForces informed_forces(const fit::TrialData& trial,
                                             const Eigen::MatrixXd& measured,
                                             const std::vector<fit::MuscleValues>& muscles,
                                             const InformedSharing& options = {});

}  // namespace myoid::run
