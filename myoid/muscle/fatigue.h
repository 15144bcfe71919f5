#pragma once

#include <cmath>
#include <string_view>

#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// Rates of the three-compartment fatigue model (Xia & Frey-Law 2008, J Biomech 41:3046-3052).
template <typename T = double>
struct FatigueRates {
  T fatigue_per_s{T(0.00912)};     ///< F: active to fatigued
  T recovery_per_s{T(0.00094)};    ///< R: fatigued to resting
  T rest_recovery_factor{T(1.0)};  ///< r: recovery is r R while the target is 0; 15 in 3CC-r
  T development_per_s{T(10.0)};    ///< LD: resting to active
  T relaxation_per_s{T(10.0)};     ///< LR: active to resting
};

/// Shares of the muscle; they add up to one.
template <typename T = double>
struct FatigueState {
  T active{T(0.0)};    ///< M_A
  T resting{T(1.0)};   ///< M_R
  T fatigued{T(0.0)};  ///< M_F
};

/// Throws InvalidInput, naming the field, unless all are finite and not negative, and development
/// and relaxation positive.
void validate(const FatigueRates<double>& rates);

/// Returns the right-hand side [1/s] under a target load in 0..1 of the fresh muscle's strength; its
/// three parts add up to zero:
///   dM_A = C - F M_A,   dM_R = -C + R' M_F,   dM_F = F M_A - R' M_F,
///   R' = r R while the target is 0, else R,
/// with the central drive's flow from resting to active
///   C = LD min(target - M_A, M_R) below the target, LR (target - M_A) above.
template <typename T>
[[nodiscard]] FatigueState<T> fatigue_rate(const FatigueRates<T>& rates,
                                           const T& target_load,
                                           const FatigueState<T>& state) {
  const T lacking = target_load - state.active;
  const T recruited = value_of(state.resting) > value_of(lacking) ? lacking : state.resting;
  const T drive = value_of(lacking) <= 0.0 ? rates.relaxation_per_s * lacking : rates.development_per_s * recruited;
  const T recovery =
      value_of(target_load) > 0.0 ? rates.recovery_per_s : rates.recovery_per_s * rates.rest_recovery_factor;
  const T tiring = rates.fatigue_per_s * state.active;
  const T recovering = recovery * state.fatigued;
  return {drive - tiring, recovering - drive, tiring - recovering};
}

/// Returns the remaining share of F_max: F_max(t) = F_max (1 - M_F).
template <typename T>
[[nodiscard]] T fatigue_capacity(const FatigueState<T>& state) {
  return T(1.0) - state.fatigued;
}

/// Returns the state `interval_s` later under a constant target load, by Runge-Kutta steps of at
/// most a twentieth of the fastest time constant (5 ms with LD = LR = 10 1/s), 3e-9 a step.
[[nodiscard]] FatigueState<double> step_fatigue(const FatigueRates<double>& rates,
                                                double target_load,
                                                const FatigueState<double>& state,
                                                double interval_s);

/// Returns rates for the elbow: "elbow" (Frey-Law, Looft & Heitsman 2012, both directions, r = 1),
/// "elbow_rest" (these rates with r = 15, Looft, Herkert & Frey-Law 2018), "elbow_flexor",
/// "elbow_extensor" (Rakshit, Xiang & Yang 2021). Throws InvalidInput with the list of names.
[[nodiscard]] FatigueRates<double> published_fatigue_rates(std::string_view name);

}  // namespace myoid::muscle
