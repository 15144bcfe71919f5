#pragma once

#include "myoid/identification/options.h"

namespace myoid::identification {

/// rho(u) and psi(u) / u of a standardized residual.
struct LossValue {
  double rho = 0.0;
  double weight = 1.0;
};

/// Returns the cost rho of a residual of u standard deviations: u^2, and for Huber's and Cauchy's
/// loss less where u is large (1.345 and 2.385 are as good as the square by 95 % for normal
/// residuals).
[[nodiscard]] LossValue loss(Loss kind, double u);

}  // namespace myoid::identification
