#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/recording/signals/whitening.h"

namespace myoid::recording {

struct EnvelopeOptions {
  double highpass_hz = 20.0;  ///< Removes offset and movement artefact; 4th order (2nd order,
                              ///< forwards and backwards).
  double lowpass_hz = 6.0;    ///< Low-pass of the rectified EMG; -3 dB of both passes together.
  bool rectify = true;
  bool notch = true;        ///< Removes mains hum where it holds a tenth of the power (`find_hum`);
                            ///< ignored with `as_published`.
  bool remove_ecg = false;  ///< Takes the heart out of channels that hold it (`find_ecg`); ignored with `as_published`.
  /// Empty: whitens if the recording allows (`decide_whitening`). Never whitens with `as_published`
  /// or without `rectify`.
  std::optional<bool> whitening;
  bool as_published = false;  ///< Follows the source paper: no high-pass, and the low-pass designed
                              ///< at `lowpass_hz` for one pass.
  bool operator==(const EnvelopeOptions&) const = default;
};

/// Lines of the mains that were removed from a channel.
struct Notch {
  std::string channel;
  std::vector<double> lines_hz;
};

/// Spikes that were taken out of a channel (`find_spikes`).
struct MendedSpikes {
  std::string channel;
  std::size_t count = 0;
};

/// The heart that was taken out of a channel.
struct RemovedEcg {
  std::string channel;
  std::size_t beats = 0;
};

/// One trial's EMG at each stage of processing.
struct EmgStages {
  TimeSeries raw;                ///< As read, without spikes and, if asked, the heart; mean removed [V].
  TimeSeries filtered;           ///< High-passed, hum removed [V].
  TimeSeries rectified;          ///< Whitened (if so decided) and rectified [V].
  TimeSeries envelope;           ///< Low-passed, never negative [V].
  Eigen::VectorXd bandwidth_hz;  ///< Statistical bandwidth of the signal before rectification.
  /// Statistical bandwidth of `filtered` between the high-pass and 450 Hz, over that of white noise: an electrode that
  /// is not on a muscle has 0.9 to 1, EMG 0.2 to 0.65.
  Eigen::VectorXd flatness;
  std::vector<Notch> notches;
  std::vector<MendedSpikes> spikes;
  std::vector<RemovedEcg> ecg;
  std::vector<Remark> findings;  ///< A rate too low for the EMG, an envelope clipped at 0.
};

/// Replaces spikes, removes the mean, high-passes and removes hum, every filter without delay: fills `raw`,
/// `filtered`, `flatness` and the findings. Throws InvalidInput unless `raw` is in volts and finite.
[[nodiscard]] EmgStages clean_emg(const TimeSeries& raw, const EnvelopeOptions& options = {});

/// Decides on whitening for all clean trials of one person. Throws as `decide_whitening`.
[[nodiscard]] Whitening find_whitening(std::span<const EmgStages* const> trials, const EnvelopeOptions& options = {});

/// Whitens (if so decided), rectifies and low-passes: fills the other members. The envelope is the local mean of the
/// rectified EMG: sqrt(2/pi) times the standard deviation for Gaussian EMG. Its relative spread is about 0.76 / sqrt(2
/// B T): 14 % at 6 Hz, some 9 % if whitened. Negative values from the filter's undershoot become 0.
void add_envelope(EmgStages& stages, const EnvelopeOptions& options = {}, const Whitening& whitening = {});

/// Runs all stages for trials of one person; one decision on whitening holds for all.
[[nodiscard]] std::vector<EmgStages> process_emg(std::span<const TimeSeries* const> raw,
                                                 const EnvelopeOptions& options = {});
[[nodiscard]] EmgStages process_emg(const TimeSeries& raw, const EnvelopeOptions& options = {});

/// The envelope of one trial, for the normalization.
struct TrialEnvelope {
  std::string trial;
  bool is_mvc = false;
  const TimeSeries* envelope = nullptr;
  Eigen::VectorXd bandwidth_hz;  ///< Bandwidth of each channel's raw EMG; empty if unknown.
  Eigen::VectorXd flatness;      ///< `EmgStages::flatness`; empty if unknown.
};

/// A pause between the bursts of a cyclic movement; shorter than a burst of walking.
inline constexpr double kPause_s = 0.2;

/// Returns the number of samples in a window, at least one and at most all.
[[nodiscard]] Eigen::Index window_samples(const TimeSeries& series, double window_s);

/// Resting level and reference of one EMG channel.
struct ChannelNormalisation {
  std::string channel;
  Unit unit = Unit::volt;  ///< Of the envelopes: dimensionless where their file states no unit.
  /// Noise of the electrode: the mean of the study's quiet seconds, those at most two spreads of a 1 s mean above it.
  /// The lowest of many noisy means would be 5 to 10 % below, and at rest a hundredth of the maximum would be left.
  /// Where no second is quiet, as in walking, the pauses (`kPause_s`) take their place. 0 if the muscle never rests.
  double resting_level_v = 0.0;
  bool rests = true;  ///< False if the greatest level is below 1.5 times the quietest second, as in
                      ///< an effort sustained from the first sample to the last.
  /// sqrt(m^2 - rest^2): activation 1. m is the mean of the study's moving means that lie at most
  /// 1.5 spreads of such a mean below m. The single greatest of many would be 5 to 10 % above a sustained effort.
  double reference_v = 0.0;
  double relative_sd = 0.0;    ///< Uncertainty of the reference, from the number of windows in m.
  double bandwidth_hz = 0.0;   ///< Bandwidth of the raw EMG at the maximum; 0 if unknown.
  std::string source_trial;    ///< Trial of the greatest moving mean.
  double source_time_s = 0.0;  ///< Middle of its window.
  bool from_mvc = false;       ///< That trial is a maximal contraction.
};

struct NormalisationOptions {
  double window_s = 0.5;   ///< Window of the moving mean; shorter trials do not count.
  bool held_back = false;  ///< For `add_normalisation`: trials for validation took no part.
  /// Channels whose resting level is known, as of a recording of which the trials are a part: noise is the electrode's.
  std::span<const ChannelNormalisation> electrodes;
};

/// Returns one entry for each channel of the first trial. Half seconds that no other effort confirms (`lone_peaks`) are
/// not the reference while another effort can be; `check_emg_levels` names them. All trials must have the same
/// channels. Throws InvalidInput if a channel is missing in a trial or flat, or no trial is as long as the window.
[[nodiscard]] std::vector<ChannelNormalisation> find_normalisation(std::span<const TrialEnvelope> trials,
                                                                   const NormalisationOptions& options = {});

/// Returns sqrt(envelope^2 - resting level^2) / reference, dimensionless, 0 below the resting level
/// and unlimited above. The noise of the electrode is independent of the muscle's signal: their
/// powers add, not their amplitudes. Subtracting the amplitude would make an activation of 0.1 read
/// 16 % low where the noise at rest is 1.8 % of the maximum.
[[nodiscard]] TimeSeries normalise(const TimeSeries& envelope, const std::vector<ChannelNormalisation>& normalisation);

}  // namespace myoid::recording
