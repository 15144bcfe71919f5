#include "myoid/recording/signals/whitening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/spectrum.h"
#include "myoid/recording/tables/instrument_names.h"

namespace myoid::recording {
namespace {

constexpr double kShortSegment_s = 0.25;
constexpr double kQuiet_s = 1.0;
/// Ratio to the quietest second's power below which a segment is quiet.
constexpr double kQuiet = 1.5;
/// Ratio to the mean power of the quiet segments above which a segment is active.
constexpr double kLoud = 3.0;
constexpr std::size_t kFewestSegments = 20;
constexpr double kSmooth_hz = 10.0;   ///< Half width of the smoothing of a spectrum.
constexpr double kMostGain = 1000.0;  ///< Of power; 30 dB.
constexpr double kHalfLength_s = 0.016;
/// Least growth of the bandwidth, geometric mean over the channels.
constexpr double kWorthIt = 1.1;
constexpr double kSlowest_hz = 500.0;
/// Share of the mean power density in the band, if the muscle never rests.
constexpr double kFaintNoise = 0.01;

/// Periodograms of all segments of one channel, one column each.
struct Segments {
  Eigen::VectorXd frequency_hz;
  std::vector<Eigen::VectorXd> density;
  std::vector<double> power;
  double quiet_power = kInfinity;
  Eigen::VectorXd quiet;  ///< Mean density of the quiet segments; `quiet_power` is its sum.
};

Segments segments_of(std::span<const TimeSeries* const> trials, const std::string& channel) {
  Segments result;
  for (const TimeSeries* trial : trials) {
    const double rate_hz = trial->mean_rate_hz();
    const Eigen::VectorXd x = trial->column(channel);
    const auto length = static_cast<Eigen::Index>(std::lround(kShortSegment_s * rate_hz));
    const auto per_quiet = static_cast<std::size_t>(std::lround(kQuiet_s / kShortSegment_s));
    std::vector<Eigen::VectorXd> density;
    std::vector<double> power;
    for (Eigen::Index first = 0; first + length <= x.size(); first += length) {
      PowerSpectrum spectrum = power_spectrum(x.segment(first, length), rate_hz, kShortSegment_s);
      result.frequency_hz = spectrum.frequency_hz;
      power.push_back(spectrum.density.sum() * spectrum.frequency_hz[1]);
      density.push_back(std::move(spectrum.density));
    }
    for (std::size_t i = 0; i + per_quiet <= power.size(); ++i) {
      double mean = 0.0;
      for (std::size_t k = i; k < i + per_quiet; ++k) mean += power[k] / static_cast<double>(per_quiet);
      result.quiet_power = std::min(result.quiet_power, mean);
    }
    std::move(density.begin(), density.end(), std::back_inserter(result.density));
    result.power.insert(result.power.end(), power.begin(), power.end());
  }
  result.quiet = Eigen::VectorXd::Zero(result.frequency_hz.size());
  double count = 0.0;
  for (std::size_t i = 0; i < result.power.size(); ++i) {
    if (!(result.power[i] <= kQuiet * result.quiet_power)) continue;
    result.quiet += result.density[i];
    count += 1.0;
  }
  if (count > 0.0) {
    result.quiet /= count;
    result.quiet_power = result.quiet.sum() * result.frequency_hz[1];
  }
  return result;
}

/// Applies a running median, which neither a notch nor a line moves, then a running mean.
Eigen::VectorXd smoothed(const Eigen::VectorXd& density, double bin_hz) {
  const auto reach = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::lround(kSmooth_hz / bin_hz)));
  const Eigen::Index n = density.size();
  const auto running = [&](const Eigen::VectorXd& x, const auto& of) {
    Eigen::VectorXd y(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Index r = std::min({reach, k, n - 1 - k});
      y[k] = of(x.segment(k - r, 2 * r + 1));
    }
    return y;
  };
  const Eigen::VectorXd median =
      running(density, [](const auto& x) { return math::median(std::vector<double>(x.begin(), x.end())); });
  return running(median, [](const auto& x) { return x.mean(); });
}

/// Returns the bandwidth of a mean square after a filter of power gain w, as an estimate of the
/// power of a signal s in noise n.
double bandwidth_hz(const Eigen::VectorXd& w, const Eigen::VectorXd& s, const Eigen::VectorXd& n, double bin_hz) {
  const double sensitivity = w.dot(s);
  const double spread = w.cwiseProduct(s + n).squaredNorm();
  return spread > 0.0 ? bin_hz * sensitivity * sensitivity / spread : 0.0;
}

/// Returns taps whose amplitude response follows the root of `gain`: the inverse Fourier sum under a Hann window.
Eigen::VectorXd taps_of(const Eigen::VectorXd& gain, double bin_hz, double rate_hz) {
  const auto count = static_cast<Eigen::Index>(std::lround(kHalfLength_s * rate_hz));
  Eigen::VectorXd half(count + 1);
  for (Eigen::Index m = 0; m <= count; ++m) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < gain.size(); ++k) {
      const double ends = k == 0 || k + 1 == gain.size() ? 0.5 : 1.0;
      sum += ends * std::sqrt(gain[k]) *
             std::cos(2.0 * std::numbers::pi * bin_hz * static_cast<double>(k) * static_cast<double>(m) / rate_hz);
    }
    const double window =
        0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(m) / static_cast<double>(count + 1));
    half[m] = window * sum;
  }
  return half;
}

/// Returns the power gain of symmetric taps at the bins.
Eigen::VectorXd gain_of(const Eigen::VectorXd& half, Eigen::Index bins, double bin_hz, double rate_hz) {
  Eigen::VectorXd gain(bins);
  for (Eigen::Index k = 0; k < bins; ++k) {
    double sum = half[0];
    for (Eigen::Index m = 1; m < half.size(); ++m) {
      sum += 2.0 * half[m] *
             std::cos(2.0 * std::numbers::pi * bin_hz * static_cast<double>(k) * static_cast<double>(m) / rate_hz);
    }
    gain[k] = sum * sum;
  }
  return gain;
}

/// Bins between which a spectrum is trusted: above the high-pass, below the converter's filter.
struct Band {
  Eigen::Index low = 0, high = 0;
};

/// Power densities of the muscle at a small effort and of the noise.
struct Spectra {
  Eigen::VectorXd signal, noise;
};

/// Sets a signal below three times its standard error to noise: a periodogram's bin spreads by its
/// own size, and smoothing averages some bins.
Eigen::VectorXd significant(const Eigen::VectorXd& signal, const Eigen::VectorXd& noise, double segments) {
  const Eigen::VectorXd least = 3.0 / std::sqrt(segments) * (noise + signal.cwiseMax(0.0));
  return (signal.array() > least.array()).select(signal, 0.0);
}

/// Returns muscle and noise from active and quiet segments; empty if fewer than 20 are active.
std::optional<Spectra> from_rest(const Segments& segments, double bin_hz) {
  std::vector<double> active;
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(segments.frequency_hz.size());
  for (std::size_t i = 0; i < segments.power.size(); ++i) {
    const double above = segments.power[i] - segments.quiet_power;
    if (!(segments.power[i] > kLoud * segments.quiet_power)) continue;
    active.push_back(above);
    shape += (segments.density[i] - segments.quiet) / above;
  }
  if (active.size() < kFewestSegments) return std::nullopt;
  const auto count = static_cast<double>(active.size());
  std::sort(active.begin(), active.end());
  const double power = active[active.size() / 4];
  const Eigen::VectorXd noise = smoothed(segments.quiet, bin_hz);
  return Spectra{significant(power * smoothed(shape / count, bin_hz), noise, count), noise};
}

/// Returns muscle and noise if no segment is active and none is quiet, as in an effort sustained
/// from the first sample to the last. The noise is taken as white, with the least density in the
/// band, but at most a hundredth of the mean density: otherwise EMG of a flat spectrum would all be
/// noise. Empty if some segment is active or there are fewer than 20.
std::optional<Spectra> without_rest(const Segments& segments, const Band& band, double bin_hz) {
  if (segments.power.size() < kFewestSegments) return std::nullopt;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(segments.frequency_hz.size());
  for (std::size_t i = 0; i < segments.power.size(); ++i) {
    if (segments.power[i] > kLoud * segments.quiet_power) return std::nullopt;
    mean += segments.density[i];
  }
  const auto count = static_cast<double>(segments.power.size());
  const Eigen::VectorXd total = smoothed(mean / count, bin_hz);
  const auto in_band = total.segment(band.low, band.high - band.low + 1);
  const double least = std::min(in_band.minCoeff(), kFaintNoise * in_band.mean());
  const Eigen::VectorXd noise = Eigen::VectorXd::Constant(total.size(), least);
  return Spectra{significant(total - noise, noise, count), noise};
}

/// Returns the reason why no channel of these trials can be whitened; empty if there is none.
std::string unfit(std::span<const TimeSeries* const> trials) {
  const double rate_hz = trials.front()->mean_rate_hz();
  if (rate_hz < kSlowest_hz) return fmt::format("sampled at {:.0f} Hz", rate_hz);
  for (const TimeSeries* trial : trials) {
    if (std::abs(trial->mean_rate_hz() - rate_hz) > 1e-3 * rate_hz) return "sampled at different rates";
  }
  return {};
}

/// Sets the filter for these spectra, and the bandwidths before and after.
void set_filter(const Spectra& spectra, const Band& band, double bin_hz, WhiteningFilter& filter) {
  const Eigen::VectorXd& signal = spectra.signal;
  const Eigen::VectorXd& noise = spectra.noise;
  const Eigen::Index bins = signal.size();
  Eigen::VectorXd gain =
      signal.cwiseQuotient((signal + noise).cwiseAbs2().cwiseMax(std::numeric_limits<double>::min()));
  gain.head(band.low).setConstant(gain[band.low]);
  gain.tail(bins - band.high).setConstant(gain[band.high]);
  // The gain is limited relative to its least value, where the muscle prevails.
  Eigen::Index top = 0;
  signal.maxCoeff(&top);
  gain = gain.cwiseMin(kMostGain * gain[top]);
  const Eigen::VectorXd half = taps_of(gain, bin_hz, filter.rate_hz);
  const Eigen::VectorXd real = gain_of(half, bins, bin_hz, filter.rate_hz);
  const Eigen::VectorXd as_is = Eigen::VectorXd::Ones(bins);
  filter.bandwidth_before_hz = bandwidth_hz(as_is, signal, noise, bin_hz);
  filter.bandwidth_after_hz = bandwidth_hz(real, signal, noise, bin_hz);
  filter.half = half * std::sqrt(signal.sum() / real.dot(signal));
}

WhiteningFilter design_one(std::span<const TimeSeries* const> trials, const std::string& channel, double highpass_hz) {
  WhiteningFilter filter;
  filter.channel = channel;
  filter.rate_hz = trials.front()->mean_rate_hz();
  filter.reason = unfit(trials);
  if (!filter.reason.empty()) return filter;
  filter.reason = "it hardly stands out from its rest";
  const Segments segments = segments_of(trials, channel);
  if (!std::isfinite(segments.quiet_power)) return filter;
  const double bin_hz = segments.frequency_hz[1];
  const Band band{static_cast<Eigen::Index>(std::ceil(1.25 * highpass_hz / bin_hz)),
                  static_cast<Eigen::Index>(std::floor(0.45 * filter.rate_hz / bin_hz))};
  if (band.low >= band.high) return filter;
  std::optional<Spectra> spectra = from_rest(segments, bin_hz);
  if (!spectra) spectra = without_rest(segments, band, bin_hz);
  if (!spectra) return filter;
  const auto in_band = spectra->signal.segment(band.low, band.high - band.low + 1);
  if (!(in_band.maxCoeff() > 0.0)) return filter;
  filter.reason.clear();
  set_filter(*spectra, band, bin_hz, filter);
  return filter;
}

/// Returns the filters of the channels whose names mean EMG; all if there are none.
std::vector<const WhiteningFilter*> voters(const std::vector<WhiteningFilter>& filters) {
  std::vector<const WhiteningFilter*> emg, all;
  for (const WhiteningFilter& filter : filters) {
    all.push_back(&filter);
    if (!recording::named_as_input(filter.channel)) emg.push_back(&filter);
  }
  return emg.empty() ? all : emg;
}

}  // namespace

std::vector<WhiteningFilter> design_whitening(std::span<const TimeSeries* const> trials, double highpass_hz) {
  std::vector<WhiteningFilter> filters;
  if (trials.empty()) return filters;
  for (const Channel& channel : trials.front()->channels())
    filters.push_back(design_one(trials, channel.name, highpass_hz));
  return filters;
}

Whitening decide_whitening(std::span<const TimeSeries* const> trials, double highpass_hz, std::optional<bool> wanted) {
  if (!wanted.value_or(true)) return {.applied = false, .reason = "not asked for", .filters = {}};
  Whitening result{.applied = false, .reason = "there is no EMG", .filters = design_whitening(trials, highpass_hz)};
  if (result.filters.empty()) return result;
  double log_gain = 0.0;
  const std::vector<const WhiteningFilter*> emg = voters(result.filters);
  for (const WhiteningFilter* filter : emg) {
    if (!filter->reason.empty()) {
      result.reason = fmt::format("channel '{}': {}", filter->channel, filter->reason);
      if (!wanted) return result;
      throw InvalidInput(
          "whitening is asked for and cannot be done: channel '{}': {}; leave the channel out, or let the "
          "recording decide",
          filter->channel, filter->reason);
    }
    log_gain += std::log(filter->bandwidth_after_hz / filter->bandwidth_before_hz) / static_cast<double>(emg.size());
  }
  const double gain = std::exp(log_gain);
  result.applied = wanted.value_or(gain > kWorthIt);
  result.reason = wanted ? "asked for"
                         : fmt::format("the statistical bandwidth of {} would grow {:.2f}-fold{}",
                                       emg.size() == 1 ? "the channel" : "the channels", gain,
                                       result.applied ? "" : ", which is not worth it");
  return result;
}

TimeSeries whiten(const TimeSeries& emg, const Whitening& whitening) {
  if (!whitening.applied) return emg;
  Eigen::MatrixXd values = emg.values();
  const Eigen::Index n = values.rows();
  for (const WhiteningFilter& filter : whitening.filters) {
    const auto column = emg.find(filter.channel);
    const Eigen::Index reach = filter.half.size() - 1;
    const Eigen::Index known = n - 2 * reach;
    if (!column || reach < 0 || known < reach) continue;
    const auto x = emg.values().col(*column);
    auto white = values.col(*column);
    auto inside = white.segment(reach, known);
    inside = filter.half[0] * x.segment(reach, known);
    for (Eigen::Index m = 1; m <= reach; ++m)
      inside += filter.half[m] * (x.segment(reach - m, known) + x.segment(reach + m, known));
  }
  return {emg.time_s(), emg.channels(), std::move(values)};
}

}  // namespace myoid::recording
