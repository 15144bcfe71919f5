#pragma once

#include <cmath>

namespace myoid::muscle {

/// Returns the force-length multiplier f_l [-]: isometric force at this fiber length over that at the optimal length.
///
///   f_l(l) = exp(-((l - l0) / l_sh)^2)
///
/// Without a factor 1/2 the full width at half maximum is 2 sqrt(ln 2) l_sh = 1.665 l_sh. Thelen's
/// KshapeActive is (l_sh / l0)^2. All lengths in one unit [m]; l_sh > 0, unchecked here. Beyond |l
/// - l0| = 6 l_sh the value and its derivatives are below 1e-15, so a fit must start within about 2
/// l_sh. Equation (3) of the source paper.
template <typename T, typename L>
[[nodiscard]] T force_length(const L& fiber_length_m, const T& optimal_fiber_length_m, const T& force_length_width_m) {
  using std::exp;
  const T z = (fiber_length_m - optimal_fiber_length_m) / force_length_width_m;
  return exp(-z * z);
}

}  // namespace myoid::muscle
