#pragma once

#include <Eigen/Core>

namespace myoid::muscle {

/// Time constants of the way from excitation to activation. That of the excitation is not given by
/// the source paper; 30 to 50 ms are usual.
struct ActivationTimes {
  double excitation_time_s = 0.040;    ///< tau_ne
  double activation_time_s = 0.015;    ///< tau_ac, while the activation rises
  double deactivation_time_s = 0.050;  ///< tau_deac, while it falls; 60 ms in old age
};

/// Throws InvalidInput unless all are positive and finite.
void validate(const ActivationTimes& times);

struct ActivationState {
  double filtered_excitation = 0.0;  ///< e
  double activation = 0.0;           ///< a
};

/// The state a time `interval_s` later, under a constant excitation u in 0..1:
///
///   de/dt = (u - e) / tau_ne,   da/dt = (e - a) / tau,   tau = tau_ac if e >= a, else tau_deac
///
/// e exactly; a exactly for an e held at its new value, hence to first order in the interval, and
/// stable for any interval (explicit Euler steps of 33 ms are not: tau_ac is 15 ms). Equation (1)
/// of the source paper.
[[nodiscard]] ActivationState step_activation(const ActivationState& state,
                                              double excitation,
                                              double interval_s,
                                              const ActivationTimes& times);

/// Activation over time, from excitation on a uniform clock; starts at rest with e = a = the first
/// excitation. Throws InvalidInput unless the rate is positive and the times are valid.
[[nodiscard]] Eigen::VectorXd activation_from_excitation(
    const Eigen::Ref<const Eigen::VectorXd>& excitation,
    double rate_hz,
    const ActivationTimes& times = {});

/// da/dt [1/s] of Thelen (2003): (u - a) / tau with tau = tau_ac (0.5 + 1.5 a) while u > a, and
/// tau_deac / (0.5 + 1.5 a) else. tau_ne is not used.
[[nodiscard]] double thelen_activation_rate(double excitation,
                                            double activation,
                                            const ActivationTimes& times);

/// da/dt [1/s] of De Groote et al. (2016), smooth in both arguments:
///   f = tanh(b (u - a)) / 2, z = 0.5 + 1.5 a,
///   da/dt = ((f + 1/2) / (tau_ac z) + (1/2 - f) z / tau_deac) (u - a).
/// b = 10 comes near the nominal time constants; b = 0.1 was published.
[[nodiscard]] double smooth_activation_rate(double excitation,
                                            double activation,
                                            const ActivationTimes& times,
                                            double steepness = 10.0);

/// Activation of the normalized EMG u of Lloyd & Besier (2003): (exp(A u) - 1) / (exp(A) - 1), with
/// shape A in (-3, 0]; linear at A = 0, where a series is used. 0 at u = 0, 1 at u = 1.
[[nodiscard]] double shaped_activation(double normalized_emg, double shape);

/// The second-order critically or over-damped response to the EMG envelope (Buchanan et al. 2004):
/// two lags with these time constants, gain 1 at rest, exact for an envelope that is held between
/// samples in each lag. Written with time constants, not with the recursion's coefficients, which
/// change their meaning with the rate. Starts at rest on the first value. Throws InvalidInput
/// unless the rate and the times are positive.
[[nodiscard]] Eigen::VectorXd two_lag_activation(const Eigen::Ref<const Eigen::VectorXd>& envelope,
                                                 double rate_hz,
                                                 double first_time_s,
                                                 double second_time_s);

}  // namespace myoid::muscle
