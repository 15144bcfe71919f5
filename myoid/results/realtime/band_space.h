#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace myoid::results {

/// Variances of muscle forces and joint torques that depend linearly on unknowns with a covariance
/// C, without allocation after the constructor:
///
///   var F_m = s_m' C s_m,   var T_j = t_j' C t_j,   t_j = sum_m r_jm s_m + s_j
///
/// s_m holds the slopes of a muscle's force by its few unknowns, s_j the slopes of the joint's own torque, r_jm is a
/// moment arm. C is symmetric: where muscles have unknowns of their own, each number of one half of C is read once for
/// all muscles and joints, in single precision between two blocks: 1e-7 of the terms that a variance is the sum of.
/// Where few unknowns serve many muscles, C t_j is the shorter way.
class BandSpace {
 public:
  BandSpace() = default;
  /// Builds the space. `variables`: the unknowns of each block of slopes, first the muscles', then the joints'.
  BandSpace(const Eigen::MatrixXd& covariance,
            const std::vector<std::vector<Eigen::Index>>& variables,
            std::size_t joints);

  /// Returns the place for the slopes of a block, in the order of its unknowns.
  [[nodiscard]] double* slopes_of(std::size_t block) { return slopes_.data() + first_[block]; }
  Eigen::MatrixXd arms;  ///< Blocks x joints: moment arms [m]; of a joint's own block 1 or 0.

  /// Computes the variances of the slopes and arms. `covariance` is that of the constructor.
  void compute(const Eigen::MatrixXd& covariance);
  Eigen::VectorXd force_variance;   ///< One per muscle.
  Eigen::VectorXd torque_variance;  ///< One per joint.
  /// Returns true if C is read block by block.
  [[nodiscard]] bool by_block() const { return by_block_; }

 private:
  void compute_by_block();
  void compute_by_unknown(const Eigen::MatrixXd& covariance);
  [[nodiscard]] Eigen::Index width(Eigen::Index block) const {
    return first_[static_cast<std::size_t>(block) + 1] - first_[static_cast<std::size_t>(block)];
  }

  std::vector<Eigen::Index> first_;     ///< First slope of each block, and the end.
  std::vector<Eigen::Index> variable_;  ///< Unknown of each slope.
  Eigen::VectorXd slopes_;
  Eigen::MatrixXd levers_;  ///< Slopes and rows of zeros x joints: slope times moment arm.
  bool by_block_ = false;
  Eigen::VectorXf single_slopes_;  ///< `slopes_` and `levers_` in single precision.
  Eigen::MatrixXf single_levers_;
  std::vector<double> diagonals_;  ///< Per block: C of its own unknowns.
  std::vector<float> panels_;      ///< Per block: the rows of C below it, some side by side.
  Eigen::VectorXd shared_;         ///< One per joint.
  Eigen::MatrixXd by_unknown_;     ///< Unknowns x joints: t_j.
  Eigen::VectorXd moved_;          ///< C t_j.
};

}  // namespace myoid::results
