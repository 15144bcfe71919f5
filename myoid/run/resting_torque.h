#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace myoid::run {

/// The measured torque of a joint while its muscles are at rest. It comes from ligaments, skin and stretched fibers,
/// from the weight of limb and instrument (a dynamometer's plate and lever) if the model does not include it, and from
/// the load cell's offset. A fit without this torque would ascribe it to the muscles.
///
///   T(q, qdot) = sum_k c_k P_k(x) - b qdot,   x = 2 (q - q_lowest) / (q_highest - q_lowest) - 1
///
/// with Legendre polynomials P_k up to the fifth degree. They fit an exponential that rises
/// twentyfold over the range to a thousandth of its largest value, and with the third degree a
/// weight's sine over 50 degrees to 3e-4 of its amplitude. Beyond the range
///
///   T(q) = T(q_end) + W(q) - W(q_end),   W(q) = w_s sin q + w_c cos q
struct RestingTorque {
  double lowest_rad = 0.0, highest_rad = 0.0;  ///< Range of the measured angles.
  Eigen::VectorXd coefficient_nm;              ///< c
  /// w_s, w_c: coefficients of the sine of the angle that fits the torque best, as a weight has. 0
  /// if the sine leaves more than a tenth of the torque's variance, or exceeds 25 N m.
  double weight_sin_nm = 0.0, weight_cos_nm = 0.0;
  double viscosity_nms = 0.0;  ///< b; 0 if the joint was moved in one direction only, or not moved.
  double residual_nm = 0.0;    ///< Root mean square of the remainder.

  /// Returns the torque without the viscous part [N m].
  [[nodiscard]] double at(double angle_rad) const;
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& angle_rad) const;
};

/// Greatest weight torque of an instrument, or of the error in a model's limb [N m]: 5 kg at half a metre.
inline constexpr double kLargestWeight_nm = 25.0;

/// Returns the part of a resting torque that no weight explains, for samples of one trial: the
/// torque minus the best-fitting sine of the angle, or minus its mean if the joint hardly moves.
[[nodiscard]] Eigen::VectorXd beside_weight(const Eigen::VectorXd& angle_rad, const Eigen::VectorXd& torque_nm);

/// A resting torque with the joint's name and its passive trials.
struct RestingJoint {
  std::string joint;
  RestingTorque torque;
  std::vector<std::string> trials;
};

/// Fits n samples of one joint moved at rest by least squares: angle [rad], speed [rad/s] and the muscles' torque by
/// inverse dynamics, without the torque of the surroundings [N m]. The degree is one for every 15 degrees of range, at
/// most five, so that the fit does not follow noise. Empty for fewer than 20 samples or values that are not finite.
[[nodiscard]] std::optional<RestingTorque> fit_resting_torque(const Eigen::VectorXd& angle_rad,
                                                              const Eigen::VectorXd& velocity_radps,
                                                              const Eigen::VectorXd& torque_nm);

}  // namespace myoid::run
