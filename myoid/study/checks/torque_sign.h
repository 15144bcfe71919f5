#pragma once

#include <Eigen/Core>

namespace myoid::study {

/// Shares of a torque's mean square that muscles explain if each may have another strength, and of the torque with the
/// other sign. Strengths are never negative.
struct SignsExplained {
  double as_given = 0.0, reversed = 0.0;
};

/// Returns the shares by non-negative least squares on the muscles' torques (samples x muscles) with the starting
/// strengths. A muscle that starts three times too strong turns the sum of torques around; it does not turn the sign of
/// a torque that muscles of other strengths make.
[[nodiscard]] SignsExplained signs_explained(const Eigen::MatrixXd& muscle_torque_nm, const Eigen::VectorXd& torque_nm);

}  // namespace myoid::study
