#include "myoid/ground/math/bounded.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myoid::inline ground::math {
namespace {

constexpr double kSoft = 0.05;  // w

/// Returns ln(1 + exp(v)).
double softplus(double v) { return std::max(v, 0.0) + std::log1p(std::exp(-std::abs(v))); }

/// Returns ln cosh(v).
double log_cosh(double v) { return std::abs(v) + std::log1p(std::exp(-2.0 * std::abs(v))) - std::numbers::ln2; }

}  // namespace

Bounded bounded(double x, BoundShape shape) {
  if (shape == BoundShape::gradual) {
    const double share = 1.0 / (1.0 + std::exp(-x)), slope = share / (1.0 + std::exp(x));
    return {.share = share,
            .slope = slope,
            .log_slope = -softplus(x) - softplus(-x),
            .pull = 1.0 - 2.0 * share,
            .curvature = 2.0 * slope};
  }
  const double from_lower = (0.5 + 0.25 * x) / kSoft, from_upper = from_lower - 1.0 / kSoft;
  // dt/dy is the difference of two logistic functions, sinh((a - b) / 2) / (2 cosh(a / 2) cosh(b / 2)).
  const double a = std::tanh(0.5 * from_lower), b = std::tanh(0.5 * from_upper);
  Bounded at;
  at.share = kSoft * (softplus(from_lower) - softplus(from_upper));
  at.log_slope = std::log(0.125 * std::sinh(0.5 / kSoft)) - log_cosh(0.5 * from_lower) - log_cosh(0.5 * from_upper);
  at.slope = std::exp(at.log_slope);
  at.pull = -(a + b) / (8.0 * kSoft);
  at.curvature = (2.0 - a * a - b * b) / (64.0 * kSoft * kSoft);
  return at;
}

double unbounded(double share, BoundShape shape) {
  if (shape == BoundShape::gradual) return std::log(share / (1.0 - share));
  const double e = std::expm1(share / kSoft) / -std::expm1((share - 1.0) / kSoft);
  return 4.0 * (kSoft * std::log(e) - 0.5);
}

}  // namespace myoid::inline ground::math
