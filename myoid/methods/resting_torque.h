#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace myoid::identification {

/// The measured torque of a joint while its muscles are at rest: ligaments, skin
/// and stretched fibers, the weight of limb and instrument (a dynamometer's plate and lever) as far
/// as nothing else accounts for it, and the offset of the load cell. A muscle fitted without them
/// would take them for its own.
///
///   T(q, qdot) = sum_k c_k P_k(x) - b qdot,   x = 2 (q - q_lowest) / (q_highest - q_lowest) - 1
///
/// with Legendre polynomials P_k up to the fifth degree, which meet an exponential that rises
/// twentyfold over the range to a thousandth of its largest value, and a weight's sine over 50
/// degrees, with the third degree, to 3e-4 of its amplitude. Beyond the range
///
///   T(q) = T(q_end) + W(q) - W(q_end),   W(q) = w_s sin q + w_c cos q
struct RestingTorque {
  double lowest_rad = 0.0, highest_rad = 0.0;  ///< The angles at which it was measured.
  Eigen::VectorXd coefficient_nm;              ///< c
  /// w_s, w_c: the sine of the angle that comes nearest to the torque, which a weight makes. 0
  /// where it leaves more than a tenth of the torque's variance, or is more than 25 N m.
  double weight_sin_nm = 0.0, weight_cos_nm = 0.0;
  double viscosity_nms = 0.0;  ///< b; 0 where the joint was moved one way only, or not.
  double residual_nm = 0.0;    ///< Root mean square of the remainder.

  /// Without the viscous part [N m].
  [[nodiscard]] double at(double angle_rad) const;
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& angle_rad) const;
};

/// The greatest weight torque of an instrument, or of a limb that a model has wrong [N m]: 5 kg at
/// half a metre.
inline constexpr double kLargestWeight_nm = 25.0;

/// Part of a resting torque that no weight explains, for samples of one trial: the torque less the
/// sine of the angle that comes nearest to it, or less its mean where the joint hardly moves.
[[nodiscard]] Eigen::VectorXd beside_weight(const Eigen::VectorXd& angle_rad,
                                            const Eigen::VectorXd& torque_nm);

/// The same with the joint's name and the passive trials in which it was measured.
struct RestingJoint {
  std::string joint;
  RestingTorque torque;
  std::vector<std::string> trials;
};

/// Least squares over n samples of one joint moved while at rest: angle [rad], speed [rad/s] and
/// the torque that muscles would have had to provide [N m] (inverse dynamics less the torque of the
/// surroundings). The degree is one for every 15 degrees of range, at most five, so that noise
/// is not followed. Absent for fewer than 20 samples or values that are not finite.
[[nodiscard]] std::optional<RestingTorque> fit_resting_torque(const Eigen::VectorXd& angle_rad,
                                                              const Eigen::VectorXd& velocity_radps,
                                                              const Eigen::VectorXd& torque_nm);

}  // namespace myoid::identification
