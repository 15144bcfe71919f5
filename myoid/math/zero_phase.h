#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/math/butterworth.h"

namespace myoid::math {

/// Filters forwards and backwards, so that nothing is delayed; the gain is that of one pass,
/// squared. The ends are extended by odd reflection over three times the impulse response's length
/// (at most n - 1 samples) and each pass starts in the steady state of its first value: a constant
/// comes back to round-off. O(n). Throws InvalidInput if x holds a value that is not finite or has
/// fewer than 4 samples.
[[nodiscard]] Eigen::VectorXd zero_phase(const std::vector<SecondOrderSection>& sections,
                                         const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace myoid::math
