#pragma once

#include <optional>

#include <Eigen/Core>

namespace myoid {

/// A change at the beginning that fades exponentially.
struct WarmUp {
  double change = 0.0;             ///< Of x at the first block, against its later level.
  double fading = 0.0;             ///< Blocks in which it falls e-fold.
  Eigen::Index blocks = 0;         ///< Until less than `least` is left of it.
  double t = 0.0, critical = 0.0;  ///< Student's t of the change, and its critical value.
};

/// Searches x, one value per block in time order, for x = slow + change exp(-k / fading) + noise,
/// `slow` a polynomial of degree 3. Noise of neighbors hangs together (a beat of two rhythms, say):
/// it is an autoregression, of the order that the Bayesian information criterion takes from the
/// blocks behind the first quarter, and the change is found by generalized least squares, filtered
/// backwards in time so that no block of the beginning is lost. The fading is the most significant
/// of 1.5, 3, 6, ... blocks up to a sixth of them. Empty if the change is smaller than `least` in
/// the mean over `fading`, or if its t is below 1.25 times the critical value for the probability
/// `false_alarm` (Bonferroni's bound over the fadings). The factor 1.25 allows for the estimated
/// autoregression: with 0.001, up to 0.6 % of simulated series without a warm-up are taken for one,
/// 2 % under a strong regular beat. Empty with fewer than 24 blocks, which cannot tell 3 + 1
/// coefficients from an autoregression. Throws InvalidInput if x is not finite.
[[nodiscard]] std::optional<WarmUp> find_warm_up(const Eigen::VectorXd& x,
                                                 double least,
                                                 double false_alarm);

}  // namespace myoid
