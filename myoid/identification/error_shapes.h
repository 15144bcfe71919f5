#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::identification {

/// Errors of a muscle model as torques: sum_b x_b shape_b(t) with x = contrast D y. The y are independent and have the
/// standard deviation `size`, the relative size of the error; D is the diagonal matrix of `weight`.
struct ErrorShapes {
  Eigen::MatrixXd shapes_nm;   ///< k x n, low-passed as `measured()`.
  Eigen::MatrixXd unfiltered;  ///< k x n, not low-passed.
  Eigen::VectorXd weight;      ///< k
  /// k x k, symmetric: the identity, except for the lags of muscles with one pure delay. For these
  /// only the differences from their mean are errors, because the delay is the mean.
  Eigen::MatrixXd contrast;
  std::vector<int> channel;  ///< k: EMG channel that multiplies the shape; -1: none.
  /// k x k: d shape_b / d ln(envelope) of its channel = sum_j by_emg(b, j) shape_j.
  Eigen::MatrixXd by_emg;
};

}  // namespace myoid::identification
