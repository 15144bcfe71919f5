#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::identification {

/// Ways in which a model of muscles errs, as torques: sum_b x_b shape_b(t) with independent x_b of
/// standard deviation `weight_b` times the relative size of the error.
struct ErrorShapes {
  Eigen::MatrixXd shapes_nm;   ///< k x n, low-passed as `measured()`.
  Eigen::MatrixXd unfiltered;  ///< k x n, before that.
  Eigen::VectorXd weight;      ///< k
  std::vector<int> channel;    ///< k: EMG channel that it is multiplied by; -1: none.
  /// k x k: d shape_b / d ln(envelope) of its channel = sum_j by_emg(b, j) shape_j.
  Eigen::MatrixXd by_emg;
};

}  // namespace myoid::identification
