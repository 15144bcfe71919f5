#include "myoid/fit/posterior/learned_sizes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/bounded.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::fit {
namespace {

constexpr double kLnStep = 0.4;
constexpr int kStepsBelow = 8, kStepsAbove = 3;  // of the believed size: from 4 % of it to 3.3 times
constexpr int kSweeps = 2;                       // over the sizes, each given the others

Eigen::VectorXd deviations(const Density& density, const Eigen::VectorXd& z, const NoiseValues& noise) {
  return math::inverse_of_positive(density.likelihood().information(z, noise).information + density.precision())
      .diagonal()
      .cwiseMax(0.0)
      .cwiseSqrt();
}

/// The density of the sizes about a mode, z and x integrated out.
class DensityOfSizes {
 public:
  DensityOfSizes(const Density& density, const Eigen::VectorXd& z, const NoiseValues& noise)
      : density_(density), at_mode_(noise) {
    const Likelihood& likelihood = density.likelihood();
    const std::vector<UnseenQuantity>& quantities = likelihood.unseen().quantities;
    unknowns_ = z.size();
    unseen_ = static_cast<Eigen::Index>(quantities.size());
    for (const UnseenQuantity& each : quantities) size_of_.push_back(each.size);
    information_.setZero(unknowns_ + unseen_, unknowns_ + unseen_);
    for (const Eigen::MatrixXd& of_trial : likelihood.information_by_trial(z, noise)) information_ += of_trial;
    // Both gradients follow from the expectation of x at the mode of z.
    const Eigen::VectorXd mean = likelihood.unseen_given(z, noise).mean;
    gradient_ = information_.rightCols(unseen_) * mean;
    gradient_.tail(unseen_) += mean;
    information_.topLeftCorner(unknowns_, unknowns_) += density.precision();
  }

  /// Returns ln p of these sizes, over a constant.
  [[nodiscard]] double operator()(const NoiseValues& noise) const {
    Eigen::VectorXd d = Eigen::VectorXd::Ones(unknowns_ + unseen_);
    for (Eigen::Index i = 0; i < unseen_; ++i)
      if (const auto field = size_of_[at(i)]) d[unknowns_ + i] = std::exp(noise[*field] - at_mode_[*field]);
    Eigen::MatrixXd both = d.asDiagonal() * information_ * d.asDiagonal();
    both.diagonal().tail(unseen_).array() += 1.0;
    const Eigen::LLT<Eigen::MatrixXd> factor(both);
    if (factor.info() != Eigen::Success) return -kInfinity;
    const Eigen::VectorXd half = factor.matrixL().solve(d.cwiseProduct(gradient_));
    double prior = 0.0;
    for (int field = kModelErrorSize; field < kNoiseFieldCount; ++field)
      prior += density_.log_prior_of_size(field, noise);
    return 0.5 * half.squaredNorm() - factor.matrixLLT().diagonal().array().log().sum() + prior;
  }

 private:
  const Density& density_;
  NoiseValues at_mode_;
  Eigen::Index unknowns_ = 0, unseen_ = 0;
  std::vector<std::optional<NoiseField>> size_of_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd gradient_;
};

}  // namespace

LearnedSizes learned_sizes(const Candidate& best) {
  const Density& density = *best.density;
  const Eigen::VectorXd z = density.z_of(best.mode.x);
  const NoiseValues at_mode = density.noise_of(best.mode.x);
  const DensityOfSizes of_sizes(density, z, at_mode);
  LearnedSizes found{.noise = at_mode, .wider = {}};
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int field = kModelErrorSize; field < kNoiseFieldCount; ++field) {
      Eigen::ArrayXd ln_size(kStepsBelow + kStepsAbove + 1), ln_p(ln_size.size());
      NoiseValues noise = found.noise;
      for (int k = 0; k < ln_size.size(); ++k) {
        noise[field] = ln_size[k] = density.believed_size(field) + kLnStep * (k - kStepsBelow);
        ln_p[k] = of_sizes(noise);
      }
      const Eigen::ArrayXd weight = (ln_p - ln_p.maxCoeff()).exp();
      if (weight.isFinite().all())
        found.noise[field] = 0.5 * std::log(((2.0 * ln_size).exp() * weight).sum() / weight.sum());
    }
  }
  found.wider =
      (deviations(density, z, found.noise).array() / deviations(density, z, at_mode).array().max(1e-300)).max(1.0);
  return found;
}

void stretch(const Eigen::VectorXd& wider, const ParameterMap& map, Sample& drawn) {
  for (Eigen::Index j = 0; j < wider.size(); ++j) {
    const Unknown& of = map.free()[static_cast<std::size_t>(j)];
    const muscle::Range& bounds = of.bounds;
    const double range = bounds.upper - bounds.lower;
    const Eigen::ArrayXd share =
        ((drawn.z.row(j).transpose().array() - bounds.lower) / range).max(1e-12).min(1.0 - 1e-12);
    const Eigen::ArrayXd x = share.unaryExpr([&](double at) { return math::unbounded(at, of.bound_shape()); });
    const double middle = (x * drawn.weight.array()).sum() / drawn.weight.sum();
    const Eigen::ArrayXd stretched = middle + wider[j] * (x - middle);
    const Eigen::ArrayXd z = bounds.lower + range * stretched.unaryExpr([&](double at) {
      return math::bounded(at, of.bound_shape()).share;
    });
    drawn.z.row(j) = z.max(bounds.lower).min(bounds.upper).matrix().transpose();  // for the last digit
  }
}

}  // namespace myoid::fit
