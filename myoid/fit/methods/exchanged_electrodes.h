#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Error of the literature's muscles in the torque of a study's calibration trials, with one best
/// gain, both sides below 1.5 Hz, all joints together.
struct LabelFit {
  double rms_nm = 0.0;
  double r2 = 0.0;                   ///< 1 - SSE/SST about the mean of all trials.
  std::vector<double> trial_rms_nm;  ///< One per calibration trial.
};

/// Two EMG channels that fit the torque much better when exchanged.
struct ExchangedElectrodes {
  std::string first, second;  ///< Names of the channels.
  LabelFit as_named, exchanged;
  [[nodiscard]] std::string sentence() const;
};

/// Returns the fit with the channels of `data` as named, or with these two exchanged.
[[nodiscard]] LabelFit fit_of_labels(const StudyData& data,
                                     double delay_s,
                                     const std::string& first = "",
                                     const std::string& second = "");

/// Finds the pair of channels whose exchange lowers the error of the literature's muscles most. The gain must exceed
/// the uncertainty of their strengths (beliefs::kStrengthRatio) in at least three of four trials, and the exchanged fit
/// must describe the torque (R2 above 0.5). A channel whose reference one trial alone sets, 2.5 times above all others,
/// is not compared. Empty if there is no such pair.
[[nodiscard]] std::optional<ExchangedElectrodes> exchanged_electrodes(const StudyData& data, double delay_s);

}  // namespace myoid::fit
