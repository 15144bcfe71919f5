#include "myoid/recording/signals/emg_envelope.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/normal.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/ecg.h"
#include "myoid/recording/signals/emg_kind.h"
#include "myoid/recording/signals/emg_reference.h"
#include "myoid/recording/signals/emg_spikes.h"
#include "myoid/recording/signals/filter.h"
#include "myoid/recording/signals/mains_hum.h"
#include "myoid/recording/signals/quality_limits.h"
#include "myoid/recording/signals/spectrum.h"

namespace myoid::recording {
namespace {

constexpr double kUsualBandwidth_hz = 150.0;  ///< Of surface EMG whose raw signal is not available.
constexpr double kRest_s = 1.0;
/// Spreads of a mean over a pause by which a pause is quieter than the quietest second, so that the
/// muscle was not at rest in that second.
constexpr double kQuieter = 3.0;
/// Least ratio of the greatest level to the quietest second for that second to be rest. Sustained
/// efforts vary by less, and EMG that rises no higher above noise is useless.
constexpr double kRises = 1.5;

/// Mean and number of the windows at one extreme.
struct Extreme {
  double level = 0.0;
  std::size_t count = 0;
};

/// Returns the lowest windows (`side` +1) or the greatest (-1): those at most `margin` of their
/// mean away from it, counted from the extreme one on. Among equally strong windows the extreme one
/// lies the farther from their mean, the more windows there are.
Extreme extreme_level(std::vector<double> means, double margin, double side) {
  const auto is_farther = [side](double a, double b) { return side * a > side * b; };
  Extreme e{.level = *std::max_element(means.begin(), means.end(), is_farther), .count = 0};
  // A heap gives the few windows at the extreme in order without a sort of all. Most windows lie far from it.
  const auto near = [&, within = e.level * std::pow(1.0 + side * margin, 2.0)](double mean) {
    return side * mean <= side * within;
  };
  const auto middle = std::partition(means.begin(), means.end(), near);
  std::vector<double> others(middle, means.end());
  means.erase(middle, means.end());
  std::make_heap(means.begin(), means.end(), is_farther);
  double sum = 0.0;
  const auto alike = [&] {
    if (means.empty()) {
      means.swap(others);
      std::make_heap(means.begin(), means.end(), is_farther);
    }
    return !means.empty() && side * means.front() <= side * e.level * (1.0 + side * margin);
  };
  const auto take = [&] {
    sum += means.front();
    ++e.count;
    std::pop_heap(means.begin(), means.end(), is_farther);
    means.pop_back();
  };
  while (alike()) {
    do take();
    while (alike());
    e.level = sum / static_cast<double>(e.count);
  }
  return e;
}

/// Returns the bandwidth of a channel's raw EMG; 0 if unknown.
double bandwidth_of(const TrialEnvelope& trial, const std::string& channel) {
  const auto c = trial.envelope->find(channel);
  return c && *c < trial.bandwidth_hz.size() ? trial.bandwidth_hz[*c] : 0.0;
}

/// Moving means of one channel over all trials.
struct Means {
  std::vector<double> of_a_second;  ///< Means over a second, for the resting level.
  std::vector<double> of_a_pause;   ///< Means over a pause, for that of a cyclic movement.
  std::vector<double> of_a_window;  ///< Means over the window, for the greatest level.
  double samples_per_window = 0.0;
};

/// Computes the means and sets in `n` the place of the greatest. Windows that touch one of the peaks are no window of
/// the reference. Throws InvalidInput if no trial is as long as the window.
Means moving_means(std::span<const TrialEnvelope> trials,
                   double window_s,
                   const std::vector<LonePeak>& peaks,
                   ChannelNormalisation& n) {
  Means result;
  double largest = -1.0, longest_s = 0.0;
  for (std::size_t number = 0; number < trials.size(); ++number) {
    const TrialEnvelope& trial = trials[number];
    const Eigen::VectorXd x = trial.envelope->column(n.channel);
    const Eigen::VectorXd second = math::moving_mean(x, window_samples(*trial.envelope, kRest_s));
    result.of_a_second.insert(result.of_a_second.end(), second.begin(), second.end());
    const Eigen::VectorXd pause = math::moving_mean(x, window_samples(*trial.envelope, kPause_s));
    result.of_a_pause.insert(result.of_a_pause.end(), pause.begin(), pause.end());
    const Eigen::VectorXd& clock = trial.envelope->time_s();
    const double length_s = clock[clock.size() - 1] - clock[0] + trial.envelope->mean_interval_s();
    longest_s = std::max(longest_s, length_s);
    if (window_s > (1.0 + 1e-9) * length_s) continue;
    const Eigen::Index width = window_samples(*trial.envelope, window_s);
    Eigen::VectorXd means = math::moving_mean(x, width);
    for (Eigen::Index i = 0; i < means.size(); ++i) {
      if (touches(peaks, number, i, width))
        means[i] = -1.0;
      else
        result.of_a_window.push_back(means[i]);
    }
    Eigen::Index at = 0;
    if (const double top = means.maxCoeff(&at); top > largest) {
      largest = top;
      n.source_trial = trial.trial;
      n.source_time_s = clock[at + width / 2];
      n.from_mvc = trial.is_mvc;
      n.bandwidth_hz = bandwidth_of(trial, n.channel);
      result.samples_per_window = static_cast<double>(width);
    }
  }
  if (largest < 0.0) {
    throw InvalidInput(
        "EMG normalisation: the window of {} s is longer than every recording (the longest has {:.4g} s); "
        "give a shorter one",
        window_s, longest_s);
  }
  return result;
}

/// True if a window of this length touches none of the peaks in some trial.
bool window_fits(std::span<const TrialEnvelope> trials, double window_s, const std::vector<LonePeak>& peaks) {
  for (std::size_t number = 0; number < trials.size(); ++number) {
    const TimeSeries& envelope = *trials[number].envelope;
    const Eigen::Index width = window_samples(envelope, window_s);
    if (static_cast<double>(width) < 0.999 * window_s * envelope.mean_rate_hz()) continue;
    for (Eigen::Index i = 0; i + width <= envelope.sample_count(); ++i) {
      if (!touches(peaks, number, i, width)) return true;
    }
  }
  return false;
}

/// True if all means agree to round-off: an electrode always has some noise.
bool is_flat(const Means& means) {
  const double least = *std::min_element(means.of_a_second.begin(), means.of_a_second.end());
  const double most = *std::max_element(means.of_a_window.begin(), means.of_a_window.end());
  return !(most > least * (1.0 + 1e-6));
}

/// Removes hum; `check_emg` reports it.
void take_out_hum(EmgStages& stages) {
  const double rate_hz = stages.filtered.mean_rate_hz();
  Eigen::MatrixXd values = stages.filtered.values();
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const auto hum = find_hum(values.col(c), rate_hz);
    if (!hum || hum->share < kLimits.emg.hum_share) continue;
    values.col(c) = without_hum(values.col(c), rate_hz, *hum);
    stages.notches.push_back({stages.filtered.channels()[at(c)].name, hum->lines_hz});
  }
  stages.filtered = TimeSeries(stages.filtered.time_s(), stages.filtered.channels(), std::move(values));
}

/// Replaces the spikes of all channels by straight lines and notes them in `stages`.
Eigen::MatrixXd take_out_spikes(const TimeSeries& raw, EmgStages& stages) {
  Eigen::MatrixXd values = raw.values();
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const std::vector<EmgSpike> spikes = find_spikes(values.col(c), raw.mean_rate_hz());
    if (spikes.empty()) continue;
    values.col(c) = without_spikes(values.col(c), spikes);
    stages.spikes.push_back({raw.channels()[static_cast<std::size_t>(c)].name, spikes.size()});
  }
  return values;
}

/// Takes the heart out of the channels that hold it.
void take_out_heart(double rate_hz, const std::vector<Channel>& channels, Eigen::MatrixXd& values, EmgStages& stages) {
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const std::optional<EcgBeats> beats = find_ecg(values.col(c), rate_hz);
    if (!beats) continue;
    values.col(c) = without_ecg(values.col(c), rate_hz, *beats);
    stages.ecg.push_back({channels[at(c)].name, beats->at.size()});
  }
}

}  // namespace

Eigen::Index window_samples(const TimeSeries& series, double window_s) {
  const auto wanted = static_cast<Eigen::Index>(std::lround(window_s * series.mean_rate_hz()));
  return std::clamp<Eigen::Index>(wanted, 1, series.sample_count());
}

EmgStages clean_emg(const TimeSeries& raw, const EnvelopeOptions& options) {
  require_unit(raw, Unit::volt, "EMG");
  require_finite(raw, "EMG");
  EmgStages stages;
  Eigen::MatrixXd values = take_out_spikes(raw, stages);
  if (options.remove_ecg && !options.as_published) take_out_heart(raw.mean_rate_hz(), raw.channels(), values, stages);
  const Eigen::RowVectorXd mean = values.colwise().mean();
  values.rowwise() -= mean;
  stages.raw = TimeSeries(raw.time_s(), raw.channels(), std::move(values));
  const double rate = raw.mean_rate_hz();
  if (rate < 500.0) {
    stages.findings.push_back(
        {.code = RemarkCode::emg_rate,
         .severity = Severity::note,
         .says = fmt::format(
             "EMG sampled at {:.0f} Hz: below 1000 Hz part of its power is folded back and cannot be mended", rate)});
  }
  stages.filtered = options.as_published
                        ? stages.raw
                        : zero_phase_filter(stages.raw, math::FilterBand::high_pass, options.highpass_hz,
                                            {.order = 2, .ends = math::Ends::even});
  if (options.notch && !options.as_published) take_out_hum(stages);
  stages.flatness.setZero(raw.channel_count());
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c)
    stages.flatness[c] = flatness_of(stages.filtered.values().col(c), rate, options.highpass_hz);
  return stages;
}

Whitening find_whitening(std::span<const EmgStages* const> trials, const EnvelopeOptions& options) {
  if (options.as_published) return {.applied = false, .reason = "as in the source paper", .filters = {}};
  if (!options.rectify) return {.applied = false, .reason = "not rectified either", .filters = {}};
  std::vector<const TimeSeries*> filtered;
  for (const EmgStages* trial : trials) filtered.push_back(&trial->filtered);
  return decide_whitening(filtered, options.highpass_hz, options.whitening);
}

void add_envelope(EmgStages& stages, const EnvelopeOptions& options, const Whitening& whitening) {
  const TimeSeries& raw = stages.raw;
  const double rate = raw.mean_rate_hz();
  const TimeSeries white = whiten(stages.filtered, whitening);
  stages.bandwidth_hz.setZero(raw.channel_count());
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c) {
    const double bandwidth_hz =
        statistical_bandwidth_hz(power_spectrum(white.values().col(c), rate, kSpectrumSegment_s));
    if (std::isfinite(bandwidth_hz)) stages.bandwidth_hz[c] = bandwidth_hz;
  }
  stages.rectified = TimeSeries(raw.time_s(), raw.channels(),
                                options.rectify ? Eigen::MatrixXd(white.values().cwiseAbs()) : white.values());
  const TimeSeries smooth =
      zero_phase_filter(stages.rectified, math::FilterBand::low_pass, options.lowpass_hz,
                        {.order = 2, .corrected = !options.as_published, .ends = math::Ends::even});
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c) {
    const double share = (smooth.values().col(c).array() < 0.0).cast<double>().mean();
    if (share > 0.01) {
      stages.findings.push_back(
          {.code = RemarkCode::emg_processing,
           .severity = Severity::note,
           .about = raw.channels()[static_cast<std::size_t>(c)].name,
           .says =
               fmt::format("channel '{}': the filter undershoots in {:.1f} % of the samples; the envelope is 0 there",
                           raw.channels()[static_cast<std::size_t>(c)].name, 100.0 * share)});
    }
  }
  stages.envelope = TimeSeries(raw.time_s(), raw.channels(), smooth.values().cwiseMax(0.0));
}

std::vector<EmgStages> process_emg(std::span<const TimeSeries* const> raw, const EnvelopeOptions& options) {
  std::vector<EmgStages> trials;
  for (const TimeSeries* trial : raw) trials.push_back(clean_emg(*trial, options));
  std::vector<const EmgStages*> views;
  for (const EmgStages& trial : trials) views.push_back(&trial);
  const Whitening whitening = find_whitening(views, options);
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
    n.unit = channel.unit;
    const std::vector<LonePeak> peaks = lone_peaks(trials, channel.name);
    const bool room = std::ranges::any_of(peaks, &LonePeak::replaced) && window_fits(trials, options.window_s, peaks);
    Means means = moving_means(trials, options.window_s, room ? peaks : std::vector<LonePeak>{}, n);
    if (is_flat(means)) {
      throw InvalidInput("EMG channel '{}' never rises above its resting level: was the electrode connected?",
                         channel.name);
    }
    // Rectified Gaussian noise of bandwidth B, averaged over a window T, has this relative spread.
    const double bandwidth_hz = n.bandwidth_hz > 0.0 ? n.bandwidth_hz : kUsualBandwidth_hz;
    const auto spread_over = [&](double window_s) {
      return kRectifiedSpread / std::sqrt(2.0 * bandwidth_hz * window_s);
    };
    const double spread = spread_over(options.window_s);
    const auto quiet_level = [&] {
      const double second = extreme_level(std::move(means.of_a_second), 2.0 * spread_over(kRest_s), 1.0).level;
      const double of_pauses = spread_over(kPause_s);
      const double pause = extreme_level(std::move(means.of_a_pause), 2.0 * of_pauses, 1.0).level;
      return pause < (1.0 - kQuieter * of_pauses) * second ? pause : second;
    };
    const auto known = std::ranges::find(options.electrodes, channel.name, &ChannelNormalisation::channel);
    const bool is_known = known != options.electrodes.end();
    const double quiet = is_known ? known->resting_level_v : quiet_level();
    const Extreme greatest = extreme_level(std::move(means.of_a_window), 1.5 * spread, -1.0);
    n.relative_sd = spread / std::sqrt(std::max(1.0, static_cast<double>(greatest.count) / means.samples_per_window));
    n.rests = (!is_known || known->rests) && greatest.level > kRises * quiet;
    n.resting_level_v = n.rests ? quiet : 0.0;
    n.reference_v = std::sqrt(greatest.level * greatest.level - n.resting_level_v * n.resting_level_v);
    result.push_back(std::move(n));
  }
  return result;
}

TimeSeries normalise(const TimeSeries& envelope, const std::vector<ChannelNormalisation>& normalisation) {
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

}  // namespace myoid::recording
