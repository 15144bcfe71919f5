#pragma once

#include <Eigen/Core>

#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// Returns the activation of every muscle of a trial at `time_s - delay_s`, n x m, with the end
/// value beyond the recording. `slope`, if not null, receives d activation / dt.
[[nodiscard]] Eigen::MatrixXd muscle_activation(const StudyData& data,
                                                const TrialData& trial,
                                                const Eigen::VectorXd& time_s,
                                                double delay_s,
                                                Eigen::MatrixXd* slope = nullptr);

}  // namespace myoid::identification
