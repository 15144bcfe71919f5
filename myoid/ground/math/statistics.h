#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::inline ground::math {

/// Returns the quantile of the standard normal distribution, 0 < p < 1, to round-off. Throws InvalidInput outside.
[[nodiscard]] double normal_quantile(double p);

/// Returns the quantile of Student's t with `freedom` > 0 degrees of freedom, 0 < p < 1. Throws InvalidInput outside.
[[nodiscard]] double student_quantile(double p, double freedom);

/// Returns the probability that chi-squared with `freedom` > 0 degrees of freedom exceeds x >= 0.
/// Throws InvalidInput outside.
[[nodiscard]] double chi_squared_tail(double x, double freedom);

/// Returns the probability that a standard normal number lies below x.
[[nodiscard]] double normal_below(double x);

/// Returns the middle value, or the mean of the two middle ones; NaN for no values.
[[nodiscard]] double median(std::vector<double> values);

/// Returns the middle value, or the larger of the two middle ones, so that the result is one of the
/// values; NaN for no values.
[[nodiscard]] double upper_median(std::vector<double> values);

/// Returns the autocorrelation rho_0 = 1, rho_1, ... of x about its mean, up to the last lag before
/// the first that is not positive. Sums stay within `pieces` (lengths of consecutive stretches).
[[nodiscard]] Eigen::VectorXd positive_autocorrelation(const Eigen::Ref<const Eigen::VectorXd>& x,
                                                       const std::vector<Eigen::Index>& pieces);

/// Returns the number of independent samples with the information of n correlated ones: n / (1 + 2
/// sum_k rho_k), with rho as `positive_autocorrelation` gives it. At least 1.
[[nodiscard]] double effective_sample_size(const Eigen::Ref<const Eigen::VectorXd>& x,
                                           const std::vector<Eigen::Index>& pieces);

/// Averages over a window that slides sample by sample: entry i covers samples i .. i + width - 1,
/// so that the result has x.size() - width + 1 entries. `width` is 1 to x.size().
[[nodiscard]] Eigen::VectorXd moving_mean(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index width);

/// Finds the greatest of these means over `window_s` of samples at `rate_hz`; the mean of all
/// samples if they last less.
[[nodiscard]] double greatest_mean(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz, double window_s);

/// Returns R² = 1 - sum (predicted - measured)² / sum (measured - mean)². About the mean of constant values R² is
/// undefined: the sum of the values' squares stands in its place. 1 for nothing but zeros.
[[nodiscard]] double explained_share(const Eigen::Ref<const Eigen::VectorXd>& predicted,
                                     const Eigen::Ref<const Eigen::VectorXd>& measured);

/// Returns the indices of the values from the least to the greatest; equal values keep their order.
[[nodiscard]] std::vector<Eigen::Index> rising_order(const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace myoid::inline ground::math
