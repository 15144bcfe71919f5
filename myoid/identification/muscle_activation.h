#pragma once

#include <Eigen/Core>

#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// Activation of every muscle of a trial at `time_s - delay_s`, n x m; beyond the recording its end
/// value. `slope`, if not null, receives d activation / dt.
[[nodiscard]] Eigen::MatrixXd muscle_activation(const StudyData& data,
                                                const TrialData& trial,
                                                const Eigen::VectorXd& time_s,
                                                double delay_s,
                                                Eigen::MatrixXd* slope = nullptr);

}  // namespace myoid::identification
