#pragma once

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// OpenSim's verdict on one segment and one object: `wrapped` competes with the other segments by
/// the change in length, `mandatory` wins at once.
enum class WrapAction { none, inside, wrapped, mandatory };

/// OpenSim's contact of one segment with one object, in the object's frame.
struct OpenSimContact {
  WrapAction action = WrapAction::none;
  bool has_points = false;  ///< There is a contact to insert.
  Vec3 first_W = Vec3::Zero();
  Vec3 second_W = Vec3::Zero();
  double arc_length_m = 0.0;
};

/// Returns the contact that OpenSim 4.5.2 computes for the segment p - q, with the defects that
/// `compat` switches on (compat.h). `single`: the path has no other wrap object; with several, the
/// tangent points on a cylinder slide until the helix meets the straight pieces within 0.1 degree,
/// at most 100 times. Arguments of acos and roots are not limited: a NaN propagates to the length.
[[nodiscard]] OpenSimContact opensim_contact(
    const WrapObject& object, WrapMethod method, const Vec3& p_W, const Vec3& q_W, bool single, const Compat& compat);

}  // namespace myoid::body
