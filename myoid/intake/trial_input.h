#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/provenance.h"
#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/files/marker_series.h"
#include "myoid/files/text_file.h"
#include "myoid/intake/clock_check.h"
#include "myoid/intake/given_stages.h"
#include "myoid/intake/trial_clock.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

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
  std::optional<recording::MarkerSeries> markers;
  Vec3 up_L = Vec3::UnitY();                  ///< Upward axis of the markers' laboratory, as recorded.
  std::optional<TimeSeries> motion;           ///< Coordinates [rad | m]; no columns: given lengths alone.
  std::optional<TimeSeries> emg;              ///< [V], or dimensionless for envelopes and activations.
  std::optional<TimeSeries> external_torque;  ///< [N m]
  std::optional<dynamics::ExternalLoads> loads;
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

/// Adds the repairs of a reader: "file:line: message".
void add_repairs(const std::filesystem::path& path,
                 const std::vector<recording::Repair>& repairs,
                 std::vector<Remark>& remarks);

/// Least number of samples of a recording.
inline constexpr int kLeastOfATrial = 10;

/// Returns "3 samples from its begin to 2 s; at least 10 are needed".
[[nodiscard]] std::string few_samples(const TrialSpec& trial, const TimeSeries& series, int needed = kLeastOfATrial);

}  // namespace myoid
