#include "myoid/identification/loss.h"

#include <cmath>

namespace myoid::identification {
namespace {

constexpr double kHuber = 1.345;
constexpr double kCauchy = 2.385;

}  // namespace

LossValue loss(Loss kind, double u) {
  if (kind == Loss::huber) {
    const double size = std::abs(u);
    if (size <= kHuber) return {u * u, 1.0};
    return {kHuber * (2.0 * size - kHuber), kHuber / size};
  }
  if (kind == Loss::cauchy) {
    const double x = u / kCauchy;
    return {kCauchy * kCauchy * std::log1p(x * x), 1.0 / (1.0 + x * x)};
  }
  return {u * u, 1.0};
}

}  // namespace myoid::identification
