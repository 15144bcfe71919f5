#include "myoid/ground/math/toeplitz.h"

namespace myoid::inline ground::math {

Eigen::MatrixXd toeplitz(const Eigen::VectorXd& first_column) {
  const Eigen::Index n = first_column.size();
  Eigen::MatrixXd m(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    m.col(j).tail(n - j) = first_column.head(n - j);
    m.col(j).head(j) = first_column.segment(1, j).reverse();
  }
  return m;
}

Eigen::VectorXd by_first_column(const Eigen::Ref<const Eigen::MatrixXd>& by) {
  const Eigen::Index n = by.rows();
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(n);
  for (Eigen::Index j = 0; j < n; ++j) sums.head(n - j) += by.col(j).tail(n - j);
  sums.tail(n - 1) *= 2.0;
  return sums;
}

}  // namespace myoid::inline ground::math
