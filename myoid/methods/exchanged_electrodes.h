#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// How well the literature's muscles make the torque of a study's calibration trials with one best
/// gain, both sides below 1.5 Hz, all joints together.
struct LabelFit {
  double rms_nm = 0.0;
  double r2 = 0.0;                   ///< 1 - SSE/SST about the mean of all trials.
  std::vector<double> trial_rms_nm;  ///< By calibration trial.
};

/// Two EMG channels that fit the torque much better as each other.
struct ExchangedElectrodes {
  std::string first, second;  ///< Channels.
  LabelFit as_named, exchanged;
  [[nodiscard]] std::string sentence() const;
};

/// The fit with the channels of `data` as they are named, or with these two exchanged.
[[nodiscard]] LabelFit fit_of_labels(const identification::StudyData& data,
                                     double delay_s,
                                     const std::string& first = "",
                                     const std::string& second = "");

/// The pair of channels whose exchange lowers the error of the literature's muscles most, if by
/// more than their strengths are unsure of (beliefs::kStrengthRatio), in three of four trials at
/// least, and to a fit that describes the torque (R2 above 0.5). Empty if there is none.
[[nodiscard]] std::optional<ExchangedElectrodes> exchanged_electrodes(
    const identification::StudyData& data, double delay_s);

}  // namespace myoid::identification
