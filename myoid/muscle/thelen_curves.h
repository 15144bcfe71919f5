#pragma once

#include <cmath>

#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// The curves of Thelen (2003), J Biomech Eng 125:70-77. Lengths in optimal fiber lengths, velocities in v_max, forces
/// in F_max. The active force-length curve is `force_length` with l_sh = l0 sqrt(gamma).

/// Returns the force-velocity hyperbolas of A_f (`concentric_shape`) and F_len (`plateau`): P =
/// (F_len - 1) / (2 + 2 / A_f), tangent beyond the share `extrapolation` of F_len. Their velocity
/// is v / (v_max (1/4 + 3/4 a)): `thelen_speed`.
template <typename T>
[[nodiscard]] VelocityHyperbola<T> thelen_hyperbola(const T& concentric_shape,
                                                    const T& plateau,
                                                    double extrapolation = 0.95) {
  return {concentric_shape, (plateau - T(1.0)) * concentric_shape / (T(2.0) * (concentric_shape + T(1.0))), plateau,
          (T(extrapolation) * plateau - T(1.0)) / (plateau - T(1.0)), false};
}

/// Returns the share of v_max that a muscle of this activation reaches: 1/4 + 3/4 a.
template <typename T>
[[nodiscard]] T thelen_speed(const T& activation) {
  return T(0.25) + T(0.75) * activation;
}

/// Passive multiplier (exp(k (l - 1) / e) - 1) / (exp(k) - 1) above l = 1, else 0; 1 at l = 1 + e.
/// Published: k = 5 (`shape`, OpenSim 4), e = 0.6 (`strain`; 0.5 in old age). The slope jumps at
/// l = 1.
template <typename T>
class ThelenPassive {
 public:
  ThelenPassive(const T& strain, const T& shape) : rate_(shape / strain) {
    using std::exp;
    scale_ = T(1.0) / (exp(shape) - T(1.0));
  }
  [[nodiscard]] CurvePoint<T> operator()(const T& l) const {
    using std::exp;
    if (value_of(l) <= 1.0) return {T(0.0), 0.0};
    const T e = exp(rate_ * (l - T(1.0)));
    return {(e - T(1.0)) * scale_, value_of(e * scale_ * rate_)};
  }
  /// Returns the integral from l = 1: the energy over F_max l0.
  [[nodiscard]] T energy(const T& l) const {
    using std::exp;
    if (value_of(l) <= 1.0) return T(0.0);
    const T stretch = l - T(1.0);
    return ((exp(rate_ * stretch) - T(1.0)) / rate_ - stretch) * scale_;
  }

 private:
  T rate_, scale_;
};

/// End of the toe of Thelen's tendon as a share of e0, 99 e^3 / (166 e^3 - 67) = 0.6091. The slope
/// beyond is 0.67 / (1 - share) [F_max / e0]. Both are the exact values of his rounded 0.609 and
/// 1.712, with which the curve passes 1 at e0 with a continuous slope.
inline const double kThelenToeShare = 99.0 * std::exp(3.0) / (166.0 * std::exp(3.0) - 67.0);

/// Returns the tendon multiplier over the strain: exponential to the toe's end (0.33), then a line
/// through 1 at e0. 0 when slack.
template <typename T>
[[nodiscard]] CurvePoint<T> thelen_tendon(const T& strain, const T& strain_at_max_force) {
  using std::exp;
  if (value_of(strain) <= 0.0) return {T(0.0), 0.0};
  const T x = strain / (strain_at_max_force * T(kThelenToeShare));  // in toes
  if (value_of(x) <= 1.0) {
    const double scale = 0.33 / std::expm1(3.0);
    const T e = exp(T(3.0) * x);
    return {T(scale) * (e - T(1.0)), 3.0 * scale * value_of(e) / (value_of(strain_at_max_force) * kThelenToeShare)};
  }
  const double slope = 0.67 / (1.0 - kThelenToeShare);
  return {T(0.33) + T(slope) * (strain / strain_at_max_force - T(kThelenToeShare)),
          slope / value_of(strain_at_max_force)};
}

/// Returns the integral of thelen_tendon, the energy over F_max l_t0.
template <typename T>
[[nodiscard]] T thelen_tendon_energy(const T& strain, const T& strain_at_max_force) {
  using std::exp;
  if (value_of(strain) <= 0.0) return T(0.0);
  const T toe = strain_at_max_force * T(kThelenToeShare);
  const double scale = 0.33 / std::expm1(3.0);
  const bool in_toe = value_of(strain) <= value_of(toe);
  const T x = in_toe ? strain / toe : T(1.0);
  const T curved = T(scale) * toe * ((exp(T(3.0) * x) - T(1.0)) / T(3.0) - x);
  if (in_toe) return curved;
  const T beyond = strain - toe;
  const double slope = 0.67 / (1.0 - kThelenToeShare);
  return curved + T(0.33) * beyond + T(0.5 * slope) * beyond * beyond / strain_at_max_force;
}

}  // namespace myoid::muscle
