#include "myoid/recording/signals/opensim_lowpass.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/spline.h"

namespace myoid::recording {
namespace {

constexpr double kMostSamples = 1e7;

/// Adds half of the samples at each end, reflected about the end sample.
Eigen::VectorXd padded(const Eigen::Ref<const Eigen::VectorXd>& x) {
  const Eigen::Index n = x.size();
  const Eigen::Index pad = n / 2;
  Eigen::VectorXd y(n + 2 * pad);
  for (Eigen::Index i = 0; i < pad; ++i) {
    y[i] = 2.0 * x[0] - x[pad - i];
    y[n + pad + i] = 2.0 * x[n - 1] - x[n - 2 - i];
  }
  y.segment(pad, n) = x;
  return y;
}

/// Returns the times first, first + interval, ..., each the sum of the one before and the interval: the last digit
/// decides which rows lie in a range.
Eigen::VectorXd added_times(double first_s, double last_s, double interval_s) {
  std::vector<double> times;
  for (double t = first_s; t <= last_s; t += interval_s) times.push_back(t);
  return Eigen::Map<const Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size()));
}

/// Third-order filter w^3 / ((s + w)(s^2 + w s + w^2)) with s = (z - 1)/(z + 1).
struct ThirdOrder {
  double b = 0.0, a1 = 0.0, a2 = 0.0, a3 = 0.0;
};

ThirdOrder design(double cutoff_hz, double interval_s) {
  const double w = std::tan(kPi * cutoff_hz * interval_s);
  const double p1 = w + 1.0, p0 = w - 1.0;
  const double r2 = 1.0 + w + w * w, r1 = 2.0 * (w * w - 1.0), r0 = 1.0 - w + w * w;
  const double a0 = p1 * r2;
  return {w * w * w / a0, (p1 * r1 + p0 * r2) / a0, (p1 * r0 + p0 * r1) / a0, p0 * r0 / a0};
}

/// Filters once and reverses the result in time, so that two calls are a forward and a backward pass.
Eigen::VectorXd pass(const ThirdOrder& f, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = x;
  for (Eigen::Index i = 3; i < x.size(); ++i) {
    y[i] =
        f.b * (x[i] + 3.0 * x[i - 1] + 3.0 * x[i - 2] + x[i - 3]) - f.a1 * y[i - 1] - f.a2 * y[i - 2] - f.a3 * y[i - 3];
  }
  return y.reverse();
}

}  // namespace

TimeSeries opensim_lowpass(const TimeSeries& motion, double cutoff_hz) {
  if (!(cutoff_hz > 0.0)) throw InvalidInput("low-pass filter: found {} Hz, expected above 0", cutoff_hz);
  if (motion.sample_count() < 4) {
    throw InvalidInput("low-pass filter: {} samples, expected at least 4", motion.sample_count());
  }
  require_finite(motion, "low-pass filter");
  const Eigen::VectorXd t = padded(motion.time_s());
  const double interval_s = (t.tail(t.size() - 1) - t.head(t.size() - 1)).minCoeff();
  const double intervals = (t[t.size() - 1] - t[0]) / interval_s;
  if (!(intervals < kMostSamples)) {
    throw InvalidInput(
        "low-pass filter: the smallest interval, {:.3g} s, would make {:.3g} samples of the record; are "
        "there rows of nearly the same time?",
        interval_s, intervals);
  }
  const bool is_even = (t[t.size() - 1] - t[0]) / static_cast<double>(t.size() - 1) - interval_s <=
                       std::numeric_limits<double>::epsilon();
  Eigen::VectorXd even = is_even ? t : added_times(t[0], t[t.size() - 1], interval_s);
  const ThirdOrder filter = design(std::min(cutoff_hz, 0.49 / interval_s), interval_s);
  Eigen::MatrixXd values(even.size(), motion.channel_count());
  const math::SplineKnots knots(t);
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    Eigen::VectorXd samples = padded(motion.values().col(c));
    if (!is_even) samples = knots.interpolate(samples).evaluate(even).value;
    values.col(c) = pass(filter, pass(filter, samples));
  }
  return {std::move(even), motion.channels(), std::move(values)};
}

}  // namespace myoid::recording
