#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/identification/study_data.h"

namespace myoid::identification {

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
  std::string trial = {};     ///< The trial in which they are exchanged; empty: all.
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

/// Finds the calibration trial and pair of channels whose exchange in that trial alone lowers the error of the
/// literature's muscles most: the trial's by more than the uncertainty of the strengths, to at most 1.5 times the other
/// trials' median error, with R2 above 0.5 over all trials. `references` are the amplitudes [V] that are activation 1,
/// by channel; the channels are normalized anew, because the exchange may have set them. Empty for fewer than three
/// trials, and where R2 is above 0.5 as named: there a synergist may fit one trial better by chance.
[[nodiscard]] std::optional<ExchangedElectrodes> exchanged_in_a_trial(const StudyData& data,
                                                                      double delay_s,
                                                                      const std::map<std::string, double>& references);

}  // namespace myoid::identification
