#pragma once

#include <string>

#include "myoid/model/body_model.h"

namespace myoid::dynamics {

/// What the muscles of a joint can do, and what it can feel.
struct JointCapacity {
  double positive_nm = 0.0;  ///< All muscles that turn it so at F_max, where they do most together.
  double negative_nm = 0.0;  ///< Likewise the other way, as a magnitude.
  double lever_m = 0.0;      ///< From the joint to the farthest body or marker that it moves, at
                             ///< most kLongestLever_m.
  double body_mass_kg = 0.0;  ///< As given, or of the model's bodies, at least kLightBody_kg.

  [[nodiscard]] double isometric_nm() const;
  /// More than any person's muscles and weight make at this joint:
  ///
  ///   2.5 x 1.5 x isometric + body weight x lever
  ///
  /// 2.5: the strongest that calibrations of generic models allow (CEINMS' strength coefficients);
  /// 1.5: force in lengthening over the isometric one (1.2 to 1.8).
  [[nodiscard]] double greatest_nm() const;
};

/// Body weight is never taken to be less: models of one arm weigh little.
inline constexpr double kLightBody_kg = 50.0;

/// No lever is taken to be longer, whatever the model: a tall person's hip stands 1.1 m high.
inline constexpr double kLongestLever_m = 1.2;

/// Over the range of the coordinate, half a turn either way of its default at most, all others at
/// their default. Throws ModelError if there is no such coordinate.
[[nodiscard]] JointCapacity joint_capacity(const model::BodyModel& model,
                                           const std::string& coordinate,
                                           double body_mass_kg = 0.0);

/// Bodies that the coordinate's joint moves: its child and all that hangs on it.
[[nodiscard]] std::vector<bool> moved_bodies(const model::BodyModel& model, int joint);

}  // namespace myoid::dynamics
