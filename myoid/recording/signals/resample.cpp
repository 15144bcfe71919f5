#include "myoid/recording/signals/resample.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/spline.h"

namespace myoid::recording {
namespace {

/// Half the window, in samples of the new clock: Kaiser's formula for 100 dB and a transition of a
/// fifth of half the rate, (100 - 8) / (2.285 * 0.2 pi) / 2.
constexpr double kReach = 32.0;
constexpr double kBeta = 0.1102 * (100.0 - 8.7);
/// Cut-off relative to half the new rate: the middle of the transition.
constexpr double kCutoff = 0.9;
constexpr double kTableStep = 1e-3;  ///< In samples of the new clock; linear between.
constexpr double kSamePhase = 1e-7;  ///< In samples of the given clock.
constexpr double kSlower = 0.99;     ///< A clock below this share of the given rate counts as slower.
constexpr double kUneven = 0.02;     ///< Clocks whose intervals vary by more are uneven.
constexpr Eigen::Index kFewest = 4;  ///< Least samples of a stretch of markers.

/// Modified Bessel function of the first kind, order 0.
double bessel_i0(double x) {
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    const double factor = x / (2.0 * k);
    term *= factor * factor;
    sum += term;
  }
  return sum;
}

/// Returns the kernel over its distance in samples of the new clock, from 0 to kReach.
const std::vector<double>& kernel_table() {
  static const std::vector<double> table = [] {
    const auto count = static_cast<std::size_t>(kReach / kTableStep) + 2;
    std::vector<double> values(count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = static_cast<double>(i) * kTableStep;
      if (x >= kReach) break;
      const double window = bessel_i0(kBeta * std::sqrt(1.0 - (x / kReach) * (x / kReach))) / bessel_i0(kBeta);
      const double angle = kPi * kCutoff * x;
      values[i] = window * kCutoff * (x == 0.0 ? 1.0 : std::sin(angle) / angle);
    }
    return values;
  }();
  return table;
}

double kernel(double distance) {
  const std::vector<double>& table = kernel_table();
  const double at = std::abs(distance) / kTableStep;
  const auto i = static_cast<std::size_t>(at);
  if (i + 1 >= table.size()) return 0.0;
  return table[i] + (at - static_cast<double>(i)) * (table[i + 1] - table[i]);
}

Eigen::MatrixXd splined(const TimeSeries& series, const Eigen::VectorXd& inside) {
  const math::SplineKnots knots(series.time_s(), 3);
  Eigen::MatrixXd values(inside.size(), series.channel_count());
  for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
    values.col(c) = knots.interpolate(series.values().col(c)).evaluate(inside).value;
  }
  return values;
}

/// Returns the low-passed series at times inside it. The weights of each time are scaled to sum 1,
/// so that a constant stays unchanged.
Eigen::MatrixXd low_passed(const TimeSeries& given, const Eigen::VectorXd& inside, double rate_hz) {
  require_finite(given, "resampling");
  const Eigen::Index n = given.sample_count();
  const bool even = given.is_uniform(kUneven);
  const double first_s = given.time_s()[0];
  const double last_s = given.time_s()[n - 1];
  const Eigen::MatrixXd made_even =
      even ? Eigen::MatrixXd() : splined(given, Eigen::VectorXd::LinSpaced(n, first_s, last_s));
  const Eigen::MatrixXd& x = even ? given.values() : made_even;
  const double step_s = (last_s - first_s) / static_cast<double>(n - 1);
  const double reach_s = kReach / rate_hz;
  // Clocks with a common ratio have few phases: the weights of the last phase are kept.
  Eigen::VectorXd weights;
  double phase = -1.0;
  Eigen::MatrixXd result(inside.size(), x.cols());
  for (Eigen::Index i = 0; i < inside.size(); ++i) {
    const double begin = (inside[i] - reach_s - first_s) / step_s;
    const auto low = static_cast<Eigen::Index>(std::ceil(begin));
    const double here = static_cast<double>(low) - begin;
    if (!(std::abs(here - phase) < kSamePhase)) {
      phase = here;
      const auto count = static_cast<Eigen::Index>(std::floor(2.0 * reach_s / step_s - here)) + 1;
      weights.resize(count);
      for (Eigen::Index k = 0; k < count; ++k)
        weights[k] = kernel((here + static_cast<double>(k)) * step_s * rate_hz - kReach);
      weights /= weights.sum();
    }
    const Eigen::Index count = weights.size();
    if (low >= 0 && low + count <= n) {
      result.row(i).noalias() = weights.transpose() * x.middleRows(low, count);
      continue;
    }
    result.row(i).setZero();
    for (Eigen::Index k = low; k < low + count; ++k) {
      const double w = weights[k - low];
      if (k >= 0 && k < n) {
        result.row(i) += w * x.row(k);
      } else if (k < 0) {
        result.row(i) += w * (2.0 * x.row(0) - x.row(std::min(-k, n - 1)));
      } else {
        result.row(i) += w * (2.0 * x.row(n - 1) - x.row(std::max(2 * (n - 1) - k, Eigen::Index{0})));
      }
    }
  }
  return result;
}

/// Returns the series at times inside it, on a clock of `rate_hz`; 0: a clock of one time.
Eigen::MatrixXd at_times(const TimeSeries& series, const Eigen::VectorXd& inside, double rate_hz) {
  const bool slower = rate_hz > 0.0 && series.sample_count() > 2 && rate_hz < kSlower * series.mean_rate_hz();
  return slower ? low_passed(series, inside, rate_hz) : splined(series, inside);
}

double rate_of(const Eigen::VectorXd& time_s) {
  const Eigen::Index n = time_s.size();
  return n > 1 ? static_cast<double>(n - 1) / (time_s[n - 1] - time_s[0]) : 0.0;
}

}  // namespace

TimeSeries anti_aliased(const TimeSeries& series, double rate_hz) {
  if (series.sample_count() < 3 || rate_hz > kSlower * series.mean_rate_hz()) return series;
  return {series.time_s(), series.channels(), low_passed(series, series.time_s(), rate_hz)};
}

TimeSeries resample(const TimeSeries& series, const Eigen::VectorXd& time_s) {
  const Eigen::VectorXd inside =
      time_s.cwiseMax(series.time_s()[0]).cwiseMin(series.time_s()[series.sample_count() - 1]);
  return {time_s, series.channels(), at_times(series, inside, rate_of(time_s))};
}

Eigen::VectorXd even_clock(double start_s, double end_s, double rate_hz) {
  if (!(end_s > start_s) || !(rate_hz > 0.0)) {
    throw InvalidInput("clock: from {} s to {} s at {} Hz is empty", start_s, end_s, rate_hz);
  }
  const auto intervals = static_cast<Eigen::Index>(std::max(1.0, std::round((end_s - start_s) * rate_hz)));
  return Eigen::VectorXd::LinSpaced(intervals + 1, start_s, end_s);
}

MarkerSeries resample(const MarkerSeries& markers, const Eigen::VectorXd& time_s) {
  MarkerSeries result;
  result.names = markers.names;
  result.time_s = time_s;
  result.positions_m = Eigen::MatrixXd::Constant(time_s.size(), markers.positions_m.cols(), kNan);
  const Eigen::Index n = markers.frame_count();
  const std::vector<Channel> axes{{"x", Unit::meter}, {"y", Unit::meter}, {"z", Unit::meter}};
  const double rate_hz = rate_of(time_s);
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    for (Eigen::Index first = 0; first < n;) {
      if (markers.missing(first, m)) {
        ++first;
        continue;
      }
      Eigen::Index end = first;
      while (end < n && !markers.missing(end, m)) ++end;
      if (end - first >= kFewest) {
        const TimeSeries stretch(markers.time_s.segment(first, end - first), axes,
                                 markers.positions_m.block(first, 3 * m, end - first, 3));
        // Times up to half a frame beyond the ends count as inside.
        const double slack_s = 0.5 * stretch.mean_interval_s();
        Eigen::Index a = 0;
        while (a < time_s.size() && time_s[a] < markers.time_s[first] - slack_s) ++a;
        Eigen::Index b = a;
        while (b < time_s.size() && time_s[b] <= markers.time_s[end - 1] + slack_s) ++b;
        if (b > a) {
          const Eigen::VectorXd inside =
              time_s.segment(a, b - a).cwiseMax(markers.time_s[first]).cwiseMin(markers.time_s[end - 1]);
          result.positions_m.block(a, 3 * m, b - a, 3) = at_times(stretch, inside, rate_hz);
        }
      }
      first = end;
    }
  }
  return result;
}

}  // namespace myoid::recording
