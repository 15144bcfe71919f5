#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::math {

/// Quantile of the standard normal distribution, 0 < p < 1; to round-off. Throws InvalidInput
/// outside.
[[nodiscard]] double normal_quantile(double p);

/// The middle value, or the mean of the two middle ones; NaN of none.
[[nodiscard]] double median(std::vector<double> values);

/// The middle value, or the larger of the two middle ones: always one of them. NaN of none.
[[nodiscard]] double upper_median(std::vector<double> values);

/// Independent samples that n correlated ones are worth: n / (1 + 2 sum_k rho_k), the sum over lags
/// up to the first autocorrelation that is not positive. Sums run within `pieces` (lengths of
/// consecutive stretches), never across. At least 1.
[[nodiscard]] double effective_sample_size(const Eigen::Ref<const Eigen::VectorXd>& x,
                                           const std::vector<Eigen::Index>& pieces);

/// Long-run covariance of a sum of scores (n x p), Newey and West (1987): G_0 + sum_l (1 - l/(L+1))
/// (G_l + G_l'), with G_l = sum_t g_t g_{t-l}', lags within `pieces` only. Positive semidefinite.
[[nodiscard]] Eigen::MatrixXd newey_west(const Eigen::MatrixXd& scores,
                                         const std::vector<Eigen::Index>& pieces,
                                         Eigen::Index lag);

}  // namespace myoid::math
