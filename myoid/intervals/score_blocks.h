#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "myoid/identification/estimator.h"

namespace myoid::identification {

/// Rows that are drawn together.
struct Block {
  int stratum = 0;  ///< Trial; 0 for all where whole trials are drawn.
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;  ///< First and count.
};

/// Blocks of about `block_s` within each trial, all joints of it together; 0: whole trials.
[[nodiscard]] std::vector<Block> blocks_of(const ResidualModel& model, double block_s);

/// Inverse of a symmetric matrix, scaled to unit diagonal; near-zero directions stay near-infinite.
[[nodiscard]] Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& a);

/// The sum of a part's scores as it would be spread if the part had not been fitted: with L L' = A,
/// L (I - L^-1 A_part L^-T)^-1/2 L^-1 times it (Bell & McCaffrey 2002). A fit runs after its parts,
/// the more so the more a part alone says.
[[nodiscard]] Eigen::VectorXd unfitted(const Eigen::LLT<Eigen::MatrixXd>& factor,
                                       const Eigen::MatrixXd& of_part,
                                       const Eigen::VectorXd& sum);

/// Square of the 97.5 % quantile of Student's t with `freedom` degrees over the normal one's
/// (below 3 degrees as with 3).
[[nodiscard]] double student_factor(double freedom);

/// A^-1 B A^-1 with B from sums over blocks of 2 s, each as outside of the fit, and Student's
/// quantile for the number of blocks that speak of a parameter (Satterthwaite 1946), by which the
/// variances are larger. Empty with fewer than 8 blocks, or where A has no factor. `a`: information
/// and `precision`, that of the priors.
[[nodiscard]] std::optional<Eigen::MatrixXd> block_covariance(const ResidualModel& model,
                                                              const Estimator::Scores& by_sample,
                                                              const Eigen::MatrixXd& a,
                                                              const Eigen::VectorXd& precision);

}  // namespace myoid::identification
