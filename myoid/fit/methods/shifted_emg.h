#pragma once

#include <optional>
#include <string>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// The lead of EMG over torque that bodies and filters make.
struct UsualLead {
  double earliest_s = 0.0, latest_s = 0.0;
};

/// EMG that makes the torque better with its clock moved beyond any delay of a body.
struct ShiftedEmg {
  std::string trial;    ///< Empty: all trials.
  double lead_s = 0.0;  ///< The delay at which the literature's muscles fit best, to 0.1 s; negative: the EMG is late.
  double rms_nm = 0.0;  ///< Error at `lead_s`.
  double usual_rms_nm = 0.0;  ///< Least error at a usual lead.
  UsualLead usual;
  [[nodiscard]] std::string sentence() const;
};

/// Finds the delay between EMG and torque, within 1.5 s to either side, at which the literature's muscles make the
/// torque best (`fit_of_labels`; the error has one minimum where movement and effort do not repeat themselves). All
/// trials are shifted if it lies outside the usual leads over all and in three of four trials, describes the torque (R2
/// above 0.5) and lowers the error by 5 % or more; a single trial if it does so by a quarter, and to the size of the
/// other trials' errors. Empty if neither is so, or another delay, 0.3 s away, fits as well within 10 %.
[[nodiscard]] std::optional<ShiftedEmg> shifted_emg(const StudyData& data, const UsualLead& usual);

}  // namespace myoid::fit
