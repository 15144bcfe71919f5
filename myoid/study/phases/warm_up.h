#pragma once

#include <optional>

#include <Eigen/Core>

namespace myoid::study {

/// A change at the beginning that fades exponentially.
struct WarmUp {
  double change = 0.0;             ///< Change of x at the first block, relative to its later level.
  double fading = 0.0;             ///< Number of blocks in which the change falls e-fold.
  Eigen::Index blocks = 0;         ///< Number of blocks until less than `least` of the change is left.
  double t = 0.0, critical = 0.0;  ///< Student's t of the change, and its critical value.
};

/// Searches x, one value per block in time order, for x = slow + change exp(-k / fading) + noise, where `slow` is a
/// polynomial of degree 3. Noise of neighboring blocks is correlated (a beat of two rhythms, for example): it is an
/// autoregression, whose order the Bayesian information criterion takes from the blocks after the first quarter.
/// Generalized least squares finds the change, filtered backwards in time so that no block of the beginning is lost.
/// The fading is the most significant of 1.5, 3, 6, ... blocks up to a sixth of them. Empty if the change is smaller
/// than `least` in the mean over `fading`, or if its t is below 1.25 times the critical value for the probability
/// `kFalseAlarm` (Bonferroni's bound over the fadings). The factor 1.25 allows for the estimated autoregression: with
/// 0.001, up to 0.6 % of simulated series without a warm-up are taken for one, 2 % under a strong regular beat. Also
/// empty with fewer than 24 blocks, too few to separate 3 + 1 coefficients from an autoregression. Throws InvalidInput
/// if x is not finite.
[[nodiscard]] std::optional<WarmUp> find_warm_up(const Eigen::VectorXd& x, double least, double false_alarm);

}  // namespace myoid::study
