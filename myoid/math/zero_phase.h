#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/math/butterworth.h"

namespace myoid::math {

/// How a signal goes on beyond its first and last sample.
enum class Ends {
  odd,   ///< x(-t) = 2 x(0) - x(t): for a smooth signal, whose value and slope go on.
  even,  ///< x(-t) = x(t): for noise, of which the last value says nothing and the level goes on.
};

/// Filters forwards and backwards, so that nothing is delayed; the gain is that of one pass,
/// squared. The ends are extended over three times the impulse response's length (`odd`: at most
/// n - 1 samples; `even`: to and fro, at most 100,000 or n - 1), and each pass starts in the steady
/// state of its first value: a constant comes back to round-off. Where x is noise of unit variance,
/// a low-pass with `odd` ends returns x itself at the first and last sample, with `even` ends a
/// mean over half as many samples as elsewhere. O(n). Throws InvalidInput if x holds a value that
/// is not finite or has fewer than 4 samples.
[[nodiscard]] Eigen::VectorXd zero_phase(const std::vector<SecondOrderSection>& sections,
                                         const Eigen::Ref<const Eigen::VectorXd>& x,
                                         Ends ends = Ends::odd);

}  // namespace myoid::math
