#include "myoid/recording/signals/emg_spikes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {
namespace {

constexpr double kAround_s = 0.25;
constexpr double kPercentile = 0.98;

/// The usual values of a stretch of the signal.
struct Around {
  double median = 0.0;
  double high = 0.0;  ///< Distance from the median that 98 % of the samples keep.
};

Around usual_values(const Eigen::Ref<const Eigen::VectorXd>& x) {
  std::vector<double> sorted(x.begin(), x.end());
  const auto at = [&](double share) {
    const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), nth, sorted.end());
    return *nth;
  };
  Around around{.median = at(0.5), .high = 0.0};
  for (double& value : sorted) value = std::abs(value - around.median);
  around.high = at(kPercentile);
  return around;
}

/// Widens [first, last] while the samples beside it are farther than `level` from the median, up to `most` samples in
/// each direction.
void widen(const Eigen::Ref<const Eigen::VectorXd>& x,
           double median,
           double level,
           Eigen::Index most,
           Eigen::Index& first,
           Eigen::Index& last) {
  const Eigen::Index lowest = std::max<Eigen::Index>(0, first - most);
  const Eigen::Index highest = std::min(x.size() - 1, last + most);
  while (first > lowest && std::abs(x[first - 1] - median) > level) --first;
  while (last < highest && std::abs(x[last + 1] - median) > level) ++last;
}

}  // namespace

std::vector<EmgSpike> find_spikes(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz) {
  std::vector<EmgSpike> spikes;
  const auto width = static_cast<Eigen::Index>(kAround_s * rate_hz);
  if (width < 10 || x.size() < width) return spikes;
  const Eigen::Index count = x.size() / width;
  const auto begin = [&](Eigen::Index w) { return w < count ? w * width : x.size(); };
  std::vector<Around> around;
  for (Eigen::Index w = 0; w < count; ++w) around.push_back(usual_values(x.segment(begin(w), begin(w + 1) - begin(w))));
  const auto narrow = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(kLimits.emg.spike_s * rate_hz));
  for (Eigen::Index w = 0; w < count; ++w) {
    double high = 0.0;
    for (Eigen::Index v = std::max<Eigen::Index>(0, w - 1); v <= std::min(count - 1, w + 1); ++v)
      high = std::max(high, around[static_cast<std::size_t>(v)].high);
    const double median = around[static_cast<std::size_t>(w)].median;
    const double limit = kLimits.emg.spike_over_emg * high;
    for (Eigen::Index i = begin(w); i < begin(w + 1); ++i) {
      if (!(limit > 0.0) || !(std::abs(x[i] - median) > limit)) continue;
      if (!spikes.empty() && i < spikes.back().begin + spikes.back().length) continue;
      EmgSpike spike{.begin = i, .length = 1, .peak = i, .height = std::abs(x[i] - median)};
      for (Eigen::Index j = i + 1; j < std::min(x.size(), i + narrow); ++j) {
        if (std::abs(x[j] - median) > spike.height) spike.peak = j, spike.height = std::abs(x[j] - median);
      }
      Eigen::Index first = spike.peak;
      Eigen::Index last = spike.peak;
      widen(x, median, 0.5 * spike.height, narrow, first, last);
      if (last - first + 1 > narrow) continue;
      widen(x, median, 0.5 * limit, narrow, first, last);
      spike.begin = first;
      spike.length = last - first + 1;
      spikes.push_back(spike);
    }
  }
  return spikes;
}

Remark spike_remark(const std::string& channel, const Eigen::VectorXd& time_s, const std::vector<EmgSpike>& spikes) {
  const EmgSpike& highest = *std::max_element(spikes.begin(), spikes.end(),
                                              [](const EmgSpike& a, const EmgSpike& b) { return a.height < b.height; });
  return {.code = RemarkCode::emg_artifact,
          .severity = Severity::warning,
          .about = channel,
          .when = Stretch{time_s[highest.begin], time_s[highest.begin + highest.length - 1]},
          .value = highest.height,
          .says = fmt::format("channel '{}' has {} of {:.3g} mV at {:.6g} s, narrower than any EMG", channel,
                              spikes.size() > 1 ? fmt::format("{} spikes, the highest", spikes.size()) : "a spike",
                              1e3 * highest.height, time_s[highest.peak]),
          .remedy = "straight lines between the samples beside them take the place of spikes; check plugs and cables"};
}

Eigen::VectorXd without_spikes(const Eigen::Ref<const Eigen::VectorXd>& x, const std::vector<EmgSpike>& spikes) {
  Eigen::VectorXd mended = x;
  for (const EmgSpike& spike : spikes) {
    const Eigen::Index before = spike.begin - 1;
    const Eigen::Index after = spike.begin + spike.length;
    if (before < 0 && after >= x.size()) continue;
    const double left = before >= 0 ? mended[before] : x[after];
    const double right = after < x.size() ? x[after] : left;
    for (Eigen::Index i = spike.begin; i < after; ++i)
      mended[i] = left + (right - left) * static_cast<double>(i - before) / static_cast<double>(after - before);
  }
  return mended;
}

}  // namespace myoid::recording
