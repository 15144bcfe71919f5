#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::identification {

/// Ways in which a model of muscles errs, as torques: sum_b x_b shape_b(t) with x = contrast D y,
/// y independent of standard deviation `size`, the relative size of the error, and D the diagonal
/// of `weight`.
struct ErrorShapes {
  Eigen::MatrixXd shapes_nm;   ///< k x n, low-passed as `measured()`.
  Eigen::MatrixXd unfiltered;  ///< k x n, before that.
  Eigen::VectorXd weight;      ///< k
  /// k x k, symmetric: the identity, but that of the lags of muscles with one pure delay
  /// only the differences from their mean are errors: the mean is that delay.
  Eigen::MatrixXd contrast;
  std::vector<int> channel;  ///< k: EMG channel that it is multiplied by; -1: none.
  /// k x k: d shape_b / d ln(envelope) of its channel = sum_j by_emg(b, j) shape_j.
  Eigen::MatrixXd by_emg;
};

}  // namespace myoid::identification
