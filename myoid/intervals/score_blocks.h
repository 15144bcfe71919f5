#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "myoid/identification/estimator.h"

namespace myoid::identification {

/// Rows that a bootstrap draws together.
struct Block {
  int stratum = 0;                                          ///< Trial; 0 for all blocks if whole trials are drawn.
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;  ///< First and count.
};

/// Returns blocks of about `block_s` within each trial, with all of its joints; 0: whole trials.
[[nodiscard]] std::vector<Block> blocks_of(const ResidualModel& model, double block_s);

/// Returns the inverse of a symmetric matrix by unit diagonal; near-zero directions stay near-infinite.
[[nodiscard]] Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& a);

/// Returns the data's information `a` with the precision of the priors, invertible: 1 where nothing informs.
[[nodiscard]] Eigen::MatrixXd with_priors_invertible(Eigen::MatrixXd a, const Estimator& estimator);

/// Returns the sum of a part's scores with the spread of a part that is not fitted: L (I - L^-1
/// A_part L^-T)^-1/2 L^-1 times the sum, with L L' = A (Bell & McCaffrey 2002). A fit follows its
/// parts, the more closely the more information a part holds.
[[nodiscard]] Eigen::VectorXd unfitted(const Eigen::LLT<Eigen::MatrixXd>& factor,
                                       const Eigen::MatrixXd& of_part,
                                       const Eigen::VectorXd& sum);

/// Returns the square of the 97.5 % quantile of Student's t with `freedom` degrees over the normal
/// one's (3 degrees at least).
[[nodiscard]] double student_factor(double freedom);

/// Returns A^-1 B A^-1 with B from sums over blocks of 2 s, each as if not fitted. Student's quantile for the number of
/// blocks that inform a parameter (Satterthwaite 1946) enlarges the variances. Empty with fewer than 8 blocks, or if A
/// has no factor. `a`: information and `precision`, which is that of the priors.
[[nodiscard]] std::optional<Eigen::MatrixXd> block_covariance(const ResidualModel& model,
                                                              const Estimator::Scores& by_sample,
                                                              const Eigen::MatrixXd& a,
                                                              const Eigen::VectorXd& precision);

}  // namespace myoid::identification
