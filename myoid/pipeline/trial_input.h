#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "myoid/core/error.h"
#include "myoid/core/provenance.h"
#include "myoid/core/time_series.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/model/body_model.h"
#include "myoid/pipeline/study.h"
#include "myoid/pipeline/trial_clock.h"
#include "myoid/recording/marker_series.h"
#include "myoid/signals/clock_gaps.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/fault.h"

namespace myoid::pipeline {

/// A longer pause in a clock is refused: what a spline makes of it is no measurement.
inline constexpr double kLongestGap_s = 0.5;
/// Parts of a trial between such pauses that are shorter are left out.
inline constexpr double kShortestPart_s = 1.0;

/// A clock with a pause of more than kLongestGap_s.
class ClockPause : public ReadError {
 public:
  ClockPause(const std::filesystem::path& path,
             const std::string& message,
             std::vector<signals::ClockStretch> stretches)
      : ReadError(path, 0, message), stretches_(std::move(stretches)) {}
  /// What lies between the pauses.
  [[nodiscard]] const std::vector<signals::ClockStretch>& stretches() const { return stretches_; }

 private:
  std::vector<signals::ClockStretch> stretches_;
};

/// The files of one trial as values: SI, laboratory turned to y up, markers renamed to the model's
/// and mended.
struct TrialInput {
  std::optional<recording::MarkerSeries> markers;
  std::optional<TimeSeries> motion;  ///< Coordinates [rad | m].
  std::optional<TimeSeries> emg;     ///< [V], or dimensionless for envelopes and activations.
  std::optional<TimeSeries> external_torque;  ///< [N m]
  std::optional<dynamics::ExternalLoads> loads;
  std::optional<TrialClock> emg_clock;        ///< How the EMG was put on the clock of the motion.
  std::vector<std::string> notes;             ///< All repairs and remarks.
  std::vector<std::string> warnings;          ///< Those of them that may make numbers wrong.
  std::vector<signals::Fault> marker_faults;  ///< Found before they were mended.
  std::vector<InputFile> files;
};

/// Reads one trial; its EMG and loads are put on the clock of its motion before anything else
/// (`trial_clock`). Throws ReadError (file, line, found, expected, remedy) or InvalidInput: a
/// missing EMG channel, angles that are degrees where radians are said, EMG and motion that do not
/// cover one time, a pause of more than kLongestGap_s in a clock (ClockPause), a clock that is not
/// in seconds, a cut-off above half the rate.
[[nodiscard]] TrialInput read_trial_input(const Study& study,
                                          const TrialSpec& trial,
                                          const model::BodyModel& model);

/// How the study wants raw EMG to become envelopes.
[[nodiscard]] signals::EnvelopeOptions envelope_options(const Study& study);

/// A trial, or a part of it.
struct TrialPart {
  TrialSpec spec;
  TrialInput input;
};

/// Reads one trial; one whose clock pauses for more than kLongestGap_s as several, "name.1",
/// "name.2", ..., with a warning: nothing is filtered or interpolated across the pause. Parts of
/// less than kShortestPart_s are left out. Throws as `read_trial_input`, also where nothing is left
/// or the study calibrates coordinates in a window that not every part has.
[[nodiscard]] std::vector<TrialPart> read_trial_parts(const Study& study,
                                                      const TrialSpec& trial,
                                                      const model::BodyModel& model);

}  // namespace myoid::pipeline
