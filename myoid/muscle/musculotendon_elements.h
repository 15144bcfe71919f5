#pragma once

// The elements of a musculotendon unit, each under the law chosen for it; part of musculotendon.h,
// include that.

#include <cmath>

#include "myoid/muscle/de_groote.h"
#include "myoid/muscle/force_length.h"
#include "myoid/muscle/musculotendon_unit.h"
#include "myoid/muscle/thelen_curves.h"

namespace myoid::muscle {
namespace musculotendon_detail {

inline constexpr double kLimitStiffness =
    100;  ///< [F_max / l0] of the spring at the shortest length.

/// The fiber's reach along the tendon, and what d(reach)/dl_m = 1 / cos(alpha) needs.
template <typename T>
struct Reach {
  T along_m{};
  T cosine{};
};

template <typename T>
Reach<T> reach(const Musculotendon<T>& unit, const T& l) {
  using std::sqrt;
  const T& h = unit.height_m();
  if (value_of(h) == 0.0) return {l, T(1.0)};
  const T& shortest = unit.shortest_fiber_m();
  if (value_of(l) >= value_of(shortest)) {
    const T along = sqrt(l * l - h * h);
    return {along, along / l};
  }
  const T along = sqrt(shortest * shortest - h * h);
  const T cosine = along / shortest;
  return {along + (l - shortest) / cosine, cosine};
}

template <typename T>
CurvePoint<T> length_multiplier(const Musculotendon<T>& unit, const T& activation, const T& l) {
  const MusculotendonParameters<T>& p = unit.parameters();
  const T& l0 = p.hill.optimal_fiber_length_m;
  const T shifted = l / (T(1.0) + p.optimal_length_shift * (T(1.0) - activation));
  switch (unit.laws().length) {
    case LengthLaw::gaussian: {
      const T& width = p.hill.force_length_width_m;
      const T f = force_length(shifted, l0, width);
      const double w = value_of(width);
      return {f, -2.0 * value_of(f) * value_of(shifted - l0) / (w * w) * value_of(l0)};
    }
    case LengthLaw::de_groote:
      return de_groote_force_length<T>(shifted / l0);
    case LengthLaw::millard:
      return unit.millard().force_length()(T(shifted / l0));
  }
  return {};
}

/// f_v over the velocity in v_max.
template <typename T>
CurvePoint<T> velocity_law(const Musculotendon<T>& unit, const T& activation, const T& velocity) {
  switch (unit.laws().velocity) {
    case VelocityLaw::hill:
      return velocity_multiplier<T>(unit.hyperbola(), velocity);
    case VelocityLaw::thelen: {
      const T speed = thelen_speed(activation);
      CurvePoint<T> point = velocity_multiplier<T>(unit.hyperbola(), velocity / speed);
      point.slope /= value_of(speed);
      return point;
    }
    case VelocityLaw::de_groote:
      return de_groote_force_velocity(velocity);
    case VelocityLaw::millard:
      return unit.millard().force_velocity()(velocity);
  }
  return {};
}

/// Passive force over F_max, with the spring at the shortest length; and, on demand, its energy
/// over F_max l0.
template <typename T>
CurvePoint<T> passive_law(const Musculotendon<T>& unit, const T& l) {
  const MusculotendonParameters<T>& p = unit.parameters();
  const T normalized = l / p.hill.optimal_fiber_length_m;
  CurvePoint<T> point{T(0.0), 0.0};
  switch (unit.laws().passive) {
    case PassiveLaw::none:
      break;
    case PassiveLaw::thelen:
      point = thelen_passive<T>(normalized, p.passive_strain, p.passive_shape);
      break;
    case PassiveLaw::de_groote:
      point = de_groote_passive<T>(normalized, p.passive_strain, p.passive_shape);
      break;
    case PassiveLaw::millard:
      point = unit.millard().passive()(normalized);
      break;
  }
  if (value_of(l) < value_of(unit.shortest_fiber_m())) {
    const T push = (l - unit.shortest_fiber_m()) / p.hill.optimal_fiber_length_m;
    point.value = point.value + T(kLimitStiffness) * push;
    point.slope += kLimitStiffness;
  }
  return point;
}

template <typename T>
T passive_energy(const Musculotendon<T>& unit, const T& l) {
  const MusculotendonParameters<T>& p = unit.parameters();
  const T normalized = l / p.hill.optimal_fiber_length_m;
  T energy(0.0);
  switch (unit.laws().passive) {
    case PassiveLaw::none:
      break;
    case PassiveLaw::thelen:
      energy = thelen_passive_energy<T>(normalized, p.passive_strain, p.passive_shape);
      break;
    case PassiveLaw::de_groote:
      energy = de_groote_passive_energy<T>(normalized, p.passive_strain, p.passive_shape);
      break;
    case PassiveLaw::millard:
      energy = unit.millard().passive().integral(normalized);
      break;
  }
  if (value_of(l) < value_of(unit.shortest_fiber_m())) {
    const T push = (l - unit.shortest_fiber_m()) / p.hill.optimal_fiber_length_m;
    energy = energy + T(0.5 * kLimitStiffness) * push * push;
  }
  return energy * p.hill.max_isometric_force_n * p.hill.optimal_fiber_length_m;
}

/// Tendon force over F_max at a strain.
template <typename T>
CurvePoint<T> tendon_law(const Musculotendon<T>& unit, const T& strain) {
  const T& e0 = unit.parameters().tendon_strain;
  if (value_of(strain) <= 0.0) return {T(0.0), 0.0};
  switch (unit.laws().tendon) {
    case TendonLaw::linear:
      return {strain / e0, 1.0 / value_of(e0)};
    case TendonLaw::thelen:
      return thelen_tendon(strain, e0);
    case TendonLaw::de_groote:
      return de_groote_tendon(strain, e0);
    case TendonLaw::millard: {
      CurvePoint<T> point = unit.millard().tendon()(T(strain / e0));
      point.slope /= value_of(e0);
      return point;
    }
  }
  return {};
}

template <typename T>
T tendon_energy(const Musculotendon<T>& unit, const T& strain) {
  const MusculotendonParameters<T>& p = unit.parameters();
  const T& e0 = p.tendon_strain;
  if (value_of(strain) <= 0.0) return T(0.0);
  T energy(0.0);
  switch (unit.laws().tendon) {
    case TendonLaw::linear:
      energy = T(0.5) * strain * strain / e0;
      break;
    case TendonLaw::thelen:
      energy = thelen_tendon_energy(strain, e0);
      break;
    case TendonLaw::de_groote:
      energy = de_groote_tendon_energy(strain, e0);
      break;
    case TendonLaw::millard:
      energy = unit.millard().tendon().integral(T(strain / e0)) * e0;
      break;
  }
  return energy * p.hill.max_isometric_force_n * p.hill.tendon_slack_length_m;
}

/// The velocity [v_max] at which strength f_v + damping v = force (all over F_max).
inline double solve_velocity_law(VelocityLaw law,
                                 const VelocityHyperbola<double>& hyperbola,
                                 const MillardCurves& millard,
                                 double activation,
                                 double strength,
                                 double damping,
                                 double force) {
  if (strength == 0.0) return force / damping;
  switch (law) {
    case VelocityLaw::hill:
      return solve_velocity(hyperbola, strength, damping, force);
    case VelocityLaw::thelen: {
      const double speed = thelen_speed(activation);
      return speed * solve_velocity(hyperbola, strength, damping * speed, force);
    }
    case VelocityLaw::de_groote:
      return solve_de_groote_velocity(strength, damping, force);
    case VelocityLaw::millard:
      return millard.force_velocity().solve(strength, damping, force);
  }
  return 0.0;
}

}  // namespace musculotendon_detail
}  // namespace myoid::muscle
