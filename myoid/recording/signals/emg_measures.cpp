#include "myoid/recording/signals/emg_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/filter.h"
#include "myoid/recording/signals/spectrum.h"

namespace myoid::recording {
namespace {

constexpr double kBurstLowpass_hz = 25.0;
constexpr double kQuietSecond_s = 1.0;
constexpr double kLowestEmg_hz = 20.0, kHighestEmg_hz = 400.0;

/// Returns mean + `sd` standard deviations of the quietest second.
double burst_threshold(const Eigen::VectorXd& smooth, Eigen::Index second, double sd) {
  const Eigen::VectorXd means = math::moving_mean(smooth, second);
  Eigen::Index first = 0;
  const double mean = means.minCoeff(&first);
  const double variance = (smooth.segment(first, second).array() - mean).square().mean();
  return mean + sd * std::sqrt(variance);
}

}  // namespace

std::vector<EmgBurst> emg_bursts(const TimeSeries& filtered, Eigen::Index channel) {
  constexpr double kThreshold_sd = 5.0, kShortest_s = 0.05, kShortPause_s = 0.1;
  const Eigen::VectorXd& t = filtered.time_s();
  const TimeSeries rectified(t, {filtered.channels()[static_cast<std::size_t>(channel)]},
                             Eigen::MatrixXd(filtered.values().col(channel).cwiseAbs()));
  const Eigen::VectorXd smooth =
      zero_phase_filter(rectified, math::FilterBand::low_pass, kBurstLowpass_hz, {.order = 2, .ends = math::Ends::even})
          .values()
          .col(0);
  const double least = burst_threshold(smooth, window_samples(filtered, kQuietSecond_s), kThreshold_sd);
  std::vector<EmgBurst> bursts;
  bool on = false;
  for (Eigen::Index i = 0; i < smooth.size(); ++i) {
    const bool now = smooth[i] > least;
    if (now && !on && (bursts.empty() || t[i] - bursts.back().end_s >= kShortPause_s)) bursts.push_back({t[i], t[i]});
    if (now) bursts.back().end_s = t[i];
    on = now;
  }
  std::erase_if(bursts, [&](const EmgBurst& burst) { return burst.end_s - burst.onset_s < kShortest_s; });
  return bursts;
}

EmgWindow emg_window(const TimeSeries& filtered, Eigen::Index channel, double begin_s, double end_s) {
  EmgWindow window{.begin_s = begin_s, .end_s = end_s, .median_frequency_hz = std::numeric_limits<double>::quiet_NaN()};
  const TimeSeries part = filtered.slice(begin_s, end_s);
  const Eigen::VectorXd x = part.values().col(channel);
  if (x.size() == 0) return window;
  window.rms = std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
  if (x.size() < 8) return window;
  const double rate_hz = filtered.mean_rate_hz();
  window.median_frequency_hz = median_frequency_hz(power_spectrum(x, rate_hz, kSpectrumSegment_s), kLowestEmg_hz,
                                                   std::min(kHighestEmg_hz, 0.45 * rate_hz));
  return window;
}

std::vector<EmgWindow> emg_windows(const TimeSeries& filtered, Eigen::Index channel, double window_s) {
  if (!(window_s > 0.0)) throw InvalidInput("the window of the EMG is {} s, expected more than 0", window_s);
  std::vector<EmgWindow> windows;
  const Eigen::VectorXd& t = filtered.time_s();
  const double last_s = t[t.size() - 1] + filtered.mean_interval_s();
  const double inside_s = 0.5 * filtered.mean_interval_s();
  for (int i = 0; t[0] + (i + 1) * window_s <= last_s + inside_s; ++i) {
    const double begin_s = t[0] + i * window_s;
    windows.push_back(emg_window(filtered, channel, begin_s, begin_s + window_s - inside_s));
    windows.back().end_s = begin_s + window_s;
  }
  return windows;
}

}  // namespace myoid::recording
