#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "myoid/muscle/activation.h"

namespace myoid::test {

/// Activation dynamics under an excitation that is held, in closed form: the oracle of integrators.

namespace activation_steps {

using Point = muscle::ActivationPoint<double>;
using Dynamics = muscle::ActivationDynamics<double>;

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Runs two lags with constants tau_e, tau_a for a time t at constant u. e = u + (e0 - u) E_e, and
/// the lead d = e - a follows d' = c E_e - d / tau_a with c = (u - e0) / tau_e:
///   d = E_a d0 + c (E_a - E_e) / k,   k = 1/tau_e - 1/tau_a
inline Point two_lags(double u, const Point& from, double tau_e, double tau_a, double t) {
  const double decay_e = std::exp(-t / tau_e);
  const double decay_a = std::exp(-t / tau_a);
  const double e = u + (from.filtered_excitation - u) * decay_e;
  const double k = 1.0 / tau_e - 1.0 / tau_a;
  const double c = (u - from.filtered_excitation) / tau_e;
  const double lead = from.filtered_excitation - from.activation;
  double share = (decay_a - decay_e) / k;
  if (std::abs(k * t) < 1e-8) {
    share = decay_a * t * (1.0 - 0.5 * k * t);
  } else if (std::abs(k * t) < 1.0) {
    share = decay_a * -std::expm1(-k * t) / k;
  }
  return {e, e - decay_a * lead - c * share};
}

/// Returns the time at which e - a changes sign, or infinity. d = 0 <=> d0 + c (1 - exp(-k t)) / k = 0.
inline double switch_time(double u, const Point& from, double tau_e, double tau_a) {
  const double c = (u - from.filtered_excitation) / tau_e;
  const double lead = from.filtered_excitation - from.activation;
  if (!(lead * c < 0.0)) return kNever;
  const double k = 1.0 / tau_e - 1.0 / tau_a;
  const double ratio = -lead / c;  // the positive value that (1 - exp(-k t)) / k must reach
  if (std::abs(k) * ratio < 1e-8) return ratio * (1.0 + 0.5 * k * ratio);
  const double argument = -k * ratio;
  return argument <= -1.0 ? kNever : -std::log1p(argument) / k;
}

/// Returns Thelen's lag under constant u. Falling, w = a - u is logistic. Rising, s = ln((u - a) /
/// (u - a0)) solves k s - 3/2 w0 (exp(s) - 1) = -t / tau, k = 1/2 + 3/2 u. The left side is
/// concave, so Newton from the left never passes the root.
inline double thelen(double u, double a, const Dynamics& d, double t) {
  const double k = 0.5 + 1.5 * u;
  if (u <= a) {
    const double w = a - u;
    const double e = std::exp(-k * t / d.deactivation_time_s);
    return u + k * w * e / (k + 1.5 * w * -std::expm1(-k * t / d.deactivation_time_s));
  }
  const double w = 1.5 * (u - a);
  const double target = -t / d.activation_time_s;
  double s = std::max(target / (k - w), (target - w) / k);
  for (int i = 0; i < 50; ++i) {
    const double step = (k * s - w * std::expm1(s) - target) / (k - w * std::exp(s));
    s -= step;
    if (std::abs(step) <= 1e-16 * (1.0 + std::abs(s))) break;
  }
  return u - (u - a) * std::exp(s);
}

inline double runge_kutta(double u, double a, const Dynamics& d, double t) {
  const double longest = std::min(d.activation_time_s, d.deactivation_time_s) / 2.0 / 20.0;
  const double steps = std::max(1.0, std::ceil(t / longest));
  const double h = t / steps;
  const auto rate = [&](double x) { return muscle::activation_rate<double>(d, u, {0.0, x}).activation; };
  for (double k = 0.0; k < steps; ++k) {
    const double k1 = rate(a);
    const double k2 = rate(a + 0.5 * h * k1);
    const double k3 = rate(a + 0.5 * h * k2);
    const double k4 = rate(a + h * k3);
    a += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    if (a == u) break;
  }
  return a;
}

}  // namespace activation_steps

/// Returns the state `interval_s` later under a constant excitation: exact to round-off for any
/// interval, in closed form (the switch of `two_lags` is located; the rise of `thelen` solves one
/// scalar equation). Only `de_groote` has no closed form and takes Runge-Kutta steps of at most a
/// twentieth of its shortest time constant, to 1e-7 of the activation's change.
inline muscle::ActivationPoint<double> step_activation(const muscle::ActivationDynamics<double>& d,
                                                       double u,
                                                       const muscle::ActivationPoint<double>& from,
                                                       double interval_s) {
  using namespace activation_steps;
  switch (d.law) {
    case muscle::ActivationLaw::envelope:
      return {u, u};
    case muscle::ActivationLaw::thelen:
      return {from.filtered_excitation, thelen(u, from.activation, d, interval_s)};
    case muscle::ActivationLaw::de_groote:
      return {from.filtered_excitation, runge_kutta(u, from.activation, d, interval_s)};
    case muscle::ActivationLaw::one_lag: {
      const double tau = u >= from.activation ? d.activation_time_s : d.deactivation_time_s;
      return {from.filtered_excitation, u + (from.activation - u) * std::exp(-interval_s / tau)};
    }
    case muscle::ActivationLaw::recursive:
      return two_lags(u, from, d.excitation_time_s, d.activation_time_s, interval_s);
    case muscle::ActivationLaw::two_lags: {
      // e approaches u monotonically, so that e - a changes sign at most once.
      const double lead = from.filtered_excitation - from.activation;
      const bool rises = lead > 0.0 || (lead == 0.0 && u >= from.filtered_excitation);
      const double tau = rises ? d.activation_time_s : d.deactivation_time_s;
      const double other = rises ? d.deactivation_time_s : d.activation_time_s;
      const double at = switch_time(u, from, d.excitation_time_s, tau);
      if (!(at < interval_s)) return two_lags(u, from, d.excitation_time_s, tau, interval_s);
      Point met = two_lags(u, from, d.excitation_time_s, tau, at);
      met.activation = met.filtered_excitation;
      return two_lags(u, met, d.excitation_time_s, other, interval_s - at);
    }
  }
  return from;
}

}  // namespace myoid::test
