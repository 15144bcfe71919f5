#include "myoid/muscle/joint_passive.h"

#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::muscle {

void validate(const JointPassive<double>& joint) {
  const auto require = [](bool good, std::string_view name, double value, std::string_view what) {
    if (!good || !std::isfinite(value)) {
      throw InvalidInput(fmt::format("{} of a passive joint is {:g}, expected {}", name, value, what));
    }
  };
  const auto not_negative = [&](double value, std::string_view name) {
    require(value >= 0.0, name, value, "zero or a positive number");
  };
  not_negative(joint.stiffness_nm_per_rad, "stiffness");
  not_negative(joint.viscosity_nms_per_rad, "viscosity");
  not_negative(joint.lower_stop_torque_nm, "lower_stop_torque");
  not_negative(joint.upper_stop_torque_nm, "upper_stop_torque");
  require(joint.lower_stop_width_rad > 0.0, "lower_stop_width", joint.lower_stop_width_rad, "a positive angle");
  require(joint.upper_stop_width_rad > 0.0, "upper_stop_width", joint.upper_stop_width_rad, "a positive angle");
  require(true, "neutral angle", joint.neutral_rad, "a finite angle");
  require(true, "lower_stop", joint.lower_stop_rad, "a finite angle");
  require(true, "upper_stop", joint.upper_stop_rad, "a finite angle");
}

JointPassive<double> elbow_passive() {
  return {.stiffness_nm_per_rad = 1.0,
          .neutral_rad = 80.0 * kDegree,
          .viscosity_nms_per_rad = 0.2,
          .lower_stop_torque_nm = 1.0,
          .lower_stop_rad = 10.0 * kDegree,
          .lower_stop_width_rad = 3.0 * kDegree,
          .upper_stop_torque_nm = 1.0,
          .upper_stop_rad = 140.0 * kDegree,
          .upper_stop_width_rad = 3.0 * kDegree};
}

}  // namespace myoid::muscle
