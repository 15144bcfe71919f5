#include "myoid/ground/core/clock_facts.h"

#include <cmath>

namespace myoid::inline ground {

ClockFacts clock_facts(const Eigen::VectorXd& time_s) {
  constexpr double kUneven = 1e-3;
  ClockFacts facts{.samples = time_s.size()};
  if (facts.samples == 0 || !std::isfinite(time_s[0])) return facts;
  facts.start_s = time_s[0];
  const double duration_s = time_s[facts.samples - 1] - time_s[0];
  if (!std::isfinite(duration_s)) return facts;
  facts.duration_s = duration_s;
  if (!(duration_s > 0.0)) return facts;
  const double interval_s = duration_s / static_cast<double>(facts.samples - 1);
  facts.rate_hz = 1.0 / interval_s;
  facts.even = true;
  for (Eigen::Index i = 1; i < facts.samples; ++i)
    facts.even = facts.even && std::abs(time_s[i] - time_s[i - 1] - interval_s) <= kUneven * interval_s;
  return facts;
}

}  // namespace myoid::inline ground
