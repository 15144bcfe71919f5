#pragma once

#include <cmath>

#include "myoid/ground/core/choice.h"
#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// The law by which activation follows excitation.
enum class ActivationLaw {
  envelope,   ///< a = u: the envelope is the activation, as in the source paper's experiment.
  two_lags,   ///< u -> e -> a, the source paper's equation (1).
  thelen,     ///< One lag whose time depends on a: Thelen (2003).
  de_groote,  ///< Thelen's, smooth in u - a: De Groote et al. (2016).
  recursive,  ///< Two lags, rising and falling alike: the recursive filter of Buchanan et al.
              ///< (2004).
  one_lag,    ///< One lag, rising and falling with its own time: calcium by Hatze (1981).
};
inline constexpr std::string_view kActivationLawNames[] = {"envelope",  "two_lags",  "thelen",
                                                           "de_groote", "recursive", "one_lag"};
constexpr ChoiceNames choice_names(ActivationLaw) { return kActivationLawNames; }

/// A law with its constants. `recursive` takes tau_ne and tau_ac for its two time constants,
/// `thelen`, `de_groote` and `one_lag` do not use tau_ne.
template <typename T = double>
struct ActivationDynamics {
  ActivationLaw law = ActivationLaw::two_lags;
  T excitation_time_s{0.040};    ///< tau_ne; not given by the source paper, 30 to 50 ms are usual.
  T activation_time_s{0.015};    ///< tau_ac
  T deactivation_time_s{0.050};  ///< tau_deac; 60 ms in old age.
  double steepness = 10.0;       ///< b of `de_groote`.
};

/// Throws InvalidInput unless all times and the steepness are positive and finite.
void validate(const ActivationDynamics<double>& dynamics);

/// The states e and a; a law of one state does not change e.
template <typename T = double>
struct ActivationPoint {
  T filtered_excitation{};  ///< e
  T activation{};           ///< a
};

/// States that the law integrates: 0, 1 (a) or 2 (e, then a).
[[nodiscard]] constexpr int state_size(ActivationLaw law) {
  switch (law) {
    case ActivationLaw::envelope:
      return 0;
    case ActivationLaw::thelen:
    case ActivationLaw::de_groote:
    case ActivationLaw::one_lag:
      return 1;
    case ActivationLaw::two_lags:
    case ActivationLaw::recursive:
      return 2;
  }
  return 0;
}

/// Returns the right-hand side (de/dt, da/dt) [1/s] under excitation u in 0..1:
///   two_lags:  (u - e) / tau_ne,  (e - a) / tau,  tau = tau_ac if e >= a, else tau_deac
///   thelen:    0,  (u - a) / (tau_ac z) if u > a, else (u - a) z / tau_deac,  z = 1/2 + 3/2 a
///   de_groote: 0,  ((f + 1/2) / (tau_ac z) + (1/2 - f) z / tau_deac) (u - a),
///              f = tanh(b (u - a)) / 2
///   recursive: (u - e) / tau_ne,  (e - a) / tau_ac
///   one_lag:   0,  (u - a) / tau,  tau = tau_ac if u >= a, else tau_deac
///   envelope:  0, 0 (a is u)
template <typename T>
[[nodiscard]] ActivationPoint<T> activation_rate(const ActivationDynamics<T>& d,
                                                 const T& excitation,
                                                 const ActivationPoint<T>& state) {
  using std::tanh;
  const T& e = state.filtered_excitation;
  const T& a = state.activation;
  const T& u = excitation;
  const T z = T(0.5) + T(1.5) * a;
  switch (d.law) {
    case ActivationLaw::envelope:
      return {T(0.0), T(0.0)};
    case ActivationLaw::two_lags: {
      const bool rises = value_of(e) >= value_of(a);
      return {(u - e) / d.excitation_time_s, (e - a) / (rises ? d.activation_time_s : d.deactivation_time_s)};
    }
    case ActivationLaw::thelen:
      if (value_of(u) > value_of(a)) return {T(0.0), (u - a) / (d.activation_time_s * z)};
      return {T(0.0), (u - a) * z / d.deactivation_time_s};
    case ActivationLaw::de_groote: {
      const T f = T(0.5) * tanh(T(d.steepness) * (u - a));
      return {T(0.0), ((f + T(0.5)) / (d.activation_time_s * z) + (T(0.5) - f) * z / d.deactivation_time_s) * (u - a)};
    }
    case ActivationLaw::recursive:
      return {(u - e) / d.excitation_time_s, (e - a) / d.activation_time_s};
    case ActivationLaw::one_lag:
      return {T(0.0), (u - a) / (value_of(u) >= value_of(a) ? d.activation_time_s : d.deactivation_time_s)};
  }
  return {};
}

/// Returns a number that is zero at a kink of the right-hand side: e - a (two_lags), u - a
/// (thelen, one_lag); 1 for the smooth laws.
[[nodiscard]] double activation_event(const ActivationDynamics<double>& dynamics,
                                      double excitation,
                                      const ActivationPoint<double>& state);

/// Returns the steady state under a constant excitation: e = a = u.
template <typename T>
[[nodiscard]] ActivationPoint<T> settled_activation(const T& excitation) {
  return {excitation, excitation};
}

}  // namespace myoid::muscle
