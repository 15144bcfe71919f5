#pragma once

// The bodies of musculotendon.h's templates; include that.

#include <cmath>
#include <type_traits>

#include "myoid/muscle/musculotendon.h"

namespace myoid::muscle {
namespace musculotendon_detail {

/// Stiffness [F_max / l0] of the spring at the shortest length.
inline constexpr double kLimitStiffness = 100;

/// Returns the curves of a unit. Without damping its equilibrium needs an invertible velocity law:
/// tangents below -v_max and above 95 % of the plateau, which Thelen's law has already.
template <typename T>
NormalizedCurves<T> unit_curves(const MusculotendonParameters<T>& p,
                                const MusculotendonLaws& laws,
                                const MillardShape& millard,
                                bool undamped) {
  CurveShape<T> shape = curve_shape(p, laws, millard);
  if (undamped && laws.velocity == VelocityLaw::hill) shape.hyperbola.tangent_from = T(0.95);
  shape.hyperbola.tangent_below = undamped;
  return {laws, shape};
}

/// The fiber's projection on the tendon, and cos(alpha) = 1 / (d along / d l_m).
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

/// Returns the length of the fiber minus its shortest, over l0: negative, or 0 above the shortest.
template <typename T>
T squeeze(const Musculotendon<T>& unit, const T& l) {
  if (!(value_of(l) < value_of(unit.shortest_fiber_m()))) return T(0.0);
  return (l - unit.shortest_fiber_m()) / unit.parameters().hill.optimal_fiber_length_m;
}

/// Returns the energy of the passive force and of the spring at the shortest length [J].
template <typename T>
T passive_energy_j(const Musculotendon<T>& unit, const T& l) {
  const HillParameters<T>& hill = unit.parameters().hill;
  const T push = squeeze(unit, l);
  return (unit.curves().passive_energy(l / hill.optimal_fiber_length_m) + T(0.5 * kLimitStiffness) * push * push) *
         hill.max_isometric_force_n * hill.optimal_fiber_length_m;
}

/// Geometry and forces of one instant, as every mode needs them; forces over F_max, velocities over v_max.
template <typename T>
struct Instant {
  T length_m{};
  Reach<T> reach{};
  T strain{};                                               ///< Strain of the tendon.
  CurvePoint<T> length{}, velocity{}, passive{}, tendon{};  ///< The first by l_m / l0.
  T strength{};                                             ///< a f_l
  T speed{};                                                ///< v / v_max
  T viscous{};                                              ///< Mode `rigid`: the damper's force over F_max.
  T activation{};
  T relative_length{};  ///< l_m over the optimal length at this activation.
  bool floored = false;

  [[nodiscard]] Activity<T> activity() const { return {activation, relative_length, length.value}; }
};

/// Returns the forces that depend on the fiber's length. The optimum is longer at low activation.
template <typename T>
void contract(const Musculotendon<T>& unit, const MusculotendonInput<T>& input, Instant<T>& now) {
  const MusculotendonParameters<T>& p = unit.parameters();
  const T& l0 = p.hill.optimal_fiber_length_m;
  const T longer = T(1.0) + p.optimal_length_shift * (T(1.0) - input.activation);
  now.activation = input.activation;
  if (unit.laws().velocity == VelocityLaw::soest && value_of(now.activation) < kSoestRest)
    now.activation = T(kSoestRest);
  now.relative_length = now.length_m / longer / l0;
  now.length = unit.curves().length(now.relative_length);
  now.length.slope /= value_of(longer);
  now.strength = now.activation * now.length.value;
  if (unit.undamped_equilibrium() && value_of(now.strength) < kLeastStrength) {
    now.strength = T(kLeastStrength);
    now.floored = true;
  }
  now.passive = unit.curves().passive(now.length_m / l0);
  if (value_of(now.length_m) < value_of(unit.shortest_fiber_m())) {
    now.passive.value = now.passive.value + T(kLimitStiffness) * squeeze(unit, now.length_m);
    now.passive.slope += kLimitStiffness;
  }
}

/// The part of an instant to compute: the rates for an integrator, or all quantities.
enum class Depth { rate, all };

/// Returns the equilibrium's velocity with its derivatives: one Newton step in T from the solution
/// in numbers, whose residual in T carries the derivatives (implicit function theorem).
template <typename T>
void solve_speed(const Musculotendon<T>& unit, const T& force, Depth depth, Instant<T>& now) {
  const T& damping = unit.parameters().damping;
  const double speed =
      unit.curves().solve_velocity(now.activity(), value_of(now.strength), value_of(damping), value_of(force));
  now.speed = T(speed);
  if constexpr (std::is_same_v<T, double>) {
    if (depth == Depth::all) now.velocity = unit.curves().velocity(now.activity(), now.speed);
  } else {
    now.velocity = unit.curves().velocity(now.activity(), now.speed);
    const T miss = force - now.strength * now.velocity.value - damping * now.speed;
    now.speed = now.speed + miss / T(value_of(now.strength) * now.velocity.slope + value_of(damping));
    if (depth == Depth::all) now.velocity = unit.curves().velocity(now.activity(), now.speed);
  }
}

/// Returns the fiber whose projection on the tendon is `along`, at least the shortest.
template <typename T>
T fiber_length(const Musculotendon<T>& unit, const T& along) {
  using std::sqrt;
  const T& shortest = unit.shortest_fiber_m();
  if (!(value_of(along) > value_of(reach(unit, shortest).along_m))) return shortest;
  const T& h = unit.height_m();
  return value_of(h) == 0.0 ? along : sqrt(along * along + h * h);
}

template <typename T>
Instant<T> rigid_instant(const Musculotendon<T>& unit, const MusculotendonInput<T>& input) {
  const MusculotendonParameters<T>& p = unit.parameters();
  const T along = input.length_m - p.hill.tendon_slack_length_m;
  Instant<T> now;
  now.length_m = fiber_length(unit, along);
  if (!(value_of(now.length_m) > value_of(unit.shortest_fiber_m()))) {
    now.reach = reach(unit, now.length_m);
    return now;
  }
  now.reach = {along, along / now.length_m};
  now.speed = input.velocity_mps * now.reach.cosine / p.hill.max_shortening_speed_mps;
  contract(unit, input, now);
  now.velocity = unit.curves().velocity(now.activity(), now.speed);
  const T pull = now.strength * now.velocity.value + now.passive.value;
  const T total = pull + p.damping * now.speed;
  if (value_of(total) > 0.0) {
    now.viscous = p.damping * now.speed;
    now.tendon.value = total * now.reach.cosine;
  } else {  // a tendon does not push: the damper gives way
    now.viscous = -pull;
  }
  return now;
}

/// Returns the tendon at a fiber length, and the fiber's geometry.
template <typename T>
Instant<T> stretched_tendon(const Musculotendon<T>& unit, const T& length_m, const T& fiber_length_m) {
  Instant<T> now;
  now.length_m = fiber_length_m;
  now.reach = reach(unit, now.length_m);
  const T& slack_length = unit.parameters().hill.tendon_slack_length_m;
  now.strain = (length_m - now.reach.along_m) / slack_length - T(1.0);
  now.tendon = unit.curves().tendon(now.strain);
  return now;
}

/// Returns tendon and fiber at a fiber length, without the velocity.
template <typename T>
Instant<T> stretched(const Musculotendon<T>& unit, const MusculotendonInput<T>& input, const T& fiber_length_m) {
  Instant<T> now = stretched_tendon(unit, input.length_m, fiber_length_m);
  contract(unit, input, now);
  return now;
}

template <typename T>
Instant<T> instant(const Musculotendon<T>& unit,
                   const MusculotendonInput<T>& input,
                   const MusculotendonState<T>& state,
                   Depth depth) {
  if (unit.laws().mode == TendonMode::rigid) return rigid_instant(unit, input);
  Instant<T> now = stretched(unit, input, state.fiber_length_m);
  if (unit.laws().mode == TendonMode::mass) {
    now.speed = state.fiber_velocity_mps / unit.parameters().hill.max_shortening_speed_mps;
    now.velocity = unit.curves().velocity(now.activity(), now.speed);
  } else {
    const T force = now.tendon.value / now.reach.cosine - now.passive.value;
    solve_speed(unit, force, depth, now);
  }
  return now;
}

/// Returns a fiber of length l that moves with the path, while the tendon keeps its length.
template <typename T>
Instant<T> steady_instant(const Musculotendon<T>& unit, const MusculotendonInput<T>& input, const T& l) {
  Instant<T> now = stretched(unit, input, l);
  now.speed = input.velocity_mps * now.reach.cosine / unit.parameters().hill.max_shortening_speed_mps;
  now.velocity = unit.curves().velocity(now.activity(), now.speed);
  return now;
}

/// Returns (F_t / cos(alpha) - F_m) / F_max.
template <typename T>
T imbalance(const Musculotendon<T>& unit, const Instant<T>& now) {
  return now.tendon.value / now.reach.cosine - now.strength * now.velocity.value - now.passive.value -
         unit.parameters().damping * now.speed;
}

}  // namespace musculotendon_detail

template <typename T>
Musculotendon<T>::Musculotendon(const MusculotendonParameters<T>& parameters,
                                const MusculotendonLaws& laws,
                                const MillardShape& millard)
    : p_(parameters),
      undamped_equilibrium_(laws.mode == TendonMode::equilibrium && value_of(parameters.damping) == 0.0),
      curves_(musculotendon_detail::unit_curves(p_, laws, millard, undamped_equilibrium_)) {
  using std::sin;
  validate(lifted<double>(p_), laws);
  const HillParameters<T>& hill = p_.hill;
  shortest_ = T(0.01) * hill.optimal_fiber_length_m;
  height_ = T(0.0);
  if (value_of(p_.pennation_at_optimal_rad) > 0.0) {
    height_ = hill.optimal_fiber_length_m * sin(p_.pennation_at_optimal_rad);
    const double least = kLeastPennationCosine;
    const T most_pennate = height_ / T(std::sqrt(1.0 - least * least));
    if (value_of(most_pennate) > value_of(shortest_)) shortest_ = most_pennate;
  }
  damping_ = p_.damping * hill.max_isometric_force_n / hill.max_shortening_speed_mps;
}

template <typename T>
MusculotendonRate<T> musculotendon_rate(const Musculotendon<T>& unit,
                                        const MusculotendonInput<T>& input,
                                        const MusculotendonState<T>& state) {
  namespace detail = musculotendon_detail;
  const detail::Instant<T> now = detail::instant(unit, input, state, detail::Depth::rate);
  const MusculotendonParameters<T>& p = unit.parameters();
  MusculotendonRate<T> rate{now.speed * p.hill.max_shortening_speed_mps, T(0.0),
                            now.tendon.value * p.hill.max_isometric_force_n};
  if (unit.laws().mode == TendonMode::mass) {
    rate.fiber_length_rate_mps = state.fiber_velocity_mps;
    rate.fiber_velocity_rate_mps2 = detail::imbalance(unit, now) * p.hill.max_isometric_force_n / p.muscle_mass_kg;
  }
  return rate;
}

template <typename T>
T tendon_force_n(const Musculotendon<T>& unit, const MusculotendonInput<T>& input, const MusculotendonState<T>& state) {
  namespace detail = musculotendon_detail;
  const T force = unit.laws().mode == TendonMode::rigid
                      ? detail::rigid_instant(unit, input).tendon.value
                      : detail::stretched_tendon(unit, input.length_m, state.fiber_length_m).tendon.value;
  return force * unit.parameters().hill.max_isometric_force_n;
}

template <typename T>
MusculotendonOutput<T> musculotendon_output(const Musculotendon<T>& unit,
                                            const MusculotendonInput<T>& input,
                                            const MusculotendonState<T>& state) {
  namespace detail = musculotendon_detail;
  const detail::Instant<T> now = detail::instant(unit, input, state, detail::Depth::all);
  const MusculotendonParameters<T>& p = unit.parameters();
  const T& f_max = p.hill.max_isometric_force_n;
  const TendonMode mode = unit.laws().mode;
  MusculotendonOutput<T> o;
  o.fiber_length_m = now.length_m;
  o.fiber_velocity_mps =
      mode == TendonMode::mass ? state.fiber_velocity_mps : now.speed * p.hill.max_shortening_speed_mps;
  o.cos_pennation = now.reach.cosine;
  o.tendon_length_m = input.length_m - now.reach.along_m;
  o.tendon_velocity_mps = input.velocity_mps - o.fiber_velocity_mps / now.reach.cosine;
  o.length_multiplier = now.length.value;
  o.velocity_multiplier = now.velocity.value;
  o.active_force_n = now.strength * now.velocity.value * f_max;
  o.passive_force_n = now.passive.value * f_max;
  o.viscous_force_n = mode == TendonMode::rigid ? now.viscous * f_max : unit.damping_nspm() * o.fiber_velocity_mps;
  o.fiber_force_n = o.active_force_n + o.passive_force_n + o.viscous_force_n;
  o.tendon_force_n = now.tendon.value * f_max;
  o.power_w.active = -o.active_force_n * o.fiber_velocity_mps;
  o.power_w.passive = -o.passive_force_n * o.fiber_velocity_mps;
  o.power_w.viscous = -o.viscous_force_n * o.fiber_velocity_mps;
  o.power_w.tendon = -o.tendon_force_n * o.tendon_velocity_mps;
  o.power_w.musculotendon = -o.tendon_force_n * input.velocity_mps;
  o.energy_j.passive = detail::passive_energy_j(unit, now.length_m);
  o.power_w.kinetic = T(0.0);
  o.energy_j.kinetic = T(0.0);
  if (mode == TendonMode::rigid) {
    o.tendon_velocity_mps = T(0.0);
    o.power_w.tendon = T(0.0);
    o.energy_j.tendon = T(0.0);
  } else {
    o.energy_j.tendon = unit.curves().tendon_energy(now.strain) * f_max * p.hill.tendon_slack_length_m;
    o.tendon_stiffness_npm = value_of(f_max) * now.tendon.slope / value_of(p.hill.tendon_slack_length_m);
  }
  if (mode == TendonMode::mass) {
    o.fiber_acceleration_mps2 = detail::imbalance(unit, now) * f_max / p.muscle_mass_kg;
    o.power_w.kinetic = -p.muscle_mass_kg * o.fiber_velocity_mps * o.fiber_acceleration_mps2;
    o.energy_j.kinetic = T(0.5) * p.muscle_mass_kg * o.fiber_velocity_mps * o.fiber_velocity_mps;
  }
  const double share = now.floored ? 0.0 : value_of(now.activation) * now.length.slope;
  o.fiber_stiffness_npm = value_of(f_max) / value_of(p.hill.optimal_fiber_length_m) *
                          (share * value_of(now.velocity.value) + now.passive.slope);
  o.slack = !(value_of(now.tendon.value) > 0.0);
  o.at_shortest = !(value_of(now.length_m) > value_of(unit.shortest_fiber_m()));
  o.floored = now.floored;
  return o;
}

template <typename T>
MusculotendonState<T> equilibrium_state(const Musculotendon<T>& unit, const MusculotendonInput<T>& input) {
  namespace detail = musculotendon_detail;
  const T& v_max = unit.parameters().hill.max_shortening_speed_mps;
  if (unit.laws().mode == TendonMode::rigid) {
    const detail::Instant<T> now = detail::rigid_instant(unit, input);
    return {now.length_m, now.speed * v_max};
  }
  const auto steady = [&](const T& l) { return detail::steady_instant(unit, input, l); };
  const auto miss = [&](double l) { return value_of(detail::imbalance(unit, steady(T(l)))); };
  const auto state_at = [&](const T& l) { return MusculotendonState<T>{l, steady(l).speed * v_max}; };

  // From the length at which the tendon is just slack, down to where it pulls more than the fiber.
  const T slack_length = detail::fiber_length(unit, T(input.length_m - unit.parameters().hill.tendon_slack_length_m));
  double high = value_of(slack_length);
  double low = high;
  if (miss(high) >= 0.0) {
    // Slack. Only a fiber whose springs push (De Groote's passive curve below 0.2 l0, the shortest length) lies beyond.
    const auto pushes = [&](double l) { return value_of(steady(T(l)).passive.value) < 0.0; };
    if (miss(high) == 0.0 || !pushes(high)) return state_at(slack_length);
    while (pushes(high)) high *= 1.1;
    if (miss(high) > 0.0) return state_at(slack_length);
  } else {
    low = 0.5 * value_of(unit.shortest_fiber_m());
    while (low > 1e-6 * high && !(miss(low) > 0.0)) low *= 0.5;
    if (!(miss(low) > 0.0)) return state_at(unit.shortest_fiber_m());
  }

  // Bisection keeps a fiber that would lengthen at `low` and shorten at `high`: a stable balance.
  double l = 0.5 * (low + high);
  while (l > low && l < high) {
    (miss(l) > 0.0 ? low : high) = l;
    l = 0.5 * (low + high);
  }
  if constexpr (std::is_same_v<T, double>) {
    return state_at(l);
  } else {
    const double h = 1e-6 * l;
    const double slope = (miss(l + h) - miss(l - h)) / (2.0 * h);
    return state_at(T(l) - detail::imbalance(unit, steady(T(l))) / T(slope));
  }
}

}  // namespace myoid::muscle
