#include "myoid/signals/resample.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/spline.h"

namespace myoid::signals {

TimeSeries resample(const TimeSeries& series, const Eigen::VectorXd& time_s) {
  Eigen::MatrixXd values(time_s.size(), series.channel_count());
  const Eigen::VectorXd inside =
      time_s.cwiseMax(series.time_s()[0]).cwiseMin(series.time_s()[series.sample_count() - 1]);
  const math::SplineKnots knots(series.time_s(), 3);
  for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
    values.col(c) = knots.interpolate(series.values().col(c)).evaluate(inside).value;
  }
  return {time_s, series.channels(), std::move(values)};
}

Eigen::VectorXd even_clock(double start_s, double end_s, double rate_hz) {
  if (!(end_s > start_s) || !(rate_hz > 0.0)) {
    throw InvalidInput(
        fmt::format("clock: from {} s to {} s at {} Hz is empty", start_s, end_s, rate_hz));
  }
  const auto intervals =
      static_cast<Eigen::Index>(std::max(1.0, std::round((end_s - start_s) * rate_hz)));
  return Eigen::VectorXd::LinSpaced(intervals + 1, start_s, end_s);
}

}  // namespace myoid::signals
