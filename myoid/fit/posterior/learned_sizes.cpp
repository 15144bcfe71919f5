#include "myoid/fit/posterior/learned_sizes.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/math/bounded.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::fit {
namespace {

constexpr double kMostWider = 2.0;  // of y' over y: a size that the torque hardly tells has a long tail

Eigen::VectorXd deviations(const Density& density, const Eigen::VectorXd& z, const NoiseValues& noise) {
  return math::inverse_of_positive(density.likelihood().information(z, noise).information + density.precision())
      .diagonal()
      .cwiseMax(0.0)
      .cwiseSqrt();
}

}  // namespace

LearnedSizes learned_sizes(const Candidate& best, const Sample& drawn) {
  const Density& density = *best.density;
  const Eigen::VectorXd z = density.z_of(best.mode.x);
  const NoiseValues at_mode = density.noise_of(best.mode.x);
  LearnedSizes found{.noise = at_mode, .wider = {}};
  const Eigen::VectorXd weight = drawn.weight.head(drawn.of_best) / drawn.weight.head(drawn.of_best).sum();
  for (int field = kModelErrorSize; field < kNoiseFieldCount; ++field) {
    const Eigen::ArrayXd ln_size = drawn.noise.row(field).head(drawn.of_best).transpose();
    const double squares = ((2.0 * ln_size).exp() * weight.array()).sum();
    found.noise[field] = std::clamp(0.5 * std::log(squares), at_mode[field], at_mode[field] + std::log(kMostWider));
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
