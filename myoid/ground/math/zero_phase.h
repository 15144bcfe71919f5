#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/ground/math/butterworth.h"

namespace myoid::inline ground::math {

/// Extrapolation of a signal beyond its first and last sample.
enum class Ends {
  odd,   ///< x(-t) = 2 x(0) - x(t): for a smooth signal, whose value and slope continue.
  even,  ///< x(-t) = x(t): for noise, whose last value is arbitrary and whose level continues.
};

/// Filters forwards and backwards, without delay; the gain is that of one pass, squared. The ends are extended over
/// three times the impulse response's length (`odd`: at most n - 1 samples; `even`: to and fro, at most 100,000 or n -
/// 1). Each pass starts in the steady state of its first value, so that a constant stays unchanged to round-off. For
/// white noise a low-pass with `odd` ends returns x itself at the first and last sample, with `even` ends a mean over
/// half as many samples as elsewhere. O(n). Throws InvalidInput if x holds a value that is not finite or has fewer than
/// 4 samples.
[[nodiscard]] Eigen::VectorXd zero_phase(const std::vector<SecondOrderSection>& sections,
                                         const Eigen::Ref<const Eigen::VectorXd>& x,
                                         Ends ends = Ends::odd);

}  // namespace myoid::inline ground::math
