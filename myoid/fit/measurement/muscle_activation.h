#pragma once

#include <Eigen/Core>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Returns the activation of every muscle at the trial's samples, `delay_s` after its EMG, n x m, with the end value
/// beyond the recording.
[[nodiscard]] Eigen::MatrixXd muscle_activation(const StudyData& data, const TrialData& trial, double delay_s);

}  // namespace myoid::fit
