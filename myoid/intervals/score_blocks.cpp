#include "myoid/intervals/score_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "myoid/math/decompositions.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {

std::vector<Block> blocks_of(const ResidualModel& model, double block_s) {
  std::vector<Block> blocks;
  int trial = -1;
  std::size_t first_of_trial = 0;
  for (const Piece& piece : model.pieces()) {
    const bool same = piece.trial == trial;
    if (!same) first_of_trial = blocks.size();
    trial = piece.trial;
    Eigen::Index count = 1;
    if (block_s > 0.0) {
      count = std::max<Eigen::Index>(
          1, static_cast<Eigen::Index>(std::lround(static_cast<double>(piece.count) / (model.rate_hz() * block_s))));
    }
    for (Eigen::Index b = 0; b < count; ++b) {
      const Eigen::Index begin = piece.count * b / count;
      const Eigen::Index end = piece.count * (b + 1) / count;
      // The joints of one trial are drawn together.
      const std::size_t at = first_of_trial + static_cast<std::size_t>(b);
      if (!same || at >= blocks.size()) blocks.push_back({block_s > 0.0 ? trial : 0, {}});
      blocks[same ? at : blocks.size() - 1].rows.emplace_back(piece.first + begin, end - begin);
    }
  }
  return blocks;
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& a) {
  // Scales to unit diagonal before inverting; near-zero directions stay near-infinite.
  const Eigen::VectorXd scale = a.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * a * scale.asDiagonal();
  const math::SymmetricEigen eigen = math::symmetric_eigen(scaled);
  const Eigen::VectorXd values = eigen.values.cwiseMax(1e-14 * eigen.values.maxCoeff()).cwiseInverse();
  return scale.asDiagonal() * eigen.vectors * values.asDiagonal() * eigen.vectors.transpose() * scale.asDiagonal();
}

Eigen::MatrixXd with_priors_invertible(Eigen::MatrixXd a, const Estimator& estimator) {
  a.diagonal() += estimator.prior_precision();
  for (double& d : a.diagonal()) d = d > 0.0 ? d * (1.0 + 1e-12) : 1.0;
  return a;
}

Eigen::VectorXd unfitted(const Eigen::LLT<Eigen::MatrixXd>& factor,
                         const Eigen::MatrixXd& of_trial,
                         const Eigen::VectorXd& sum) {
  constexpr double kLeast = 0.05;  // of the spread that a fit leaves
  const auto lower = factor.matrixL();
  const Eigen::MatrixXd half = lower.solve(of_trial);
  const Eigen::MatrixXd share = lower.solve(half.transpose());
  const math::SymmetricEigen eigen = math::symmetric_eigen(0.5 * (share + share.transpose()));
  const Eigen::VectorXd left = (1.0 - eigen.values.array()).max(kLeast).rsqrt().matrix();
  const Eigen::VectorXd turned = eigen.vectors.transpose() * lower.solve(sum);
  return lower * (eigen.vectors * left.cwiseProduct(turned));
}

double student_factor(double freedom) {
  constexpr double kProbability = 0.975;
  const double wider =
      math::student_quantile(kProbability, std::max(3.0, freedom)) / math::normal_quantile(kProbability);
  return wider * wider;
}

std::optional<Eigen::MatrixXd> block_covariance(const ResidualModel& model,
                                                const Estimator::Scores& by_sample,
                                                const Eigen::MatrixXd& a,
                                                const Eigen::VectorXd& precision) {
  constexpr double kBlock_s = 2.0;
  const std::vector<Block> blocks = blocks_of(model, kBlock_s);
  const Eigen::LLT<Eigen::MatrixXd> factor(a);
  if (blocks.size() < 8 || factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::Index p = a.rows();
  const Eigen::MatrixXd inverse = inverse_of(a);
  Eigen::MatrixXd b = precision.asDiagonal();
  Eigen::VectorXd shares = Eigen::VectorXd::Constant(p, 1e-300), squared = shares;
  for (const Block& block : blocks) {
    Eigen::MatrixXd of_block = Eigen::MatrixXd::Zero(p, p);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(p);
    for (const auto& [first, count] : block.rows) {
      const auto rows = by_sample.rows.middleCols(first, count);
      of_block += rows * rows.transpose();
      sum += by_sample.scores.middleCols(first, count).rowwise().sum();
    }
    const Eigen::VectorXd alone = unfitted(factor, of_block, sum);
    b += alone * alone.transpose();
    const Eigen::VectorXd share = (inverse * of_block).cwiseProduct(inverse).rowwise().sum();
    shares += share;
    squared += share.cwiseAbs2();
  }
  Eigen::MatrixXd covariance = inverse * b * inverse;
  for (Eigen::Index j = 0; j < p; ++j) {
    const double wider = std::sqrt(student_factor(shares[j] * shares[j] / squared[j]));
    covariance.row(j) *= wider;
    covariance.col(j) *= wider;
  }
  return covariance;
}

}  // namespace myoid::identification
