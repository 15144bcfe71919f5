#include "myoid/math/moving_mean.h"

#include <algorithm>
#include <cmath>

namespace myoid::math {

Eigen::VectorXd moving_mean(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index width) {
  Eigen::VectorXd sum(x.size() + 1);
  sum[0] = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  const Eigen::Index count = x.size() - width + 1;
  return (sum.segment(width, count) - sum.head(count)) / static_cast<double>(width);
}

double greatest_mean(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz, double window_s) {
  const auto wanted = static_cast<Eigen::Index>(std::lround(window_s * rate_hz));
  return moving_mean(x, std::clamp<Eigen::Index>(wanted, 1, x.size())).maxCoeff();
}

}  // namespace myoid::math
