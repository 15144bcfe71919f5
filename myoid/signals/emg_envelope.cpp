#include "myoid/signals/emg_envelope.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/signals/filter.h"

namespace myoid::signals {
namespace {

/// Share of the power within half a hertz of `frequency_hz`, by Goertzel sums on pieces of two
/// seconds.
double line_share(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz, double frequency_hz) {
  const auto piece = static_cast<Eigen::Index>(2.0 * rate_hz);
  if (x.size() < piece || frequency_hz > 0.45 * rate_hz) return 0.0;
  double line = 0.0;
  double total = 0.0;
  for (Eigen::Index begin = 0; begin + piece <= x.size(); begin += piece) {
    std::complex<double> sum = 0.0;
    const std::complex<double> turn = std::polar(1.0, -2.0 * kPi * frequency_hz / rate_hz);
    std::complex<double> phase = 1.0;
    for (Eigen::Index i = 0; i < piece; ++i) {
      sum += phase * x[begin + i];
      phase *= turn;
    }
    line += 2.0 * std::norm(sum) / static_cast<double>(piece);
    total += x.segment(begin, piece).squaredNorm();
  }
  return total > 0.0 ? line / total : 0.0;
}

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

}  // namespace

EmgStages process_emg(const TimeSeries& raw, const EnvelopeOptions& options) {
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
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c) {
    for (const double mains : {50.0, 60.0}) {
      const double share = line_share(stages.filtered.values().col(c), rate, mains);
      if (share > 0.10) {
        stages.findings.push_back(
            fmt::format("channel '{}': {:.0f} % of its power is mains hum at {:.0f} Hz; check the "
                        "reference electrode",
                        raw.channels()[static_cast<std::size_t>(c)].name, 100.0 * share, mains));
      }
    }
  }
  stages.rectified =
      TimeSeries(raw.time_s(), raw.channels(),
                 options.rectify ? Eigen::MatrixXd(stages.filtered.values().cwiseAbs())
                                 : stages.filtered.values());
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
  return stages;
}

std::vector<ChannelNormalisation> find_normalisation(std::span<const TrialEnvelope> trials,
                                                     const NormalisationOptions& options) {
  if (trials.empty()) throw InvalidInput("EMG normalisation: there are no trials");
  std::vector<ChannelNormalisation> result;
  for (const Channel& channel : trials.front().envelope->channels()) {
    ChannelNormalisation n;
    n.channel = channel.name;
    n.resting_level_v = std::numeric_limits<double>::infinity();
    double largest = -1.0;
    double longest_s = 0.0;
    for (const TrialEnvelope& trial : trials) {
      const Eigen::VectorXd x = trial.envelope->column(channel.name);
      n.resting_level_v = std::min(n.resting_level_v,
                                   moving_mean(x, window_samples(*trial.envelope, 1.0)).minCoeff());
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
        // Rectified Gaussian noise of bandwidth B ~ 150 Hz averaged over the window: CV = 0.7555 /
        // sqrt(2 B T).
        n.relative_sd = 0.7555 / std::sqrt(2.0 * 150.0 * options.window_s);
      }
    }
    if (largest < 0.0) {
      throw InvalidInput(
          fmt::format("EMG normalisation: the window of {} s is longer than every recording (the "
                      "longest has {:.4g} s); give a shorter one",
                      options.window_s, longest_s));
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
    values.col(static_cast<Eigen::Index>(c)) =
        ((envelope.column(n.channel).array().square() - n.resting_level_v * n.resting_level_v)
             .max(0.0)
             .sqrt() /
         n.reference_v)
            .matrix();
  }
  return {envelope.time_s(), std::move(channels), std::move(values)};
}

}  // namespace myoid::signals
