#include "myoid/signals/emg_kind.h"

#include <algorithm>

#include "myoid/math/statistics.h"
#include "myoid/signals/quality_limits.h"

namespace myoid::signals {

bool is_envelope(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz) {
  constexpr double kRinging = 0.05;  // share of the maximum by which a filter may swing below zero
  const Eigen::Index n = x.size();
  if (n < 3 || x.minCoeff() < -kRinging * x.maxCoeff() || !(x.maxCoeff() > x.minCoeff())) return false;
  const double median = math::upper_median({x.begin(), x.end()});
  // With few different values the median may be the highest or the lowest of all.
  Eigen::Index above = 0;
  Eigen::Index not_below = 0;
  for (Eigen::Index i = 1; i < n; ++i) {
    above += (x[i] > median) != (x[i - 1] > median) ? 1 : 0;
    not_below += (x[i] >= median) != (x[i - 1] >= median) ? 1 : 0;
  }
  return static_cast<double>(std::max(above, not_below)) * rate_hz <= kLimits.raw_hz * static_cast<double>(n);
}

bool is_rectified(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() < 3 || !(x.minCoeff() >= 0.0) || !(x.maxCoeff() > x.minCoeff())) return false;
  const double median = math::upper_median({x.begin(), x.end()});
  const auto near = (x.array() < 0.1 * median).count();
  return static_cast<double>(near) >= kLimits.rectified_share * static_cast<double>(x.size());
}

}  // namespace myoid::signals
