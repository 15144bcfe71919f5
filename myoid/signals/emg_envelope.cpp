#include "myoid/signals/emg_envelope.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/statistics.h"
#include "myoid/signals/filter.h"
#include "myoid/signals/mains_hum.h"
#include "myoid/signals/quality_limits.h"
#include "myoid/signals/spectrum.h"

namespace myoid::signals {
namespace {

constexpr double kSpectrumSegment_s = 0.25;
constexpr double kUsualBandwidth_hz = 150.0;  ///< Of surface EMG where the raw signal is not known.
constexpr double kRest_s = 1.0;
constexpr double kRectifiedSpread = 0.7555;  ///< sqrt(pi/2 - 1): of rectified Gaussian noise.

/// Means over a window that slides sample by sample: entry i covers samples i .. i + width - 1.
Eigen::VectorXd moving_mean(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index width) {
  Eigen::VectorXd sum(x.size() + 1);
  sum[0] = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  const Eigen::Index count = x.size() - width + 1;
  return (sum.segment(width, count) - sum.head(count)) / static_cast<double>(width);
}

Eigen::Index window_samples(const TimeSeries& series, double window_s) {
  const auto wanted = static_cast<Eigen::Index>(std::lround(window_s * series.mean_rate_hz()));
  return std::clamp<Eigen::Index>(wanted, 1, series.sample_count());
}

/// Mean of the windows that rest: those at most two spreads of a mean above it, found from the
/// lowest one upward. Of equally quiet windows the lowest lies far below their mean, the farther
/// the more there are; windows in which something happens come in as far as chance could make them.
double resting_level(std::vector<double> means, double relative_sd) {
  std::sort(means.begin(), means.end());
  double level = means.front();
  double sum = 0.0;
  std::size_t count = 0;
  while (count < means.size() && means[count] <= level * (1.0 + 2.0 * relative_sd)) {
    do {
      sum += means[count++];
    } while (count < means.size() && means[count] <= level * (1.0 + 2.0 * relative_sd));
    level = sum / static_cast<double>(count);
  }
  return level;
}

/// Hum is said; with `notch` it is gone afterwards.
void take_out_hum(bool notch, EmgStages& stages) {
  const double rate_hz = stages.filtered.mean_rate_hz();
  Eigen::MatrixXd values = stages.filtered.values();
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const auto hum = find_hum(values.col(c), rate_hz);
    if (!hum || hum->share < QualityLimits{}.hum_share) continue;
    std::string lines;
    for (const double line_hz : hum->lines_hz)
      lines += fmt::format("{}{:.0f}", lines.empty() ? "" : ", ", line_hz);
    stages.findings.push_back(fmt::format(
        "channel '{}': {:.0f} % of its power is hum, in lines at {} Hz; {}",
        stages.filtered.channels()[static_cast<std::size_t>(c)].name, 100.0 * hum->share, lines,
        notch ? "taken out by notches" : "check the reference electrode"));
    if (notch) values.col(c) = without_hum(values.col(c), rate_hz, *hum);
  }
  stages.filtered =
      TimeSeries(stages.filtered.time_s(), stages.filtered.channels(), std::move(values));
}

}  // namespace

EmgStages clean_emg(const TimeSeries& raw, const EnvelopeOptions& options) {
  require_unit(raw, Unit::volt, "EMG");
  require_finite(raw, "EMG");
  EmgStages stages;
  const Eigen::MatrixXd centered = raw.values().rowwise() - raw.values().colwise().mean();
  stages.raw = TimeSeries(raw.time_s(), raw.channels(), centered);
  const double rate = raw.mean_rate_hz();
  if (rate < 500.0) {
    stages.findings.push_back(
        fmt::format("EMG sampled at {:.0f} Hz: below 1000 Hz part of its power is folded back and "
                    "cannot be mended",
                    rate));
  }
  stages.filtered = options.as_published
                        ? stages.raw
                        : zero_phase_filter(stages.raw, math::FilterBand::high_pass,
                                            options.highpass_hz, {.order = 2, .corrected = true});
  take_out_hum(options.notch && !options.as_published, stages);
  return stages;
}

std::vector<WhiteningFilter> find_whitening(std::span<const EmgStages* const> trials,
                                            const EnvelopeOptions& options) {
  if (!options.whitening || options.as_published || !options.rectify) return {};
  std::vector<const TimeSeries*> filtered;
  for (const EmgStages* trial : trials) filtered.push_back(&trial->filtered);
  return design_whitening(filtered, options.highpass_hz);
}

void add_envelope(EmgStages& stages,
                  const EnvelopeOptions& options,
                  std::span<const WhiteningFilter> whitening) {
  const TimeSeries& raw = stages.raw;
  const double rate = raw.mean_rate_hz();
  const TimeSeries white = whiten(stages.filtered, whitening);
  stages.bandwidth_hz.setZero(raw.channel_count());
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c) {
    const double bandwidth_hz =
        statistical_bandwidth_hz(power_spectrum(white.values().col(c), rate, kSpectrumSegment_s));
    if (std::isfinite(bandwidth_hz)) stages.bandwidth_hz[c] = bandwidth_hz;
  }
  stages.rectified =
      TimeSeries(raw.time_s(), raw.channels(),
                 options.rectify ? Eigen::MatrixXd(white.values().cwiseAbs()) : white.values());
  const TimeSeries smooth =
      zero_phase_filter(stages.rectified, math::FilterBand::low_pass, options.lowpass_hz,
                        {.order = 2, .corrected = !options.as_published});
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c) {
    const double share = (smooth.values().col(c).array() < 0.0).cast<double>().mean();
    if (share > 0.01) {
      stages.findings.push_back(
          fmt::format("channel '{}': the filter undershoots in {:.1f} % of the samples; the "
                      "envelope is 0 there",
                      raw.channels()[static_cast<std::size_t>(c)].name, 100.0 * share));
    }
  }
  stages.envelope = TimeSeries(raw.time_s(), raw.channels(), smooth.values().cwiseMax(0.0));
}

std::vector<EmgStages> process_emg(std::span<const TimeSeries* const> raw,
                                   const EnvelopeOptions& options) {
  std::vector<EmgStages> trials;
  for (const TimeSeries* trial : raw) trials.push_back(clean_emg(*trial, options));
  std::vector<const EmgStages*> views;
  for (const EmgStages& trial : trials) views.push_back(&trial);
  const std::vector<WhiteningFilter> whitening = find_whitening(views, options);
  for (EmgStages& trial : trials) add_envelope(trial, options, whitening);
  return trials;
}

EmgStages process_emg(const TimeSeries& raw, const EnvelopeOptions& options) {
  const TimeSeries* one = &raw;
  return std::move(process_emg(std::span(&one, 1), options).front());
}

std::vector<ChannelNormalisation> find_normalisation(std::span<const TrialEnvelope> trials,
                                                     const NormalisationOptions& options) {
  if (trials.empty()) throw InvalidInput("EMG normalisation: there are no trials");
  std::vector<ChannelNormalisation> result;
  for (const Channel& channel : trials.front().envelope->channels()) {
    ChannelNormalisation n;
    n.channel = channel.name;
    std::vector<double> seconds;
    double largest = -1.0;
    double longest_s = 0.0;
    for (const TrialEnvelope& trial : trials) {
      const Eigen::VectorXd x = trial.envelope->column(channel.name);
      const Eigen::VectorXd second = moving_mean(x, window_samples(*trial.envelope, kRest_s));
      seconds.insert(seconds.end(), second.begin(), second.end());
      const Eigen::VectorXd& clock = trial.envelope->time_s();
      const double length_s =
          clock[clock.size() - 1] - clock[0] + trial.envelope->mean_interval_s();
      longest_s = std::max(longest_s, length_s);
      if (options.window_s > (1.0 + 1e-9) * length_s) continue;
      const Eigen::Index width = window_samples(*trial.envelope, options.window_s);
      const Eigen::VectorXd means = moving_mean(x, width);
      Eigen::Index at = 0;
      const double top = means.maxCoeff(&at);
      if (top > largest) {
        largest = top;
        n.source_trial = trial.trial;
        n.source_time_s = trial.envelope->time_s()[at + width / 2];
        n.from_mvc = trial.is_mvc;
        n.bandwidth_hz = 0.0;
        for (Eigen::Index c = 0; c < trial.bandwidth_hz.size(); ++c) {
          if (trial.envelope->channels()[static_cast<std::size_t>(c)].name == channel.name)
            n.bandwidth_hz = trial.bandwidth_hz[c];
        }
      }
    }
    if (largest < 0.0) {
      throw InvalidInput(
          fmt::format("EMG normalisation: the window of {} s is longer than every recording (the "
                      "longest has {:.4g} s); give a shorter one",
                      options.window_s, longest_s));
    }
    // Rectified Gaussian noise of bandwidth B averaged over the window: CV = 0.7555 / sqrt(2 B T).
    const double bandwidth_hz = n.bandwidth_hz > 0.0 ? n.bandwidth_hz : kUsualBandwidth_hz;
    const auto spread_over = [&](double window_s) {
      return kRectifiedSpread / std::sqrt(2.0 * bandwidth_hz * window_s);
    };
    n.relative_sd = spread_over(options.window_s);
    n.resting_level_v = resting_level(std::move(seconds), spread_over(kRest_s));
    // Windows whose mean may well be the same: by how long they last in all.
    double windows = 0.0;
    for (const TrialEnvelope& trial : trials) {
      const Eigen::VectorXd& clock = trial.envelope->time_s();
      if (options.window_s >
          clock[clock.size() - 1] - clock[0] + 2.0 * trial.envelope->mean_interval_s())
        continue;
      const Eigen::Index width = window_samples(*trial.envelope, options.window_s);
      const Eigen::VectorXd means = moving_mean(trial.envelope->column(channel.name), width);
      bool near = false;
      for (Eigen::Index i = 0; i < means.size(); ++i) {
        const bool here = means[i] > largest * (1.0 - 2.0 * n.relative_sd);
        if (here && !near) windows += 1.0;
        if (here) windows += 1.0 / static_cast<double>(width);
        near = here;
      }
    }
    // Expected maximum of m normal numbers (Blom 1958); a channel that is 0 throughout has none.
    if (windows >= 1.0) {
      n.relative_bias = n.relative_sd * math::normal_quantile((windows - 0.375) / (windows + 0.25));
      n.relative_bias = std::max(0.0, n.relative_bias);
    }
    n.reference_v =
        std::sqrt(std::max(0.0, largest * largest - n.resting_level_v * n.resting_level_v));
    if (!(n.reference_v > 0.0) || n.reference_v < 1e-3 * largest) {
      throw InvalidInput(fmt::format(
          "EMG channel '{}' never rises above its resting level: was the electrode connected?",
          channel.name));
    }
    result.push_back(std::move(n));
  }
  return result;
}

TimeSeries normalise(const TimeSeries& envelope,
                     const std::vector<ChannelNormalisation>& normalisation) {
  std::vector<Channel> channels;
  Eigen::MatrixXd values(envelope.sample_count(), static_cast<Eigen::Index>(normalisation.size()));
  for (std::size_t c = 0; c < normalisation.size(); ++c) {
    const ChannelNormalisation& n = normalisation[c];
    channels.push_back({n.channel, Unit::dimensionless});
    const double rest = n.resting_level_v * n.resting_level_v;
    const Eigen::ArrayXd above = envelope.column(n.channel).array().square() - rest;
    values.col(static_cast<Eigen::Index>(c)) = (above.max(0.0).sqrt() / n.reference_v).matrix();
  }
  return {envelope.time_s(), std::move(channels), std::move(values)};
}

}  // namespace myoid::signals
