#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "myoid/core/time_series.h"
#include "myoid/core/units.h"
#include "myoid/math/spline.h"

namespace myoid::test {

/// What OpenSim's tools do to a motion when they are given a cut-off, so that results may be
/// compared with theirs: half a record is added at both ends by odd reflection (of the times too),
/// the whole is sampled anew by the natural quintic spline at its smallest interval, then a
/// Butterworth filter of third order runs forwards and backwards, the first three outputs of each
/// pass being its inputs. The added ends remain.
inline TimeSeries opensim_lowpass(const TimeSeries& motion, double cutoff_hz) {
  const Eigen::Index n = motion.sample_count();
  const Eigen::Index pad = n / 2;
  const auto padded = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd y(n + 2 * pad);
    for (Eigen::Index i = 0; i < pad; ++i) {
      y[i] = 2.0 * x[0] - x[pad - i];
      y[n + pad + i] = 2.0 * x[n - 1] - x[n - 2 - i];
    }
    y.segment(pad, n) = x;
    return y;
  };
  const Eigen::VectorXd t = padded(motion.time_s());
  const double interval_s = (t.tail(t.size() - 1) - t.head(t.size() - 1)).minCoeff();
  const auto count =
      static_cast<Eigen::Index>(std::floor((t[t.size() - 1] - t[0]) / interval_s)) + 1;
  const Eigen::VectorXd even =
      (t[0] + interval_s * Eigen::ArrayXd::LinSpaced(count, 0.0, static_cast<double>(count - 1)))
          .matrix();

  // s = (z - 1)/(z + 1) in w^3 / ((s + w)(s^2 + w s + w^2)).
  const double w = std::tan(kPi * cutoff_hz * interval_s);
  const double p1 = w + 1.0, p0 = w - 1.0;
  const double r2 = 1.0 + w + w * w, r1 = 2.0 * (w * w - 1.0), r0 = 1.0 - w + w * w;
  const double a0 = p1 * r2;
  const double a1 = (p1 * r1 + p0 * r2) / a0, a2 = (p1 * r0 + p0 * r1) / a0, a3 = p0 * r0 / a0,
               b = w * w * w / a0;
  const auto pass = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd y = x;
    for (Eigen::Index i = 3; i < x.size(); ++i) {
      y[i] = b * (x[i] + 3.0 * x[i - 1] + 3.0 * x[i - 2] + x[i - 3]) - a1 * y[i - 1] -
             a2 * y[i - 2] - a3 * y[i - 3];
    }
    return Eigen::VectorXd(y.reverse());
  };
  Eigen::MatrixXd values(count, motion.values().cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    values.col(c) = pass(
        pass(math::Spline::interpolate(t, padded(motion.values().col(c))).evaluate(even).value));
  }
  return {even, motion.channels(), values};
}

}  // namespace myoid::test
