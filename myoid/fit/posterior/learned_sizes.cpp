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

constexpr double kLeastLnShare = -4.0, kMostLnShare = 1.4;  // of the believed size: 2 % to 4 times
constexpr int kSizes = 28;
constexpr int kSweeps = 2;  // over the sizes, each given the others

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
      : at_mode_(noise), size_of_(at(z.size())) {
    const Likelihood& likelihood = density.likelihood();
    for (const UnseenQuantity& each : likelihood.unseen().quantities) size_of_.push_back(each.size);
    const auto both = static_cast<Eigen::Index>(size_of_.size()), unseen = both - z.size();
    information_.setZero(both, both);
    for (const Eigen::MatrixXd& of_trial : likelihood.information_by_trial(z, noise)) information_ += of_trial;
    // Both gradients follow from the expectation of x at the mode of z.
    const Eigen::VectorXd mean = likelihood.unseen_given(z, noise).mean;
    gradient_ = information_.rightCols(unseen) * mean;
    gradient_.tail(unseen) += mean;
    precision_.setIdentity(both, both);
    precision_.topLeftCorner(z.size(), z.size()) = density.precision();
  }

  /// Returns ln p of one size at each y of `ln_size`, over a constant, without its prior. The others are those of
  /// `noise`. With their quantities and z integrated out, the kind's own have the information y^2 K.
  [[nodiscard]] Eigen::ArrayXd log_density(int field, const NoiseValues& noise, const Eigen::ArrayXd& ln_size) const {
    std::vector<Eigen::Index> own, rest;
    Eigen::VectorXd d = Eigen::VectorXd::Ones(information_.rows());
    for (Eigen::Index i = 0; i < d.size(); ++i) {
      const std::optional<NoiseField> size = size_of_[at(i)];
      (size == field ? own : rest).push_back(i);
      if (size && size != field) d[i] = std::exp(noise[*size] - at_mode_[*size]);
    }
    if (own.empty()) return Eigen::ArrayXd::Zero(ln_size.size());
    const Eigen::MatrixXd scaled = d.asDiagonal() * information_ * d.asDiagonal();
    const Eigen::VectorXd gradient = d.cwiseProduct(gradient_);
    const Eigen::LLT<Eigen::MatrixXd> factor(scaled(rest, rest) + precision_(rest, rest));
    const Eigen::MatrixXd half = factor.matrixL().solve(scaled(rest, own));
    const math::SymmetricEigen k = math::symmetric_eigen(scaled(own, own) - half.transpose() * half);
    const Eigen::VectorXd pull = gradient(own) - half.transpose() * factor.matrixL().solve(gradient(rest));
    const Eigen::ArrayXd squares = (k.vectors.transpose() * pull).array().square(),
                         information = k.values.cwiseMax(0.0);
    return ln_size.unaryExpr([&](double ln_y) {
      const double square = std::exp(2.0 * (ln_y - at_mode_[field]));
      const Eigen::ArrayXd posterior = 1.0 + square * information;
      return 0.5 * (square * squares / posterior - posterior.log()).sum();
    });
  }

 private:
  NoiseValues at_mode_;
  std::vector<std::optional<NoiseField>> size_of_;  ///< Of z and of x.
  Eigen::MatrixXd information_, precision_;
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
      const Eigen::ArrayXd ln_share = Eigen::ArrayXd::LinSpaced(kSizes, kLeastLnShare, kMostLnShare);
      const Eigen::ArrayXd ln_size = ln_share + density.believed_size(field);
      const Eigen::ArrayXd ln_p =
          of_sizes.log_density(field, found.noise, ln_size) + ln_share - 0.5 * (2.0 * ln_share).exp();
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
