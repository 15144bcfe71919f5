#include "myoid/fit/measurement/unlikeness.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

constexpr Eigen::Index kGrid = 46;            // values of lambda
constexpr double kLeast = -4.0, kMost = 5.0;  // of ln lambda over its spread

/// Returns ln of the share of a normal distribution within the bounds of a number.
double log_share_within(const muscle::Range& bounds, double mean, double sd) {
  return std::log(
      std::max(math::normal_below((bounds.upper - mean) / sd) - math::normal_below((bounds.lower - mean) / sd), 1e-12));
}

}  // namespace

bool spread_is_judgment(const Unknown& of) {
  return of.field->scope == Scope::muscle && of.prior.sd > 0.0 && !of.prior_is_given && of.field->field != kMaxForce &&
         of.field->field != kFiberLength;
}

double prior_spread(const Unknown& of) { return std::hypot(of.prior.sd, of.common_sd); }

Eigen::MatrixXd prior_precision(const std::vector<Unknown>& free, double unlikeness) {
  const auto p = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(p, p);
  Eigen::VectorXd common(p);
  std::map<const ParameterField*, std::vector<Eigen::Index>> sharing;
  for (Eigen::Index j = 0; j < p; ++j) {
    const Unknown& of = free[static_cast<std::size_t>(j)];
    precision(j, j) = of.prior_precision() / (spread_is_judgment(of) ? unlikeness * unlikeness : 1.0);
    common[j] = of.common_sd;
    if (of.common_sd > 0.0) sharing[of.field].push_back(j);
  }
  for (const auto& [field, members] : sharing) {
    Eigen::MatrixXd covariance = common(members) * common(members).transpose();
    covariance += precision(members, members).diagonal().cwiseInverse().asDiagonal();
    precision(members, members) = math::pseudo_inverse(covariance);
  }
  return precision;
}

Strength common_strength(const std::vector<Unknown>& free, const Eigen::VectorXd& z) {
  double precision = 0.0, pull = 0.0, sd = 0.0;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const Unknown& of = free[j];
    if (!of.is(Scope::muscle, kMaxForce) || !(of.common_sd > 0.0)) continue;
    sd = of.common_sd;
    precision += of.prior_precision();
    pull += of.prior_precision() * (z[static_cast<Eigen::Index>(j)] - of.prior.mean);
  }
  return sd > 0.0 ? Strength{pull / (precision + 1.0 / (sd * sd)), sd} : Strength{};
}

std::vector<Unknown> about_strength(std::vector<Unknown> free, double log_strength) {
  for (Unknown& of : free) {
    if (of.is(Scope::muscle, kMaxForce) && of.common_sd > 0.0) of.prior.mean += log_strength;
  }
  return free;
}

Unlikeness::Unlikeness(const std::vector<Unknown>& free) : free_(free) {
  const double sd = beliefs::kUnlikeness.sd;
  log_lambda_.setLinSpaced(kGrid, kLeast * sd, kMost * sd);
  log_prior_ = -0.5 * (log_lambda_ / sd).square();
  judged_.setZero(static_cast<Eigen::Index>(free.size()));
  for (std::size_t j = 0; j < free.size(); ++j) {
    const Unknown& of = free[j];
    if (!spread_is_judgment(of)) continue;
    judged_[static_cast<Eigen::Index>(j)] = of.prior_precision();
    ++count_;
    for (Eigen::Index i = 0; i < kGrid; ++i)
      log_prior_[i] -= log_share_within(of.bounds, of.prior.mean, std::exp(log_lambda_[i]) * of.prior.sd);
  }
}

double Unlikeness::expected(const Eigen::MatrixXd& information, const Eigen::VectorXd& b) const {
  // With A the matrix at lambda = 1, R^2 the judged numbers' precision there, R A^-1 R = V diag(e) V' and c =
  // 1/lambda^2 - 1, the inverse at lambda is A^-1 - W diag(c / (1 + c e)) W', W = A^-1 R V.
  const Eigen::MatrixXd inverse = math::inverse_of_positive(information + prior_precision(free_, 1.0));
  const Eigen::VectorXd root = judged_.cwiseSqrt();
  const math::SymmetricEigen eigen = math::symmetric_eigen(root.asDiagonal() * inverse * root.asDiagonal());
  const Eigen::MatrixXd w = inverse * root.asDiagonal() * eigen.vectors;
  const Eigen::VectorXd along = w.transpose() * b, at_rest = inverse * b;
  Eigen::ArrayXd density(kGrid);
  for (Eigen::Index i = 0; i < kGrid; ++i) {
    const double c = std::exp(-2.0 * log_lambda_[i]) - 1.0;
    const Eigen::ArrayXd grown = (1.0 + c * eigen.values.array()).max(1e-300);
    const Eigen::VectorXd less = (c / grown).matrix();
    const Eigen::VectorXd off = at_rest - w * less.cwiseProduct(along);
    const Eigen::VectorXd variance = inverse.diagonal() - w.cwiseAbs2() * less;
    // Of |P| only the judged numbers' part depends on lambda.
    density[i] = log_prior_[i] - static_cast<double>(count_) * log_lambda_[i] + 0.5 * (b.dot(off) - grown.log().sum());
    for (Eigen::Index j = 0; j < b.size(); ++j) {
      const Unknown& of = free_[static_cast<std::size_t>(j)];
      if (judged_[j] > 0.0)
        density[i] += log_share_within(of.bounds, of.prior.mean + off[j], std::sqrt(std::max(variance[j], 1e-300)));
    }
  }
  density = (density - density.maxCoeff()).exp();
  return std::sqrt((density * (2.0 * log_lambda_).exp()).sum() / density.sum());
}

Unlikeness::Integrated Unlikeness::integrated(double squares) const {
  const Eigen::ArrayXd precision = (-2.0 * log_lambda_).exp();
  const Eigen::ArrayXd log_density = log_prior_ - static_cast<double>(count_) * log_lambda_ - 0.5 * squares * precision;
  const double greatest = log_density.maxCoeff();
  const Eigen::ArrayXd density = (log_density - greatest).exp();
  return {greatest + std::log(density.sum() * (log_lambda_[1] - log_lambda_[0])),
          (density * precision).sum() / density.sum()};
}

}  // namespace myoid::fit
