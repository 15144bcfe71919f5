#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/study/intake/clock_check.h"
#include "myoid/study/intake/given_stages.h"
#include "myoid/study/intake/trial_clock.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Durations of a recording and of the trial's motion, for files of their own without a window.
struct TrialLengths {
  std::string trial;
  double emg_s = 0.0, motion_s = 0.0;  ///< Counted from the same beginning.
  double motion_rate_hz = 0.0, emg_rate_hz = 0.0;
  bool of_loads = false;  ///< Loads in the place of EMG.
};

/// The files of one trial as values: in SI, turned onto the model's vertical, with markers renamed
/// to the model's and mended.
struct TrialInput {
  std::optional<MarkerSeries> markers;
  Vec3 up_L = Vec3::UnitY();                  ///< Upward axis of the markers' laboratory, as recorded.
  std::optional<TimeSeries> motion;           ///< Coordinates [rad | m]; no columns: given lengths alone.
  std::optional<TimeSeries> emg;              ///< [V], or dimensionless for envelopes and activations.
  std::optional<TimeSeries> external_torque;  ///< [N m]
  std::optional<body::ExternalLoads> loads;
  std::optional<TimeSeries> fascicles;  ///< [m], in columns named as the study's muscles; NaN: absent.
  GivenStages given;
  std::optional<TrialClock> emg_clock;  ///< Steps that put the EMG on the clock of the motion.
  std::vector<Remark> remarks;          ///< Notes and warnings about the files.
  std::vector<Remark> marker_faults;    ///< Faults of the markers as recorded, before mending.
  std::vector<InputFile> files;
  std::vector<TrialLengths> lengths;  ///< Durations before the trial was cut to its loads; else empty.
};

/// Adds a warning that a number may be wrong.
void warn(TrialInput& input, RemarkCode code, std::string text);

/// Adds notes on the reading of files.
void add_notes(const std::vector<std::string>& texts, std::vector<Remark>& remarks);

/// Returns the remark on a repair of a reader. A clock that may be wrong by ClockLimits::apart_s is a warning, and so
/// is a file that holds less than its header states.
[[nodiscard]] Remark remark_of(const Repair& repair, std::string says);

/// Adds the repairs of a reader: "file:line: message".
void add_repairs(const std::filesystem::path& path, const std::vector<Repair>& repairs, std::vector<Remark>& remarks);

/// Least number of samples of a recording.
inline constexpr int kLeastOfATrial = 10;

/// Returns "3 samples from its begin to 2 s; at least 10 are needed".
[[nodiscard]] std::string few_samples(const TrialSpec& trial, const TimeSeries& series, int needed = kLeastOfATrial);

}  // namespace myoid::study
