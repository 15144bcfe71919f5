#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/provenance.h"
#include "myoid/core/time_series.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/model/body_model.h"
#include "myoid/pipeline/study.h"
#include "myoid/recording/marker_series.h"

namespace myoid::pipeline {

/// A longer pause in a clock is refused: what a spline makes of it is no measurement.
inline constexpr double kLongestGap_s = 0.5;

/// The files of one trial as values: SI, laboratory turned to y up, markers renamed to the model's.
struct TrialInput {
  std::optional<recording::MarkerSeries> markers;
  std::optional<TimeSeries> motion;  ///< Coordinates [rad | m].
  std::optional<TimeSeries> emg;     ///< [V], or dimensionless for envelopes and activations.
  std::optional<TimeSeries> external_torque;  ///< [N m]
  std::optional<dynamics::ExternalLoads> loads;
  std::vector<std::string> notes;     ///< All repairs and remarks.
  std::vector<std::string> warnings;  ///< Those of them that may make numbers wrong.
  std::vector<InputFile> files;
};

/// Reads one trial. Throws ReadError (file, line, found, expected, remedy) or InvalidInput: a
/// missing EMG channel, angles that are degrees where radians are said, EMG and motion that do not
/// cover one time, a pause of more than kLongestGap_s in a clock, a clock that is not in seconds, a
/// cut-off above half the rate.
[[nodiscard]] TrialInput read_trial_input(const Study& study,
                                          const TrialSpec& trial,
                                          const model::BodyModel& model);

}  // namespace myoid::pipeline
