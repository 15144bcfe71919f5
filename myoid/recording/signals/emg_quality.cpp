#include "myoid/recording/signals/emg_quality.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/ground/math/zero_phase.h"
#include "myoid/recording/signals/ecg.h"
#include "myoid/recording/signals/emg_kind.h"
#include "myoid/recording/signals/emg_spikes.h"
#include "myoid/recording/signals/mains_hum.h"

namespace myoid::recording {
namespace {

using math::FilterBand;

constexpr double kEmgFrom_hz = 20.0;
constexpr double kEmgWindow_s = 0.25;

double rms(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return x.size() > 0 ? std::sqrt(x.squaredNorm() / static_cast<double>(x.size())) : 0.0;
}

Eigen::VectorXd filtered(const Eigen::VectorXd& x, FilterBand band, double cutoff_hz, double rate) {
  return math::zero_phase(math::design_butterworth(band, 2, cutoff_hz, rate), x, math::Ends::even);
}

/// Samples i .. i + length - 1, which have the same value.
struct Run {
  Eigen::Index begin = 0;
  Eigen::Index length = 0;
};

/// Returns the longest run of equal samples, of this value if one is given.
Run longest_run(const Eigen::VectorXd& x, std::optional<double> value = std::nullopt) {
  Run best;
  for (Eigen::Index i = 0; i < x.size();) {
    Eigen::Index end = i + 1;
    while (end < x.size() && x[end] == x[i]) ++end;
    if ((!value || x[i] == *value) && end - i > best.length) best = {i, end - i};
    i = end;
  }
  return best;
}

/// Runs all checks of one channel and keeps the filtered signal for the pairs.
class ChannelCheck {
 public:
  ChannelCheck(const TimeSeries& raw, Eigen::Index c, const EmgTreatment& treatment)
      : time_s_(raw.time_s()),
        x_(raw.values().col(c)),
        name_(raw.channels()[static_cast<std::size_t>(c)].name),
        rate_hz_(raw.mean_rate_hz()),
        treatment_(treatment) {}

  /// Returns the signal for the pair checks; empty if the channel has none.
  Eigen::VectorXd run(std::vector<Remark>& faults) {
    const std::vector<EmgSpike> spikes = find_spikes(x_, rate_hz_);
    if (!spikes.empty()) faults.push_back(spike_remark(name_, time_s_, spikes));
    x_ = without_spikes(x_, spikes);
    amplitude(faults);
    const bool smoothed = is_envelope(x_, rate_hz_);
    const bool rectified = !smoothed && is_rectified(x_);
    x_.array() -= x_.mean();
    if (rms(x_) < kLimits.emg.flat_v) {
      add(faults, RemarkCode::emg_flat, true, 0, x_.size() - 1, rms(x_),
          fmt::format("channel '{}' shows nothing: {:.2g} uV rms", name_, 1e6 * rms(x_)),
          remedy("was the electrode connected? Leave its muscle out, or give it emg = { same_as = ... }",
                 "was the electrode connected? Leave it out: name the others with --channel",
                 "was an electrode connected?"));
      return {};
    }
    const bool railed = !smoothed && clipping(faults);
    const Run flat = longest_run(x_);
    if (!railed && seconds(flat.length) >= kLimits.emg.flat_s) {
      add(faults, RemarkCode::emg_flat, true, flat.begin, flat.begin + flat.length - 1, seconds(flat.length),
          fmt::format("channel '{}' does not change at all from {:.6g} to {:.6g} s", name_, time_s_[flat.begin],
                      time_s_[flat.begin + flat.length - 1]),
          remedy("was the transmission lost? Cut that part off with start_s and end_s",
                 "was the transmission lost? Cut that part off with --start and --end", "was the transmission lost?"));
    }
    if (!smoothed && !rectified) heart(faults);
    if (smoothed || rectified) {
      envelope(smoothed, faults);
      return {};
    }
    if (rate_hz_ < 4.0 * kEmgFrom_hz || x_.size() < static_cast<Eigen::Index>(rate_hz_)) return {};
    emg_ = filtered(x_, FilterBand::high_pass, kEmgFrom_hz, rate_hz_);
    hum(faults);
    if (is_noise(emg_, rate_hz_, kEmgFrom_hz)) return {};
    drift(faults);
    artifact(faults);
    return std::move(emg_);
  }

 private:
  /// Names the heart in a channel, as in the trunk's.
  void heart(std::vector<Remark>& faults) const {
    const std::optional<EcgBeats> beats = find_ecg(x_, rate_hz_);
    if (!beats) return;
    faults.push_back({.code = RemarkCode::emg_artifact,
                      .severity = Severity::note,
                      .about = name_,
                      .when = Stretch{time_s_[beats->at.front()], time_s_[beats->at.back()]},
                      .value = beats->alike,
                      .says = fmt::format("channel '{}' holds the heart: {} alike waves of {:.2g} uV, {:.0f} a minute",
                                          name_, beats->at.size(), 1e6 * beats->amplitude, 60.0 * beats->rate_hz),
                      .remedy = remedy("[emg] remove_ecg = true takes it out", "--remove-ecg takes it out", "")});
  }

  [[nodiscard]] double seconds(Eigen::Index samples) const { return static_cast<double>(samples) / rate_hz_; }

  void add(std::vector<Remark>& faults,
           RemarkCode code,
           bool grave,
           Eigen::Index begin,
           Eigen::Index last,
           double value,
           std::string text,
           std::string remedy) const {
    faults.push_back({.code = code,
                      .severity = grave ? Severity::warning : Severity::note,
                      .about = name_,
                      .when = Stretch{time_s_[begin], time_s_[last]},
                      .value = value,
                      .says = std::move(text),
                      .remedy = std::move(remedy)});
  }

  /// Returns the remedy in the words that this reader has.
  [[nodiscard]] std::string remedy(std::string in_study, std::string of_emg, std::string alone) const {
    if (treatment_.remedies == EmgRemedies::keys_of_study) return in_study;
    return treatment_.remedies == EmgRemedies::options_of_emg ? of_emg : alone;
  }

  void envelope(bool smoothed, std::vector<Remark>& faults) const {
    const std::string says =
        smoothed
            ? fmt::format(
                  "channel '{}' is never negative and hardly goes up and down: it has been rectified and smoothed",
                  name_)
            : fmt::format("channel '{}' goes up and down as raw EMG does and is never negative: it has been rectified",
                          name_);
    const char* const no_activation = "an envelope that is high-passed and rectified once more is no activation: ";
    const char* const another = "the high-pass makes another signal of it: give the raw EMG";
    const std::string kind =
        smoothed ? "set [emg] kind = \"envelope\"" : ", or low-pass it and set [emg] kind = \"envelope\"";
    const std::string advice = remedy((smoothed ? no_activation : another) + kind,
                                      smoothed ? std::string(no_activation) + "give the raw EMG" : std::string(another),
                                      "the checks of raw EMG do not apply to it");
    add(faults, RemarkCode::emg_envelope, treatment_.remedies != EmgRemedies::none, 0, x_.size() - 1, 0.0, says,
        advice);
  }

  void amplitude(std::vector<Remark>& faults) const {
    Eigen::Index at = 0;
    const double most = x_.cwiseAbs().maxCoeff(&at);
    if (most <= kLimits.emg.amplitude_v || is_beyond_amplifiers(x_)) return;  // `no_volts` tells another unit
    const auto beyond = (x_.array().abs() > kLimits.emg.amplitude_v).count();
    add(faults, RemarkCode::emg_amplitude, true, at, at, most,
        fmt::format("channel '{}' reaches {:.3g} V at {:.6g} s ({} of {} samples lie beyond {:g} V); skin gives "
                    "millivolts, and no amplifier more than {:g} V",
                    name_, most, time_s_[at], beyond, x_.size(), kLimits.emg.amplitude_v, kLimits.emg.amplitude_v),
        "leave out samples that are no measurement: they become the greatest effort");
  }

  bool clipping(std::vector<Remark>& faults) const {
    const double range = x_.maxCoeff() - x_.minCoeff();
    bool railed = false;
    for (const bool top : {true, false}) {
      const double extreme = top ? x_.maxCoeff() : x_.minCoeff();
      const Run longest = longest_run(x_, extreme);
      const auto on = (x_.array() == extreme).count();
      const auto near = ((x_.array() - extreme).abs() <= 0.05 * range).count() - on;
      const double share = static_cast<double>(on) / static_cast<double>(x_.size());
      if (longest.length < 3 || on < near || share < kLimits.emg.clipped_share) continue;
      railed = true;
      const char* side = top ? "largest" : "smallest";
      if (seconds(longest.length) >= kLimits.emg.saturated_s) {
        add(faults, RemarkCode::emg_saturated, true, longest.begin, longest.begin + longest.length - 1,
            seconds(longest.length),
            fmt::format("channel '{}' stays at its {} value for {:.3g} s at {:.6g} s", name_, side,
                        seconds(longest.length), time_s_[longest.begin]),
            "the amplifier was saturated: cut that part off, and check the electrode");
      } else {
        Eigen::Index first = 0;
        while (x_[first] != extreme) ++first;
        Eigen::Index last = x_.size() - 1;
        while (x_[last] != extreme) --last;
        add(faults, RemarkCode::emg_clipped, true, first, last, share,
            fmt::format("channel '{}' is cut off at its {} value in {:.2g} % of the samples, first at {:.6g} s", name_,
                        side, 100.0 * share, time_s_[first]),
            "record with a lower gain; its strongest efforts are too small here");
      }
    }
    return railed;
  }

  void hum(std::vector<Remark>& faults) {
    const auto found = find_hum(emg_, rate_hz_);
    if (!found || found->share < kLimits.emg.hum_share) return;
    add(faults, RemarkCode::emg_hum, !treatment_.notched, 0, x_.size() - 1, found->share,
        fmt::format("channel '{}': {:.0f} % of its power is hum, in lines at {:.0f} Hz", name_, 100.0 * found->share,
                    fmt::join(found->lines_hz, ", ")),
        treatment_.notched ? "notches take it out; check the reference electrode"
                           : "no notch takes it out, so it becomes activation; check the reference electrode");
    emg_ = without_hum(emg_, rate_hz_, *found);
  }

  void drift(std::vector<Remark>& faults) const {
    const auto width = static_cast<Eigen::Index>(rate_hz_);
    const Eigen::Index count = x_.size() / width;
    if (count < 3) return;
    Eigen::VectorXd means(count);
    for (Eigen::Index i = 0; i < count; ++i) means[i] = x_.segment(i * width, width).mean();
    means.array() -= means.mean();
    const double value = rms(means) / rms(emg_);
    if (value < kLimits.emg.drift_over_rms) return;
    add(faults, RemarkCode::emg_drift, !treatment_.high_passed, 0, x_.size() - 1, value,
        fmt::format("channel '{}': its baseline wanders by {:.3g} uV, {:.2g} times the EMG", name_, 1e6 * rms(means),
                    value),
        treatment_.high_passed
            ? "the high-pass takes it out; check the skin's preparation"
            : fmt::format("without a high-pass it becomes activation: {}",
                          remedy("set [emg] highpass_hz", "leave out --as-published", "high-pass it")));
  }

  void artifact(std::vector<Remark>& faults) const {
    const Eigen::VectorXd slow =
        filtered(filtered(x_, FilterBand::high_pass, 1.0, rate_hz_), FilterBand::low_pass, 15.0, rate_hz_);
    const auto width = static_cast<Eigen::Index>(kEmgWindow_s * rate_hz_);
    double loudest = 0.0;
    for (Eigen::Index i = 0; i + width <= x_.size(); i += width)
      loudest = std::max(loudest, rms(emg_.segment(i, width)));
    int count = 0;
    Eigen::Index worst = 0;
    double value = 0.0;
    for (Eigen::Index i = 0; i + width <= x_.size(); i += width) {
      const double here = rms(slow.segment(i, width)) / loudest;
      count += here >= kLimits.emg.artifact_over_rms ? 1 : 0;
      if (here > value) {
        value = here;
        worst = i;
      }
    }
    if (count == 0) return;
    add(faults, RemarkCode::emg_artifact, true, worst, worst + width - 1, value,
        fmt::format("channel '{}' has a movement artifact, {:.2g} times its largest EMG, at {:.6g} s{}", name_, value,
                    time_s_[worst], count > 1 ? fmt::format(" ({} quarter seconds in all)", count) : ""),
        "fasten the cable; what of it lies above the high-pass becomes activation there");
  }

  const Eigen::VectorXd& time_s_;
  Eigen::VectorXd x_;
  Eigen::VectorXd emg_;
  std::string name_;
  double rate_hz_;
  EmgTreatment treatment_;
};

/// Tells channels in another unit than volts, all in one.
std::optional<Remark> no_volts(const TimeSeries& raw) {
  std::vector<std::string> names;
  double most_v = 0.0;
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c) {
    const auto x = raw.values().col(c);
    if (!is_beyond_amplifiers(x)) continue;
    names.push_back(raw.channels()[static_cast<std::size_t>(c)].name);
    most_v = std::max(most_v, x.cwiseAbs().maxCoeff());
  }
  if (names.empty()) return std::nullopt;
  return Remark{.code = RemarkCode::emg_amplitude,
                .about = fmt::format("{}", fmt::join(names, ", ")),
                .when = Stretch{raw.time_s()[0], raw.time_s()[raw.sample_count() - 1]},
                .value = most_v,
                .says = fmt::format("{} reach{} {:.3g} V, and no amplifier gives more than {:g} V: the numbers are in "
                                    "another unit, or no EMG",
                                    some_of(names), names.size() == 1 ? "es" : "", most_v, kLimits.emg.amplitude_v),
                .remedy = "correct the unit in the file, or give the EMG's (--unit uV, in a study [emg] unit)"};
}

/// Returns the largest correlation within 10 ms to either side, over at most 20 one-second blocks.
double common_share(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double rate_hz) {
  constexpr Eigen::Index kMostBlocks = 20;
  const auto lags = static_cast<Eigen::Index>(0.01 * rate_hz);
  const auto width = static_cast<Eigen::Index>(rate_hz);
  const Eigen::Index room = a.size() - 2 * lags - width;
  if (room < 0) return 0.0;
  const Eigen::Index blocks = std::clamp<Eigen::Index>(room / width + 1, 1, kMostBlocks);
  double best = 0.0;
  for (Eigen::Index lag = -lags; lag <= lags; ++lag) {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (Eigen::Index k = 0; k < blocks; ++k) {
      const Eigen::Index begin = lags + (blocks > 1 ? k * room / (blocks - 1) : 0);
      const auto x = a.segment(begin, width);
      const auto y = b.segment(begin + lag, width);
      ab += x.dot(y);
      aa += x.squaredNorm();
      bb += y.squaredNorm();
    }
    if (aa > 0.0 && bb > 0.0) best = std::max(best, std::abs(ab) / std::sqrt(aa * bb));
  }
  return best;
}

}  // namespace

std::vector<Remark> check_emg(const TimeSeries& raw, const EmgTreatment& treatment) {
  require_unit(raw, Unit::volt, "EMG");
  require_finite(raw, "EMG");
  std::vector<Remark> faults;
  if (raw.sample_count() < 10) return faults;
  if (auto wrong = no_volts(raw)) faults.push_back(std::move(*wrong));
  std::vector<Eigen::VectorXd> signals;
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c) signals.push_back(ChannelCheck(raw, c, treatment).run(faults));
  for (std::size_t a = 0; a < signals.size(); ++a) {
    for (std::size_t b = a + 1; b < signals.size(); ++b) {
      if (signals[a].size() == 0 || signals[b].size() == 0) continue;
      const double value = common_share(signals[a], signals[b], raw.mean_rate_hz());
      if (value < kLimits.emg.crosstalk) continue;
      const std::string& first = raw.channels()[a].name;
      const std::string& second = raw.channels()[b].name;
      constexpr double kSame = 0.98;
      faults.push_back(
          {.code = RemarkCode::emg_crosstalk,
           .severity = Severity::warning,
           .about = fmt::format("{}, {}", first, second),
           .when = Stretch{raw.time_s()[0], raw.time_s()[raw.sample_count() - 1]},
           .value = value,
           .says =
               value > kSame
                   ? fmt::format("channels '{}' and '{}' are the same signal (correlation {:.3f})", first, second,
                                 value)
                   : fmt::format("channels '{}' and '{}' have {:.0f} % of their power in common (correlation {:.2f})",
                                 first, second, 100.0 * value * value, value),
           .remedy = value > kSame
                         ? "was one of them plugged in twice?"
                         : "crosstalk or a common disturbance: the muscles cannot be told apart to that extent"});
    }
  }
  return faults;
}

}  // namespace myoid::recording
