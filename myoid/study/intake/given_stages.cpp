#include "myoid/study/intake/given_stages.h"

#include <algorithm>

#include "myoid/recording/signals/resample.h"

namespace myoid::study {

Eigen::MatrixXd values_at(const TimeSeries& series, const Eigen::VectorXd& time_s) {
  constexpr double kSame_s = 1e-9;
  const Eigen::VectorXd& own_s = series.time_s();
  const Eigen::Index n = time_s.size();
  const auto first = std::ranges::lower_bound(own_s, time_s[0] - kSame_s) - own_s.begin();
  if (first + n <= own_s.size() && (own_s.segment(first, n) - time_s).cwiseAbs().maxCoeff() < kSame_s)
    return series.values().middleRows(first, n);
  return recording::resample(series, time_s).values();
}

}  // namespace myoid::study
