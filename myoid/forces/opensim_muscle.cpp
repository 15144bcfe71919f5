#include "myoid/forces/opensim_muscle.h"

#include <algorithm>
#include <cmath>

#include "myoid/muscle/de_groote.h"
#include "myoid/muscle/thelen_curves.h"
#include "myoid/osim/thelen_properties.h"

namespace myoid::forces {
namespace {

muscle::MillardShape shape_of(const model::MillardCurves& c) {
  muscle::MillardShape s;
  s.shortest_active_length = c.active_min_length;
  s.transition_length = c.active_transition_length;
  s.longest_active_length = c.active_max_length;
  s.shallow_slope = c.active_shallow_slope;
  s.active_minimum = c.active_minimum;
  s.slope_at_shortening_limit = c.concentric_slope_at_vmax;
  s.slope_near_shortening_limit = c.concentric_slope_near_vmax;
  s.slope_at_rest = c.isometric_slope;
  s.slope_at_lengthening_limit = c.eccentric_slope_at_vmax;
  s.slope_near_lengthening_limit = c.eccentric_slope_near_vmax;
  s.max_eccentric_multiplier = c.eccentric_force;
  s.concentric_curviness = c.concentric_curviness;
  s.eccentric_curviness = c.eccentric_curviness;
  s.passive_strain_at_zero = c.fiber_strain_at_zero_force;
  s.passive_strain_at_one = c.fiber_strain_at_one_force;
  // Where the file leaves them open, the class takes these (as its published curves do).
  const double span = c.fiber_strain_at_one_force - c.fiber_strain_at_zero_force;
  s.passive_stiffness_at_one =
      c.fiber_stiffness_at_one_force > 0.0 ? c.fiber_stiffness_at_one_force : 2.0 / span;
  if (c.fiber_stiffness_at_low_force >= 0.0)
    s.passive_stiffness_low = c.fiber_stiffness_at_low_force;
  if (c.fiber_curviness >= 0.0) s.passive_curviness = c.fiber_curviness;
  if (c.tendon_stiffness_at_one_force > 0.0)
    s.tendon_stiffness_at_one = c.tendon_stiffness_at_one_force * c.tendon_strain_at_one_force;
  if (c.tendon_force_at_toe_end >= 0.0) s.tendon_toe_force = c.tendon_force_at_toe_end;
  if (c.tendon_curviness >= 0.0) s.tendon_curviness = c.tendon_curviness;
  return s;
}

}  // namespace

OpensimMuscle::OpensimMuscle(const model::Muscle& muscle, const model::Compat& compat)
    : p_(muscle.properties),
      thelen_(model::thelen_parameters(p_)),
      normalized_pennation_(compat.normalized_pennation) {
  height_m_ = p_.optimal_fiber_length_m * std::sin(p_.pennation_at_optimal_rad);
  shortest_m_ = height_m_ > 0.0 ? height_m_ / std::sin(p_.max_pennation_rad) : 0.0;
  least_cosine_ = std::max(0.0, std::cos(p_.max_pennation_rad));
  tendon_strain_ = p_.max_tendon_strain;
  if (const auto* millard = std::get_if<model::MillardCurves>(&p_.curves)) {
    kind_ = Kind::millard;
    millard_.emplace(shape_of(*millard));
    damping_ = millard->fiber_damping;
    tendon_strain_ = millard->tendon_strain_at_one_force;
    rigid_tendon_ = millard->ignore_tendon_compliance;
    shortest_m_ = std::max(shortest_m_, millard->active_min_length * p_.optimal_fiber_length_m);
  } else if (const auto* de_groote = std::get_if<model::DeGrooteCurves>(&p_.curves)) {
    kind_ = Kind::de_groote;
    width_ = de_groote->active_width_scale;
    damping_ = de_groote->fiber_damping;
    tendon_strain_ = de_groote->tendon_strain_at_one_force;
    rigid_tendon_ = de_groote->ignore_tendon_compliance;
  } else {
    own_curves_ = muscle.class_name.starts_with("Thelen2003");
    passive_rate_ = p_.passive_shape / p_.max_muscle_strain;
    passive_scale_ = muscle::thelen_passive_scale(p_.passive_shape);
  }
}

double OpensimMuscle::cos_pennation(double fiber_length_m) const {
  if (!(height_m_ > 0.0)) return 1.0;
  const double sine = std::min(1.0, height_m_ / std::max(fiber_length_m, 1e-300));
  return std::max(std::sqrt((1.0 - sine) * (1.0 + sine)), least_cosine_);
}

OpensimMuscle::Curve OpensimMuscle::active_length(double l) const {
  switch (kind_) {
    case Kind::millard: {
      const auto point = millard_->force_length()(l);
      return {point.value, point.slope};
    }
    case Kind::de_groote: {
      const auto point = muscle::de_groote_force_length<double>((l - 1.0) / width_ + 1.0);
      return {point.value, point.slope / width_};
    }
    case Kind::thelen:
      break;
  }
  const double f = std::exp(-(l - 1.0) * (l - 1.0) / p_.active_shape);
  return {f, -2.0 * (l - 1.0) / p_.active_shape * f};
}

double OpensimMuscle::velocity(double activation, double v) const {
  switch (kind_) {
    case Kind::millard:
      return millard_->force_velocity()(v).value;
    case Kind::de_groote:
      return muscle::de_groote_force_velocity<double>(v).value;
    case Kind::thelen:
      break;
  }
  return muscle::thelen_force_velocity(thelen_, activation, v);
}

OpensimMuscle::Curve OpensimMuscle::passive(double l) const {
  switch (kind_) {
    case Kind::millard: {
      const auto point = millard_->passive()(l);
      return {point.value, point.slope};
    }
    case Kind::de_groote: {
      const auto& c = std::get<model::DeGrooteCurves>(p_.curves);
      if (c.ignore_passive_fiber_force) return {};
      const auto point =
          muscle::de_groote_passive<double>(l, c.passive_fiber_strain_at_one_force, 4.0);
      return {point.value, point.slope};
    }
    case Kind::thelen:
      break;
  }
  const auto point = muscle::thelen_passive_at<double>(l, passive_rate_, passive_scale_);
  return {point.value, point.slope};
}

OpensimMuscle::Curve OpensimMuscle::tendon(double normalized) const {
  const double strain = normalized - 1.0;
  switch (kind_) {
    case Kind::millard: {
      const auto point = millard_->tendon()(strain / tendon_strain_);
      return {point.value, point.slope / tendon_strain_};
    }
    case Kind::de_groote: {
      const auto point = muscle::de_groote_tendon<double>(strain, tendon_strain_);
      return {point.value, point.slope};
    }
    case Kind::thelen:
      break;
  }
  const auto point = muscle::thelen_tendon<double>(strain, tendon_strain_);
  return {point.value, point.slope};
}

double OpensimMuscle::optimal_force(double length_m, double velocity_mps) const {
  const muscle::RigidTendonFiber fiber =
      muscle::rigid_tendon_fiber(thelen_, length_m, velocity_mps);
  if (fiber.at_minimum || fiber.fiber_length_m <= (kind_ == Kind::millard ? shortest_m_ : 0.0))
    return 0.0;
  const double l = fiber.fiber_length_m / p_.optimal_fiber_length_m;
  const double v =
      fiber.fiber_velocity_mps / (p_.optimal_fiber_length_m * p_.max_contraction_velocity);
  double cosine = fiber.cos_pennation;
  if (kind_ == Kind::millard && normalized_pennation_) cosine = cos_pennation(l);
  return p_.max_isometric_force_n * active_length(l).value * std::max(0.0, velocity(1.0, v)) *
         cosine;
}

OpensimMuscle::State OpensimMuscle::equilibrium(double activation,
                                                double length_m,
                                                double velocity_mps) const {
  const double fmax = p_.max_isometric_force_n;
  const double lopt = p_.optimal_fiber_length_m;
  const double slack = p_.tendon_slack_length_m;
  const double vmax = p_.max_contraction_velocity * lopt;
  State s;
  double fl = 0.0, fv = 1.0, speed = 0.0, cosine = 1.0;
  Curve active, rest, series;
  const auto place = [&](double l) {
    s.fiber_length_m = l;
    cosine = cos_pennation(l);
    s.tendon_length_m = length_m - l * cosine;
    active = active_length(l / lopt);
    rest = passive(l / lopt);
    series = tendon(s.tendon_length_m / slack);
    fl = active.value;
  };
  const auto forces = [&] {
    s.active_force_n = fmax * activation * fl * fv;
    s.passive_force_n = fmax * (rest.value + damping_ * speed);
    s.fiber_force_n = s.active_force_n + s.passive_force_n;
    s.tendon_force_n = fmax * series.value;
    return s.fiber_force_n * cosine - s.tendon_force_n;
  };
  // Stiffnesses of the fiber along the tendon and of the tendon.
  struct Stiffness {
    double fiber_by_length = 0.0, fiber_along = 0.0, tendon = 0.0, tendon_by_fiber = 0.0;
  };
  const auto stiffness = [&] {
    Stiffness k;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    // Without pennation the fiber may be squeezed to no length at all.
    const double angle_by_length =
        sine > 0.0 && cosine > 0.0 ? -sine / (s.fiber_length_m * cosine) : 0.0;
    const double fiber = fmax * (activation * active.slope * fv + rest.slope) / lopt;
    k.fiber_by_length = fiber * cosine - s.fiber_force_n * sine * angle_by_length;
    // d(l cos a)/dl = cos a - l sin a da/dl
    const double along_by_length = cosine - s.fiber_length_m * sine * angle_by_length;
    k.fiber_along = k.fiber_by_length / along_by_length;
    k.tendon = fmax * series.slope / slack;
    k.tendon_by_fiber = -k.tendon * along_by_length;
    return k;
  };
  const auto share_velocity = [&](const Stiffness& k) {
    // Millard's muscle balances at rest; its fiber's velocity then follows from the forces.
    if (kind_ == Kind::millard || std::abs(velocity_mps) < 1e-15) return;
    double tendon_speed = velocity_mps;
    const double sum = k.fiber_along + k.tendon;
    if (std::abs(sum) > 1e-15 && s.tendon_length_m > slack)
      tendon_speed = k.fiber_along / sum * velocity_mps;
    s.fiber_velocity_mps = (velocity_mps - tendon_speed) * cosine;
    speed = s.fiber_velocity_mps / vmax;
    fv = velocity(activation, speed);
  };
  if (rigid_tendon_) return at_fiber_length(activation, shortest_m_, length_m, velocity_mps);
  const double along = length_m - 1.01 * slack;
  double l = std::max(along > 0.0 ? std::hypot(height_m_, along) : shortest_m_, shortest_m_);
  place(l);
  (void)forces();
  share_velocity(stiffness());
  double error = forces();
  Stiffness k = stiffness();
  const double tolerance = 1e-8 * fmax;
  int iterations = 0;
  for (; std::abs(error) > tolerance && iterations < 200; ++iterations) {
    const double before = error;
    const double from = l;
    const double slope = k.fiber_by_length - k.tendon_by_fiber;
    if (from <= shortest_m_ && before / slope > 0.0) break;  // it would shorten further
    for (double part = 1.0;; part *= 0.5) {
      const double step = -part * before / slope;
      l = std::max(std::abs(step) > 1e-15 ? from + step : from - std::copysign(1.5e-8, step),
                   shortest_m_);
      place(l);
      error = forces();
      if (std::abs(error) < std::abs(before) || part <= 1.5e-8 || std::abs(step) <= 1e-15) break;
    }
    k = stiffness();
    share_velocity(k);
  }
  const bool converged = std::abs(error) <= tolerance || l <= shortest_m_;
  s = at_fiber_length(activation, l, length_m, velocity_mps);
  s.converged = converged;
  return s;
}

double OpensimMuscle::velocity_of(double activation, double strength, double force) const {
  switch (kind_) {
    case Kind::millard:
      return millard_->force_velocity().solve(strength, damping_, force);
    case Kind::de_groote:
      return muscle::solve_de_groote_velocity(strength, damping_, force);
    case Kind::thelen:
      break;
  }
  return muscle::thelen_fiber_velocity(thelen_, activation, force / strength);
}

OpensimMuscle::State OpensimMuscle::at_fiber_length(double activation,
                                                    double fiber_length_m,
                                                    double length_m,
                                                    double velocity_mps) const {
  const double fmax = p_.max_isometric_force_n;
  const double vmax = p_.max_contraction_velocity * p_.optimal_fiber_length_m;
  const double a = std::clamp(activation, p_.minimum_activation, 1.0);
  State s;
  if (rigid_tendon_) {
    const double along = length_m - p_.tendon_slack_length_m;
    fiber_length_m = along > 0.0 ? std::hypot(height_m_, along) : shortest_m_;
  }
  s.fiber_length_m = std::max(fiber_length_m, shortest_m_);
  const double l = s.fiber_length_m / p_.optimal_fiber_length_m;
  const double cosine = cos_pennation(s.fiber_length_m);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  s.pennation_rad = std::atan2(sine, cosine);
  s.tendon_length_m = length_m - s.fiber_length_m * cosine;
  const double strength = a * active_length(l).value;
  const double rest = passive(l).value;
  const double series =
      rigid_tendon_ ? 0.0 : tendon(s.tendon_length_m / p_.tendon_slack_length_m).value;
  double v = 0.0;
  if (rigid_tendon_) {
    v = velocity_mps * cosine / vmax;
  } else if (strength > 0.0) {
    v = velocity_of(a, strength, series / cosine - rest);
  }
  s.tendon_force_n = fmax * series;
  s.elastic_force_n = fmax * rest;
  if (s.fiber_length_m <= shortest_m_ && v <= 0.0) {
    s.passive_force_n = kind_ == Kind::thelen ? s.elastic_force_n : 0.0;
    s.tendon_velocity_mps = velocity_mps;
    return s;
  }
  s.fiber_velocity_mps = v * vmax;
  if (sine > 0.0) s.pennation_rate_radps = -s.fiber_velocity_mps / s.fiber_length_m * sine / cosine;
  s.tendon_velocity_mps = rigid_tendon_ ? 0.0 : velocity_mps - s.fiber_velocity_mps / cosine;
  s.active_force_n = rigid_tendon_ || !(strength > 0.0)
                         ? fmax * strength * velocity(a, v)
                         : fmax * (series / cosine - rest - damping_ * v);
  s.passive_force_n = s.elastic_force_n + fmax * damping_ * v;
  s.fiber_force_n = s.active_force_n + s.passive_force_n;
  if (rigid_tendon_) {
    if (s.fiber_force_n < 0.0) {
      // Damping does not push the tendon.
      s.passive_force_n = -s.active_force_n;
      s.fiber_force_n = 0.0;
    }
    s.tendon_force_n = s.fiber_force_n * cosine;
  }
  return s;
}

}  // namespace myoid::forces
