#include "myoid/muscle/thelen.h"

#include <algorithm>
#include <cmath>

namespace myoid::muscle {

RigidTendonFiber rigid_tendon_fiber(const ThelenParameters& p,
                                    double musculotendon_length_m,
                                    double musculotendon_velocity_mps) {
  const double height = p.optimal_fiber_length_m * std::sin(p.pennation_at_optimal_rad);
  const double shortest = height > 0.0 ? height / std::sin(p.max_pennation_rad) : 0.0;
  const double along = musculotendon_length_m - p.tendon_slack_length_m;
  RigidTendonFiber fiber;
  if (along >= shortest * std::cos(p.max_pennation_rad)) {
    fiber.fiber_length_m = std::hypot(height, along);
  } else {
    fiber.fiber_length_m = shortest;
  }
  fiber.at_minimum = fiber.fiber_length_m <= shortest;
  if (height > 0.0 && fiber.fiber_length_m > 0.0) {
    const double pennation =
        std::min(std::asin(std::min(1.0, height / fiber.fiber_length_m)), p.max_pennation_rad);
    fiber.cos_pennation = std::cos(pennation);
  }
  fiber.fiber_velocity_mps = musculotendon_velocity_mps * fiber.cos_pennation;
  return fiber;
}

double thelen_force_velocity(const ThelenParameters& p,
                             double activation,
                             double normalized_velocity) {
  const double slowed = 0.25 + 0.75 * activation;
  const double af = p.concentric_shape;
  const double flen = p.eccentric_plateau;
  const double v = normalized_velocity / slowed;
  // Concentric: v = (f - 1)/(1 + f/Af), linear below f = 0 with the slope there, 1 + 1/Af.
  if (v <= 0.0) {
    if (v < -1.0) return 0.0;  // the line goes on below zero; a muscle does not push
    return (1.0 + v) / (1.0 - v / af);
  }
  // Eccentric: v = (f - 1)(Flen - 1)/((2 + 2/Af)(Flen - f)), linear beyond f* = extrapolation *
  // Flen.
  const double k = (2.0 + 2.0 / af) / (flen - 1.0);
  const double limit = p.extrapolation * flen;
  const double v_limit = (limit - 1.0) / (k * (flen - limit));
  if (v <= v_limit) return (1.0 + k * flen * v) / (1.0 + k * v);
  const double slope = (flen - 1.0) / (k * (flen - limit) * (flen - limit));  // dv/df at the limit
  return limit + (v - v_limit) / slope;
}

double thelen_fiber_velocity(const ThelenParameters& p, double activation, double multiplier) {
  const double slowed = 0.25 + 0.75 * activation;
  const double af = p.concentric_shape;
  const double flen = p.eccentric_plateau;
  const double f = multiplier;
  if (f < 0.0) return slowed * (-1.0 + (1.0 + 1.0 / af) * f);
  if (f <= 1.0) return slowed * (f - 1.0) / (1.0 + f / af);
  const double k = (2.0 + 2.0 / af) / (flen - 1.0);
  const double limit = p.extrapolation * flen;
  if (f <= limit) return slowed * (f - 1.0) / (k * (flen - f));
  const double slope = (flen - 1.0) / (k * (flen - limit) * (flen - limit));
  return slowed * ((limit - 1.0) / (k * (flen - limit)) + slope * (f - limit));
}

double thelen_optimal_force(const ThelenParameters& p,
                            double musculotendon_length_m,
                            double musculotendon_velocity_mps) {
  const RigidTendonFiber fiber =
      rigid_tendon_fiber(p, musculotendon_length_m, musculotendon_velocity_mps);
  if (fiber.at_minimum) return 0.0;
  const double stretch = fiber.fiber_length_m / p.optimal_fiber_length_m - 1.0;
  const double fl = std::exp(-stretch * stretch / p.active_shape);
  const double v =
      fiber.fiber_velocity_mps / (p.optimal_fiber_length_m * p.max_contraction_velocity);
  return p.max_isometric_force_n * fl * thelen_force_velocity(p, 1.0, v) * fiber.cos_pennation;
}

}  // namespace myoid::muscle
