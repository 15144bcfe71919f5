#pragma once

#include <optional>
#include <string>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

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
