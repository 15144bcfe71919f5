#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/dynamics/joint_capacity.h"
#include "myoid/body/model/body_model.h"
#include "myoid/study/checks/relaxed_joint.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Channels of a study's muscles and the torque of each at its largest EMG [N m].
struct Pulls {
  std::vector<std::string> channels;
  Eigen::VectorXd strength_nm;

  /// Returns the strengths of the muscles of one direction together, and those of the other.
  [[nodiscard]] body::JointCapacity together() const {
    return {.positive_nm = strength_nm.cwiseMax(0.0).sum(), .negative_nm = -strength_nm.cwiseMin(0.0).sum()};
  }
};

/// Returns the pulls on a joint: F_max r of each channel's muscles, r the mean over the coordinate's range.
[[nodiscard]] Pulls pulls_on(const Study& study, const body::BodyModel& model, const std::string& coordinate);

/// Sums over samples, from which the cosine between the muscles' torque and the torque they must provide follows for
/// any strengths of the channels.
struct Sums {
  Eigen::MatrixXd emg;   ///< Products of the channels' relative EMG.
  Eigen::VectorXd need;  ///< Products of it with the necessary torque.
  double square = 0.0;   ///< Square of that torque.

  [[nodiscard]] double cosine(const Eigen::VectorXd& strength_nm) const;
  /// Returns the root mean square of the torque over that of the muscles' torque.
  [[nodiscard]] double torque_over_pull(const Eigen::VectorXd& strength_nm) const;
  /// Returns the share of the muscles' torque that no antagonist takes away.
  [[nodiscard]] double unopposed(const Eigen::VectorXd& strength_nm) const;
};

/// A trial whose torque and EMG can be compared.
struct ToldTrial {
  const EffortTrial* trial = nullptr;
  Sums sums;
  double peak_nm = 0.0;
  bool strong = false;  ///< Its torque is beyond weight, inertia and a light touch.
};

/// Returns the trials of a joint with a dynamometer and EMG but the passive ones, with their sums over the samples
/// where the torque is above half of its peak and a muscle is active. EMG is relative to its channel's largest value
/// over all trials.
[[nodiscard]] std::vector<ToldTrial> told_trials(const std::vector<EffortTrial>& trials,
                                                 const std::string& coordinate,
                                                 const Pulls& pulls,
                                                 double weight_nm);

}  // namespace myoid::study
