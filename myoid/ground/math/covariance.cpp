#include "myoid/ground/math/covariance.h"

#include <cmath>

#include <Eigen/SVD>
#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {

CovarianceResult covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual, double rank_tolerance) {
  if (jacobian.rows() != residual.size()) {
    throw InvalidInput(fmt::format("covariance: {} rows of J for {} residuals", jacobian.rows(), residual.size()));
  }
  if (!jacobian.allFinite() || !residual.allFinite()) throw InvalidInput("covariance: J or r is not finite");
  const Eigen::Index p = jacobian.cols();
  Eigen::VectorXd scale(p);
  for (Eigen::Index j = 0; j < p; ++j) {
    const double norm = jacobian.col(j).norm();
    scale[j] = norm > 0.0 ? 1.0 / norm : 1.0;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::HouseholderQRPreconditioner> svd(
      jacobian * scale.asDiagonal(), Eigen::ComputeThinU | Eigen::ComputeThinV);
  CovarianceResult result;
  Eigen::VectorXd singular = Eigen::VectorXd::Zero(p);
  singular.head(svd.singularValues().size()) = svd.singularValues();
  while (result.rank < p && singular[result.rank] > rank_tolerance * singular[0]) ++result.rank;
  result.unscaled = Eigen::MatrixXd::Zero(p, p);
  for (Eigen::Index k = 0; k < result.rank; ++k) {
    const Eigen::VectorXd direction = scale.cwiseProduct(svd.matrixV().col(k)) / singular[k];
    result.unscaled += direction * direction.transpose();
  }
  const Eigen::Index freedom = jacobian.rows() - result.rank;
  result.residual_variance = freedom > 0 ? residual.squaredNorm() / static_cast<double>(freedom) : 0.0;
  // If J has fewer rows than columns, its thin SVD lacks undetermined directions: J'J has all.
  const Eigen::JacobiSVD<Eigen::MatrixXd> square(
      (scale.asDiagonal() * jacobian.transpose() * jacobian * scale.asDiagonal()).eval(), Eigen::ComputeFullV);
  const Eigen::MatrixXd& v = svd.matrixV().cols() == p ? svd.matrixV() : square.matrixV();
  result.undetermined.resize(p, p - result.rank);
  result.determined.assign(static_cast<std::size_t>(p), true);
  for (Eigen::Index k = result.rank; k < p; ++k) {
    for (Eigen::Index j = 0; j < p; ++j) {
      if (std::abs(v(j, k)) > 1e-6) result.determined[static_cast<std::size_t>(j)] = false;
    }
    result.undetermined.col(k - result.rank) = scale.cwiseProduct(v.col(k)).normalized();
  }
  return result;
}

}  // namespace myoid::inline ground::math
