#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/signals/whitening.h"

namespace myoid::signals {

struct EnvelopeOptions {
  double highpass_hz = 20.0;  ///< Removes offset and movement artefact; 4th order (2nd, both ways).
  double lowpass_hz = 6.0;    ///< Of the rectified EMG; -3 dB of both passes together.
  bool rectify = true;
  bool notch = true;  ///< Takes mains hum out, where it is found (`find_hum`, a tenth of the
                      ///< power); not with `as_published`.
  /// Absent: where the recording allows (`decide_whitening`). Never with `as_published`, nor
  /// without `rectify`.
  std::optional<bool> whitening;
  bool as_published = false;  ///< No high-pass and the low-pass designed at `lowpass_hz` for one
                              ///< pass, as the source paper did.
};

/// Lines of the mains that were taken out of a channel.
struct Notch {
  std::string channel;
  std::vector<double> lines_hz;
};

/// One trial's EMG on its way to the envelope, for looking at.
struct EmgStages {
  TimeSeries raw;                ///< As read, mean removed [V].
  TimeSeries filtered;           ///< High-passed, hum taken out [V].
  TimeSeries rectified;          ///< Whitened, if it is, and rectified [V].
  TimeSeries envelope;           ///< Low-passed, never negative [V].
  Eigen::VectorXd bandwidth_hz;  ///< Statistical bandwidth of what is rectified.
  std::vector<Notch> notches;
  std::vector<std::string>
      findings;  ///< Mains hum, a rate too low for the EMG, an envelope clipped at 0.
};

/// Raw EMG -> mean removed -> high-pass -> (notches), every filter without delay: `raw`, `filtered`
/// and findings. Throws InvalidInput unless `raw` is in volts and finite.
[[nodiscard]] EmgStages clean_emg(const TimeSeries& raw, const EnvelopeOptions& options = {});

/// The one decision on whitening for clean trials of one person. Throws as `decide_whitening`.
[[nodiscard]] Whitening find_whitening(std::span<const EmgStages* const> trials,
                                       const EnvelopeOptions& options = {});

/// Clean EMG -> (whitened) -> rectified -> low-pass: the other members. The envelope is the local
/// mean of the rectified EMG: for Gaussian EMG sqrt(2/pi) times its standard deviation. Its
/// relative spread is about 0.76 / sqrt(2 B T), 14 % at 6 Hz, some 9 % whitened. Negative values of
/// the filter's undershoot are set to 0.
void add_envelope(EmgStages& stages,
                  const EnvelopeOptions& options = {},
                  const Whitening& whitening = {});

/// All of it for trials of one person, each whitened by what all together show.
[[nodiscard]] std::vector<EmgStages> process_emg(std::span<const TimeSeries* const> raw,
                                                 const EnvelopeOptions& options = {});
[[nodiscard]] EmgStages process_emg(const TimeSeries& raw, const EnvelopeOptions& options = {});

/// The envelope of one trial, for finding the level that counts as 1.
struct TrialEnvelope {
  std::string trial;
  bool is_mvc = false;
  const TimeSeries* envelope = nullptr;
  Eigen::VectorXd bandwidth_hz;  ///< Of its channels' raw EMG; empty: not known.
};

/// What one EMG channel is measured against.
struct ChannelNormalisation {
  std::string channel;
  /// Mean of the quiet seconds of the study (those at most two spreads of a 1 s mean above it): the
  /// noise of the electrode. The lowest of many noisy means would be 5 to 10 % below, and at rest a
  /// hundredth of the maximum would be left. 0 where nothing rests.
  double resting_level_v = 0.0;
  bool rests = true;  ///< False: the greatest level is below 1.5 times the quietest second, such as
                      ///< in an effort that is held from the first sample to the last.
  /// sqrt(m^2 - rest^2): activation 1. m is the mean of the greatest moving means over the study,
  /// those at most one spread of such a mean below m. The one greatest of many would be 5 to 10 %
  /// above an effort that is held.
  double reference_v = 0.0;
  double relative_sd = 0.0;    ///< Uncertainty of the reference, by as many windows as m has.
  double bandwidth_hz = 0.0;   ///< Of the raw EMG where the maximum was found; 0: not known.
  std::string source_trial;    ///< Where the greatest of the means was found ...
  double source_time_s = 0.0;  ///< ... the middle of its window ...
  bool from_mvc = false;       ///< ... and whether that trial is a maximal contraction.
};

struct NormalisationOptions {
  double window_s = 0.5;  ///< Of the moving mean; trials that are shorter have no part in it.
};

/// One entry per channel of the first trial. All trials must have the same channels. Throws
/// InvalidInput if a channel is missing somewhere or flat, or no trial is as long as the window.
[[nodiscard]] std::vector<ChannelNormalisation> find_normalisation(
    std::span<const TrialEnvelope> trials, const NormalisationOptions& options = {});

/// sqrt(envelope^2 - resting level^2) / reference, 0 below the resting level, not limited above;
/// dimensionless. The noise of the electrode is independent of the muscle's signal: their powers
/// add, not their amplitudes. Subtracting the amplitude would make an activation of 0.1 read 16 %
/// low where the noise at rest is 1.8 % of the maximum.
[[nodiscard]] TimeSeries normalise(const TimeSeries& envelope,
                                   const std::vector<ChannelNormalisation>& normalisation);

}  // namespace myoid::signals
