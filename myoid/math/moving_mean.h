#pragma once

#include <Eigen/Core>

namespace myoid::math {

/// Averages over a window that slides sample by sample: entry i covers samples i .. i + width - 1,
/// so that the result has x.size() - width + 1 entries. `width` is 1 to x.size().
[[nodiscard]] Eigen::VectorXd moving_mean(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index width);

/// Finds the greatest of these means over `window_s` of samples at `rate_hz`; the mean of all
/// samples if they last less.
[[nodiscard]] double greatest_mean(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz, double window_s);

}  // namespace myoid::math
