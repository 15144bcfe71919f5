#include "myoid/recording/signals/emg_reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {
namespace {

constexpr double kHalfSecond_s = 0.5;
/// A recording cut to a cycle of a movement may begin and end with an effort.
constexpr double kLongRecording_s = 3.0;
/// The low-pass spreads a peak by this much to each side.
constexpr double kFlank_s = 0.2;
constexpr std::size_t kMostPeaks = 20;

/// The means over half a second of one trial.
struct HalfSeconds {
  std::size_t trial = 0;
  Eigen::Index width = 1, flank = 0;
  double interval_s = 0.0, begin_s = 0.0, length_s = 0.0;
  Eigen::VectorXd means;

  [[nodiscard]] bool at_end(Eigen::Index i) const {
    if (length_s < kLongRecording_s) return false;
    const double middle_s = interval_s * static_cast<double>(i + width / 2);
    return std::min(middle_s, length_s - middle_s) < kHalfSecond_s;
  }
};

std::vector<HalfSeconds> half_seconds(std::span<const TrialEnvelope> trials, const std::string& channel) {
  std::vector<HalfSeconds> found;
  for (std::size_t k = 0; k < trials.size(); ++k) {
    const TimeSeries& envelope = *trials[k].envelope;
    if (!envelope.find(channel) || envelope.sample_count() < 2) continue;
    HalfSeconds one{.trial = k, .width = window_samples(envelope, kHalfSecond_s)};
    one.flank = window_samples(envelope, kFlank_s);
    one.interval_s = envelope.mean_interval_s();
    one.begin_s = envelope.time_s()[0];
    one.length_s = one.interval_s * static_cast<double>(envelope.sample_count());
    one.means = math::moving_mean(envelope.column(channel), one.width);
    found.push_back(std::move(one));
  }
  return found;
}

/// The greatest half second of those that `counts` admits.
struct Greatest {
  const HalfSeconds* in = nullptr;
  Eigen::Index at = 0;
  double mean = 0.0;
};

template <typename Counts>
Greatest greatest_half_second(const std::vector<HalfSeconds>& all, const Counts& counts) {
  Greatest found;
  for (const HalfSeconds& one : all) {
    for (Eigen::Index i = 0; i < one.means.size(); ++i) {
      if (one.means[i] > found.mean && counts(one, i)) found = {&one, i, one.means[i]};
    }
  }
  return found;
}

LonePeak lone_peak_of(const Greatest& top, double next) {
  const HalfSeconds& in = *top.in;
  LonePeak peak{.trial = in.trial, .ratio = top.mean / next, .at_end = in.at_end(top.at)};
  peak.first_sample = std::max<Eigen::Index>(0, top.at - in.flank);
  peak.samples = top.at + in.width + in.flank - peak.first_sample;
  peak.begin_s = in.begin_s + in.interval_s * static_cast<double>(top.at);
  peak.end_s = peak.begin_s + in.interval_s * static_cast<double>(in.width);
  return peak;
}

}  // namespace

std::vector<LonePeak> lone_peaks(std::span<const TrialEnvelope> trials, const std::string& channel) {
  std::vector<LonePeak> peaks;
  const std::vector<HalfSeconds> all = half_seconds(trials, channel);
  double quiet = kInfinity;
  for (const HalfSeconds& one : all) quiet = std::min(quiet, one.means.minCoeff());
  while (peaks.size() < kMostPeaks) {
    const auto free = [&](const HalfSeconds& one, Eigen::Index i) { return !touches(peaks, one.trial, i, one.width); };
    const Greatest top = greatest_half_second(all, free);
    if (top.in == nullptr) break;
    const auto apart = [&](const HalfSeconds& one, Eigen::Index i) {
      return free(one, i) && (&one != top.in || std::abs(i - top.at) >= one.width);
    };
    const auto inside = [&](const HalfSeconds& one, Eigen::Index i) { return apart(one, i) && !one.at_end(i); };
    Greatest next = greatest_half_second(all, inside);
    if (next.in == nullptr) next = greatest_half_second(all, apart);
    const double limit = top.in->at_end(top.at) ? kLimits.levels.lone_reference_at_end : kLimits.levels.lone_reference;
    if (next.in == nullptr || !(top.mean > limit * next.mean)) break;
    peaks.push_back(lone_peak_of(top, next.mean));
    peaks.back().replaced = next.mean > kLimits.emg.signal_to_rest * quiet;
    if (!peaks.back().replaced) break;
  }
  return peaks;
}

bool touches(const std::vector<LonePeak>& peaks, std::size_t trial, Eigen::Index first, Eigen::Index count) {
  return std::ranges::any_of(peaks, [&](const LonePeak& peak) {
    return peak.replaced && peak.trial == trial && first < peak.first_sample + peak.samples &&
           peak.first_sample < first + count;
  });
}

}  // namespace myoid::recording
