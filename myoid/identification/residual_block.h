#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/envelope.h"
#include "myoid/math/butterworth.h"

namespace myoid::identification {

/// A joint of a block. Its n rows of the residual begin at `first`.
struct ResidualJoint {
  int joint = 0;
  std::size_t piece = 0;  ///< Index in ResidualModel::pieces().
  Eigen::Index first = 0;
  Eigen::MatrixXd arm_m;       ///< n x m
  Eigen::MatrixXd motion;      ///< n x 3: angle, rate, acceleration; empty if unknown.
  Eigen::VectorXd resting_nm;  ///< n, or empty: none.
  /// Returns the derivative of the joint's own torque by a field, over its chain's slope; n.
  [[nodiscard]] Eigen::VectorXd by_field(int field, Eigen::Index n) const;
};

/// A gapless, thinned run of samples of one calibration trial: n samples, m muscles.
struct ResidualBlock {
  int trial = 0;
  Eigen::VectorXd time_s;
  Eigen::MatrixXd length_m, velocity_mps;  ///< n x m
  std::vector<Envelope> envelopes;         ///< Per channel.
  Eigen::VectorXd noise_gain;              ///< Per channel.
  std::vector<ResidualJoint> joints;
  std::vector<math::SecondOrderSection> filter;  ///< Empty: the rows are not low-passed.
};

}  // namespace myoid::identification
