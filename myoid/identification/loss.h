#pragma once

#include "myoid/identification/options.h"

namespace myoid::identification {

/// rho(u) and psi(u) / u of a standardized residual u.
struct LossValue {
  double rho = 0.0;
  double weight = 1.0;
};

/// Returns the cost rho of a residual of u standard deviations: u^2, or less at large u by Huber's and Cauchy's loss.
/// Their scales of 1.345 and 2.385 give 95 % of the square's efficiency for normal residuals.
[[nodiscard]] LossValue loss(Loss kind, double u);

}  // namespace myoid::identification
