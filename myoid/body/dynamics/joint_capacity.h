#pragma once

#include <string>

#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// Limits of a joint's torque: strength of its muscles, lever and body weight.
struct JointCapacity {
  /// Torque of all muscles of the positive direction at F_max, at the angle of its maximum.
  double positive_nm = 0.0;
  double negative_nm = 0.0;  ///< Torque in the negative direction, as a magnitude.
  /// Distance from the joint to the farthest body or marker that the joint moves, at most kLongestLever_m.
  double lever_m = 0.0;
  double body_mass_kg = 0.0;  ///< Given mass or mass of the model's bodies, at least kLightBody_kg.

  [[nodiscard]] double isometric_nm() const;
  /// Returns a torque above the muscles and the weight of any person at this joint [N m]:
  ///
  ///   2.5 x 1.5 x isometric + body weight x lever
  ///
  /// 2.5: the strongest that calibrations of generic models allow (CEINMS' strength coefficients);
  /// 1.5: force in lengthening over the isometric one (1.2 to 1.8).
  [[nodiscard]] double greatest_nm() const;
};

/// Lower bound of the body mass: models of one arm have a small mass.
inline constexpr double kLightBody_kg = 50.0;

/// Upper bound of the lever: a tall person's hip stands 1.1 m high.
inline constexpr double kLongestLever_m = 1.2;

/// Searches the range of the coordinate, at most half a turn to either side of its default, with
/// all other coordinates at their default. Throws ModelError for an unknown coordinate.
[[nodiscard]] JointCapacity joint_capacity(const body::BodyModel& model,
                                           const std::string& coordinate,
                                           double body_mass_kg = 0.0);

/// Returns the bodies that a joint moves: its child and all bodies that the child carries.
[[nodiscard]] std::vector<bool> moved_bodies(const body::BodyModel& model, int joint);

}  // namespace myoid::body
