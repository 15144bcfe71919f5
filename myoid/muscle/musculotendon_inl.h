#pragma once

// The bodies of musculotendon.h's templates; include that.

#include <cmath>
#include <type_traits>

#include "myoid/muscle/musculotendon.h"
#include "myoid/muscle/musculotendon_elements.h"

namespace myoid::muscle {
namespace musculotendon_detail {

/// What every mode needs at one instant; forces over F_max, velocities over v_max.
template <typename T>
struct Instant {
  T length_m{};
  Reach<T> reach{};
  T strain{};  ///< Of the tendon.
  CurvePoint<T> length{}, velocity{}, passive{}, tendon{};
  T strength{};  ///< a f_l
  T speed{};     ///< v / v_max
  T viscous{};   ///< Mode `rigid`: the damper's force over F_max.
  bool floored = false;
};

template <typename T>
void contract(const Musculotendon<T>& unit, const MusculotendonInput<T>& input, Instant<T>& now) {
  now.length = length_multiplier(unit, input.activation, now.length_m);
  now.strength = input.activation * now.length.value;
  if (unit.undamped_equilibrium() && value_of(now.strength) < kLeastStrength) {
    now.strength = T(kLeastStrength);
    now.floored = true;
  }
  now.passive = passive_law(unit, now.length_m);
}

/// How much of an instant is wanted: what an integrator needs, or all of it.
enum class Depth { rate, all };

/// The equilibrium's velocity, with its derivatives: one Newton step in T from the solution in
/// numbers, whose residual in T carries them (implicit function theorem).
template <typename T>
void solve_speed(const Musculotendon<T>& unit,
                 const T& activation,
                 const T& force,
                 Depth depth,
                 Instant<T>& now) {
  const T& damping = unit.parameters().damping;
  const VelocityHyperbola<T>& h = unit.hyperbola();
  const double speed =
      solve_velocity_law(unit.laws().velocity,
                         {value_of(h.concentric_curvature), value_of(h.eccentric_curvature_product),
                          value_of(h.eccentric_plateau), value_of(h.tangent_from), h.tangent_below},
                         unit.millard(), value_of(activation), value_of(now.strength),
                         value_of(damping), value_of(force));
  now.speed = T(speed);
  if constexpr (std::is_same_v<T, double>) {
    if (depth == Depth::all) now.velocity = velocity_law(unit, activation, now.speed);
  } else {
    now.velocity = velocity_law(unit, activation, now.speed);
    const T miss = force - now.strength * now.velocity.value - damping * now.speed;
    now.speed =
        now.speed + miss / T(value_of(now.strength) * now.velocity.slope + value_of(damping));
    if (depth == Depth::all) now.velocity = velocity_law(unit, activation, now.speed);
  }
}

template <typename T>
Instant<T> instant(const Musculotendon<T>& unit,
                   const MusculotendonInput<T>& input,
                   const MusculotendonState<T>& state,
                   Depth depth) {
  using std::sqrt;
  const MusculotendonParameters<T>& p = unit.parameters();
  const T& slack_length = p.hill.tendon_slack_length_m;
  Instant<T> now;
  if (unit.laws().mode == TendonMode::rigid) {
    const T along = input.length_m - slack_length;
    now.length_m = unit.shortest_fiber_m();
    now.reach = reach(unit, now.length_m);
    if (value_of(along) > value_of(now.reach.along_m)) {
      const T& h = unit.height_m();
      now.length_m = value_of(h) == 0.0 ? along : sqrt(along * along + h * h);
      now.reach = {along, along / now.length_m};
      now.speed = input.velocity_mps * now.reach.cosine / p.hill.max_shortening_speed_mps;
      contract(unit, input, now);
      now.velocity = velocity_law(unit, input.activation, now.speed);
      const T pull = now.strength * now.velocity.value + now.passive.value;
      const T total = pull + p.damping * now.speed;
      if (value_of(total) > 0.0) {
        now.viscous = p.damping * now.speed;
        now.tendon.value = total * now.reach.cosine;
      } else {  // a tendon does not push: the damper gives way
        now.viscous = -pull;
      }
    }
    return now;
  }
  now.length_m = state.fiber_length_m;
  now.reach = reach(unit, now.length_m);
  now.strain = (input.length_m - now.reach.along_m) / slack_length - T(1.0);
  now.tendon = tendon_law(unit, now.strain);
  contract(unit, input, now);
  if (unit.laws().mode == TendonMode::mass) {
    now.speed = state.fiber_velocity_mps / p.hill.max_shortening_speed_mps;
    now.velocity = velocity_law(unit, input.activation, now.speed);
  } else {
    const T force = now.tendon.value / now.reach.cosine - now.passive.value;
    solve_speed(unit, input.activation, force, depth, now);
  }
  return now;
}

/// (F_t / cos(alpha) - F_m) / F_max.
template <typename T>
T imbalance(const Musculotendon<T>& unit, const Instant<T>& now) {
  return now.tendon.value / now.reach.cosine - now.strength * now.velocity.value -
         now.passive.value - unit.parameters().damping * now.speed;
}

}  // namespace musculotendon_detail

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
    rate.fiber_velocity_rate_mps2 =
        detail::imbalance(unit, now) * p.hill.max_isometric_force_n / p.muscle_mass_kg;
  }
  return rate;
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
  o.fiber_velocity_mps = mode == TendonMode::mass ? state.fiber_velocity_mps
                                                  : now.speed * p.hill.max_shortening_speed_mps;
  o.cos_pennation = now.reach.cosine;
  o.tendon_length_m = input.length_m - now.reach.along_m;
  o.tendon_velocity_mps = input.velocity_mps - o.fiber_velocity_mps / now.reach.cosine;
  o.length_multiplier = now.length.value;
  o.velocity_multiplier = now.velocity.value;
  o.active_force_n = now.strength * now.velocity.value * f_max;
  o.passive_force_n = now.passive.value * f_max;
  o.viscous_force_n =
      mode == TendonMode::rigid ? now.viscous * f_max : unit.damping_nspm() * o.fiber_velocity_mps;
  o.fiber_force_n = o.active_force_n + o.passive_force_n + o.viscous_force_n;
  o.tendon_force_n = now.tendon.value * f_max;
  o.active_power_w = -o.active_force_n * o.fiber_velocity_mps;
  o.passive_power_w = -o.passive_force_n * o.fiber_velocity_mps;
  o.viscous_power_w = -o.viscous_force_n * o.fiber_velocity_mps;
  o.tendon_power_w = -o.tendon_force_n * o.tendon_velocity_mps;
  o.musculotendon_power_w = -o.tendon_force_n * input.velocity_mps;
  o.passive_energy_j = detail::passive_energy(unit, now.length_m);
  o.kinetic_power_w = T(0.0);
  o.kinetic_energy_j = T(0.0);
  if (mode == TendonMode::rigid) {
    o.tendon_velocity_mps = T(0.0);
    o.tendon_power_w = T(0.0);
    o.tendon_energy_j = T(0.0);
  } else {
    o.tendon_energy_j = detail::tendon_energy(unit, now.strain);
    o.tendon_stiffness_npm =
        value_of(f_max) * now.tendon.slope / value_of(p.hill.tendon_slack_length_m);
  }
  if (mode == TendonMode::mass) {
    o.fiber_acceleration_mps2 = detail::imbalance(unit, now) * f_max / p.muscle_mass_kg;
    o.kinetic_power_w = -p.muscle_mass_kg * o.fiber_velocity_mps * o.fiber_acceleration_mps2;
    o.kinetic_energy_j = T(0.5) * p.muscle_mass_kg * o.fiber_velocity_mps * o.fiber_velocity_mps;
  }
  const double share = now.floored ? 0.0 : value_of(input.activation) * now.length.slope;
  o.fiber_stiffness_npm = value_of(f_max) / value_of(p.hill.optimal_fiber_length_m) *
                          (share * value_of(now.velocity.value) + now.passive.slope);
  o.slack = !(value_of(now.tendon.value) > 0.0);
  o.at_shortest = !(value_of(now.length_m) > value_of(unit.shortest_fiber_m()));
  o.floored = now.floored;
  return o;
}

template <typename T>
MusculotendonState<T> equilibrium_state(const Musculotendon<T>& unit,
                                        const MusculotendonInput<T>& input) {
  namespace detail = musculotendon_detail;
  using std::sqrt;
  const MusculotendonParameters<T>& p = unit.parameters();
  const T& v_max = p.hill.max_shortening_speed_mps;
  if (unit.laws().mode == TendonMode::rigid) {
    const detail::Instant<T> now = detail::instant(unit, input, {}, detail::Depth::all);
    return {now.length_m, now.speed * v_max};
  }
  // A fiber of length l, while the tendon keeps its length.
  const auto steady = [&](const T& l) {
    detail::Instant<T> now;
    now.length_m = l;
    now.reach = detail::reach(unit, l);
    now.strain = (input.length_m - now.reach.along_m) / p.hill.tendon_slack_length_m - T(1.0);
    now.tendon = detail::tendon_law(unit, now.strain);
    detail::contract(unit, input, now);
    now.speed = input.velocity_mps * now.reach.cosine / v_max;
    now.velocity = detail::velocity_law(unit, input.activation, now.speed);
    return now;
  };
  const auto miss = [&](double l) { return value_of(detail::imbalance(unit, steady(T(l)))); };
  const auto state_at = [&](const T& l) {
    return MusculotendonState<T>{l, steady(l).speed * v_max};
  };

  // From the length at which the tendon is just slack, down to where it pulls more than the fiber.
  const T slack_along = input.length_m - p.hill.tendon_slack_length_m;
  T slack_length = unit.shortest_fiber_m();
  if (value_of(slack_along) > value_of(detail::reach(unit, slack_length).along_m)) {
    const T& h = unit.height_m();
    slack_length = value_of(h) == 0.0 ? slack_along : sqrt(slack_along * slack_along + h * h);
  }
  double high = value_of(slack_length);
  double low = high;
  if (miss(high) >= 0.0) {
    // Slack. Only a fiber whose springs push (De Groote's passive curve below 0.2 l0, the shortest
    // length) lies beyond.
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
