#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Error of the literature's muscles in the torque of a study's calibration trials, with one best
/// gain, both sides below 1.5 Hz, all joints together.
struct LabelFit {
  double rms_nm = 0.0;
  double r2 = 0.0;                   ///< 1 - SSE/SST about the mean of all trials.
  std::vector<double> trial_rms_nm;  ///< One per calibration trial.
};

/// Returns the fit with the EMG `lead_s` before the torque.
[[nodiscard]] LabelFit fit_of_labels(const StudyData& data, double lead_s);

/// The lead of EMG over torque that bodies and filters make.
struct UsualLead {
  double earliest_s = 0.0, latest_s = 0.0;
};

/// EMG that makes the torque better with the clock of all trials moved beyond any delay of a body. Of a single trial:
/// run/mistaken_emg.h.
struct ShiftedEmg {
  double lead_s = 0.0;  ///< The delay at which the literature's muscles fit best, to 0.1 s; negative: the EMG is late.
  double rms_nm = 0.0;  ///< Error at `lead_s`.
  double usual_rms_nm = 0.0;  ///< Least error at a usual lead.
  UsualLead usual;
  [[nodiscard]] std::string sentence() const;
};

/// Finds the delay between EMG and torque, within 1.5 s to either side, at which the literature's muscles make the
/// torque best (`fit_of_labels`; the error has one minimum where movement and effort do not repeat themselves). Empty
/// unless it lies outside the usual leads over all and in three of four trials, describes the torque (R2 above 0.5) and
/// lowers the error by 5 % or more, and no other delay, 0.3 s away, fits as well within 10 %.
[[nodiscard]] std::optional<ShiftedEmg> shifted_emg(const StudyData& data, const UsualLead& usual);

/// EMG that fits the torque better when it is taken for earlier than its clock says.
struct LateEmg {
  std::string trial;  ///< Empty: all calibration trials together.
  double late_s = 0.0;
  double as_stamped_nm = 0.0, moved_nm = 0.0;  ///< Rms error of the torque below the cut-off.
  [[nodiscard]] std::string sentence() const;
};

/// Moves the EMG of the calibration trials to earlier times, by up to a second, and finds the trial, or all together,
/// whose torque error falls most. No muscle pulls before its EMG: a late clock does that, or an envelope that was
/// filtered in one direction. The fall exceeds chance by VerdictRules::prior_conflict standard deviations, and the
/// shift the error allowed to an identified delay (of one trial: to a weak delay); else the result is empty.
[[nodiscard]] std::optional<LateEmg> late_emg(const StudyData& data,
                                              const IdentificationResult& fit,
                                              double residual_cutoff_hz);

/// Returns `late_emg` of a fit whose delay has an interval that ends at 0 (ParameterEstimate::at_bound); else nothing.
[[nodiscard]] std::optional<LateEmg> late_emg_of_no_delay(const StudyData& data,
                                                          const EstimatorOptions& options,
                                                          const IdentificationResult& fit);

}  // namespace myoid::fit
