#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace myoid::identification {

/// What a joint does by itself while its muscles are at rest, as it was measured: ligaments, skin
/// and stretched fibers, and with them what a wrong weight of the segments adds at every angle. A
/// muscle fitted without passive force would take it for its own.
///
///   T(q, qdot) = sum_k c_k P_k(x) - b qdot,   x = 2 (q - q_lowest) / (q_highest - q_lowest) - 1
///
/// with Legendre polynomials P_k up to the fifth degree, which meet an exponential that rises
/// twentyfold over the range to a thousandth of its largest value.
struct RestingTorque {
  double lowest_rad = 0.0, highest_rad = 0.0;  ///< The angles at which it was measured.
  Eigen::VectorXd coefficient_nm;              ///< c
  double viscosity_nms = 0.0;  ///< b; 0 where the joint was moved one way only, or not.
  double residual_nm = 0.0;    ///< Root mean square of what is left.

  /// Without the viscous part [N m]; beyond the angles that were measured the value at their end.
  [[nodiscard]] double at(double angle_rad) const;
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& angle_rad) const;
};

/// The same with the joint's name and the passive trials in which it was measured.
struct RestingJoint {
  std::string joint;
  RestingTorque torque;
  std::vector<std::string> trials;
};

/// Least squares over n samples of one joint moved while at rest: angle [rad], speed [rad/s] and
/// the torque that muscles would have had to provide [N m] (inverse dynamics less the torque of the
/// surroundings). The degree is one for every 20 degrees of range, at most five, so that noise
/// is not followed. Absent for fewer than 20 samples or values that are not finite.
[[nodiscard]] std::optional<RestingTorque> fit_resting_torque(const Eigen::VectorXd& angle_rad,
                                                              const Eigen::VectorXd& velocity_radps,
                                                              const Eigen::VectorXd& torque_nm);

}  // namespace myoid::identification
