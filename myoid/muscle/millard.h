#pragma once

#include "myoid/muscle/bezier_curve.h"

namespace myoid::muscle {

/// Active force over fiber length.
struct MillardActive {
  double shortest_length = 0.4441;
  double transition_length = 0.73;  ///< From the steep to the shallow ascending limb.
  double longest_length = 1.8123;
  double shallow_slope = 0.8616;  ///< Slope of the ascending limb near the optimum.
  double minimum = 0.0;           ///< Value outside the active range; 0.1 where f_l is divided by.
};

/// Force over velocity.
struct MillardVelocity {
  double slope_at_shortening_limit = 0.0;  ///< df_v/dv at v = -1.
  double slope_near_shortening_limit = 0.25;
  double slope_at_rest = 5.0;
  double slope_at_lengthening_limit = 0.0;  ///< df_v/dv at v = 1.
  double slope_near_lengthening_limit = 0.15;
  double max_eccentric_multiplier = 1.4;
  double concentric_curviness = 0.6;
  double eccentric_curviness = 0.9;
};

/// Passive force over the strain of the fiber.
struct MillardPassive {
  double strain_at_zero = 0.0;
  double strain_at_one = 0.7;
  double stiffness_low = 0.2;
  double stiffness_at_one = 2.0 / 0.7;
  double curviness = 0.75;
};

/// Tendon force over its strain.
struct MillardTendon {
  double stiffness_at_one = 1.375;  ///< [F_max per e0]
  double toe_force = 2.0 / 3.0;
  double curviness = 0.5;
};

/// Shape of the curves of Millard, Uchida, Seth & Delp (2013), J Biomech Eng 135:021005.
/// Defaults are those of OpenSim's curves of these names. Lengths in optimal fiber lengths,
/// velocities in v_max, forces in F_max.
struct MillardShape {
  MillardActive active;
  MillardVelocity velocity;
  MillardPassive passive;
  MillardTendon tendon;
};

/// The four curves. Derivatives pass through their arguments, not through their shape.
struct MillardCurves {
  /// Throws InvalidInput if the shape makes no curve.
  explicit MillardCurves(const MillardShape& shape = {});

  /// Active force over fiber length: a steep and a shallow ascending limb, plateau at 1, descending
  /// limb; `MillardActive::minimum` outside.
  BezierCurve force_length;
  /// Force over velocity: 0 at -1, 1 at rest, the eccentric maximum at 1, straight beyond.
  BezierCurve force_velocity;
  /// Passive force over fiber length: 0 to l = 1, 1 at 1 + `strain_at_one`, straight beyond.
  BezierCurve passive;
  /// Tendon force over strain / e0, where e0 is the strain at F_max (0.049 by default): 0 when
  /// slack, toe to 2/3, straight through (1, 1).
  BezierCurve tendon;
};

}  // namespace myoid::muscle
