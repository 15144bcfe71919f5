#pragma once

#include <cmath>

#include "myoid/identification/options.h"

namespace myoid::identification {

/// rho(u) and psi(u) / u of a standardized residual u.
struct LossValue {
  double rho = 0.0;
  double weight = 1.0;
};

/// Returns the cost rho of a residual of u standard deviations: u^2, or less at large u by Huber's and Cauchy's loss.
/// Their scales of 1.345 and 2.385 give 95 % of the square's efficiency for normal residuals.
[[nodiscard]] inline LossValue loss(Loss kind, double u) {
  constexpr double kHuber = 1.345, kCauchy = 2.385;
  const double size = std::abs(u);
  if (kind == Loss::huber && !(size <= kHuber)) return {kHuber * (2.0 * size - kHuber), kHuber / size};
  if (kind == Loss::cauchy) {
    const double x = u / kCauchy;
    return {kCauchy * kCauchy * std::log1p(x * x), 1.0 / (1.0 + x * x)};
  }
  return {u * u, 1.0};
}

}  // namespace myoid::identification
