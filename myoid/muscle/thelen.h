#pragma once

namespace myoid::muscle {

/// Thelen's (2003) muscle with a rigid tendon, as static optimization uses it.
struct ThelenParameters {
  double max_isometric_force_n = 1000.0;
  double optimal_fiber_length_m = 0.1;
  double tendon_slack_length_m = 0.2;
  double pennation_at_optimal_rad = 0.0;
  double max_contraction_velocity = 10.0;  ///< [optimal fiber lengths / s]
  double active_shape = 0.45;              ///< gamma: f_l = exp(-(l/l0 - 1)^2 / gamma)
  double concentric_shape = 0.25;          ///< A_f
  double eccentric_plateau = 1.4;          ///< F_len
  double extrapolation =
      0.95;  ///< Beyond this share of the plateau the velocity law goes on as a line.
  double max_pennation_rad = 1.4706289056333368;  ///< acos(0.1)
};

/// The fiber inside a musculotendon unit whose tendon is rigid and whose width is constant.
struct RigidTendonFiber {
  double fiber_length_m = 0.0;
  double cos_pennation = 1.0;
  double fiber_velocity_mps = 0.0;
  bool at_minimum = false;  ///< The fiber is at its shortest: it carries no force.
};

/// h = l0 sin(alpha0); l = sqrt(h^2 + (l_mt - l_t0)^2), v = v_mt cos(alpha). Below the length at
/// which alpha reaches its maximum the fiber stays at that length. Lengths [m], velocity [m/s],
/// lengthening positive.
[[nodiscard]] RigidTendonFiber rigid_tendon_fiber(const ThelenParameters& parameters,
                                                  double musculotendon_length_m,
                                                  double musculotendon_velocity_mps);

/// Thelen's force-velocity multiplier: the f with v(f) = `normalized_velocity` (of v_max,
/// lengthening positive), where
///   v = (1/4 + 3/4 a) (f - 1) / b,  b = 1 + f/A_f (f <= 1),  b = (2 + 2/A_f)(F_len - f)/(F_len -
///   1) (f > 1)
/// with active force 1 at rest; linear below f = 0 and above extrapolation * F_len; never negative.
[[nodiscard]] double thelen_force_velocity(const ThelenParameters& parameters,
                                           double activation,
                                           double normalized_velocity);

/// The normalized velocity at which the force-velocity multiplier is `multiplier`: the law above
/// solved for v, going on as a line below f = 0 too.
[[nodiscard]] double thelen_fiber_velocity(const ThelenParameters& parameters,
                                           double activation,
                                           double multiplier);

/// Force along the tendon [N] per unit activation command, at full activation and with a rigid
/// tendon:
///   F = F_max f_l f_v cos(alpha). What static optimization multiplies by the activation.
[[nodiscard]] double thelen_optimal_force(const ThelenParameters& parameters,
                                          double musculotendon_length_m,
                                          double musculotendon_velocity_mps);

}  // namespace myoid::muscle
