#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace myoid::fit {

/// The torque of a muscle, or of all muscles that turn a joint the same way, at the activation of the maximal
/// contraction and at rest of the joint, over the recorded angles (fit/posterior/voluntary_torque.h). n places.
struct VoluntaryCurve {
  std::string owner;                 ///< Muscle, or joint.
  std::string joint;                 ///< Joint at which the torque acts.
  bool of_joint = false;             ///< `owner` is the joint.
  int direction = 1;                 ///< 1: muscles with positive moment arms; -1: with negative ones.
  std::vector<std::string> muscles;  ///< The muscles that pull.
  /// The end of the names of its parameters: "" of a muscle in a study of one joint, "_at_knee_angle" in one of several
  /// joints, "_positive" or "_negative" of a joint.
  std::string ending;
  Eigen::VectorXd angle_rad;  ///< n, rising; empty where the study has no angles.
  Eigen::VectorXd length_m;   ///< n: musculotendon length; empty for a joint.
  /// n: the torque's size [N m], and its 95 % interval of the person.
  Eigen::VectorXd torque_nm, low_nm, high_nm;
  Eigen::VectorXd given_low_nm, given_high_nm;  ///< n: interval given geometry and sensors.
  bool from_mvc = true;                         ///< False: at the largest recorded EMG, for want of a contraction.
  /// Other joints move the muscle, too: the torque is that of the mean length at each angle.
  bool averaged = false;
};

inline constexpr std::string_view kVoluntaryTorque = "voluntary_torque";
inline constexpr std::string_view kVoluntaryAngle = "voluntary_torque_angle";
inline constexpr std::string_view kVoluntaryPower = "voluntary_power";

/// Returns true for the parameters of greatest voluntary torques, of their angles and of powers.
[[nodiscard]] constexpr bool is_voluntary(std::string_view parameter) { return parameter.starts_with("voluntary_"); }

/// Returns true for powers, which follow from the torque.
[[nodiscard]] constexpr bool is_voluntary_power(std::string_view parameter) {
  return parameter.starts_with(kVoluntaryPower);
}

/// Returns true for an angle of the greatest torque: an interval scale, of which no share can be taken.
[[nodiscard]] constexpr bool is_voluntary_angle(std::string_view parameter) {
  return parameter.starts_with(kVoluntaryAngle);
}

}  // namespace myoid::fit
