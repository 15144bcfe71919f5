#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/parameters.h"

namespace myoid::fit {

/// Returns the standard deviation of an unknown's prior, with the part that it has in common with others.
[[nodiscard]] double prior_spread(const Unknown& of);

/// Returns true for a number of a muscle whose prior spread is a judgment: all but F_max and l_m0,
/// of which public models tell the spread, and those of which the study states a prior.
[[nodiscard]] bool spread_is_judgment(const Unknown& of);

/// Returns the inverse covariance of the priors of z. Where the spread of a muscle's number is a judgment, `unlikeness`
/// (lambda) multiplies it. The numbers of one field that have a common spread c (Unknown::common_sd: all ln F_max share
/// the person's strength) have
///
///   cov(z_i, z_j) = c_i c_j,    i not j.
[[nodiscard]] Eigen::MatrixXd prior_precision(const std::vector<Unknown>& free, double unlikeness = 1.0);

/// The person's strength, which all F_max with the literature's prior share.
struct Strength {
  double log_ratio = 0.0;  ///< ln of the strength over the model's.
  double sd = 0.0;         ///< Its prior's spread; 0: nothing is shared.
};

/// Returns the strength's expectation given z, sum (d_i / s_i^2) / (sum 1 / s_i^2 + 1 / c^2), d_i the deviation of
/// ln F_i from its prior's mean, s_i the muscle's own spread and c the common one.
[[nodiscard]] Strength common_strength(const std::vector<Unknown>& free, const Eigen::VectorXd& z);

/// Returns the unknowns with the priors of F_max about this strength, each with the muscle's own spread.
[[nodiscard]] std::vector<Unknown> about_strength(std::vector<Unknown> free, double log_strength);

/// The factor lambda on all prior spreads that are judgments: this person's deviation from the literature over the
/// literature's spread. If all muscles of a person deviate by two spreads, that is one coincidence, not twenty. ln
/// lambda has a normal prior (beliefs::kUnlikeness). Given lambda, z has its normal prior within its bounds.
class Unlikeness {
 public:
  explicit Unlikeness(const std::vector<Unknown>& free);

  /// Returns false where no spread is a judgment, so that lambda is 1.
  [[nodiscard]] bool uncertain() const { return judged_.size() > 0 && judged_.maxCoeff() > 0.0; }
  /// Prior precision at lambda = 1 of each number whose spread is a judgment; 0 for the others.
  [[nodiscard]] const Eigen::VectorXd& judged() const { return judged_; }

  /// Returns the root mean square of lambda, given the torque, by Laplace's approximation,
  ///
  ///   ln p(lambda | y) = 1/2 b' (I + P)^-1 b + 1/2 ln |P| - 1/2 ln |I + P|
  ///                      + ln B(y) - ln B + ln p(lambda),
  ///
  /// where I = `information` is the data's about z, P the prior's precision at lambda, and B and B(y) the shares of
  /// prior and posterior within the bounds. `b` is (I + P_0) (z - m) at the mode z, m the priors' mean and P_0 their
  /// precision. A normal prior of this lambda has the variance of the mixture over lambda.
  [[nodiscard]] double expected(const Eigen::MatrixXd& information, const Eigen::VectorXd& b) const;

  /// The prior of the judged numbers, integrated over lambda.
  struct Integrated {
    /// ln of the integral of lambda^-N exp(-Q / (2 lambda^2) - (ln lambda / sd)^2 / 2) / B over
    /// ln lambda.
    double log_density = 0.0;
    double precision = 1.0;  ///< Expectation of 1 / lambda^2, given Q.
  };
  /// Q = `squares` is the sum of squares of the judged numbers' deviations over their spreads.
  [[nodiscard]] Integrated integrated(double squares) const;

 private:
  std::vector<Unknown> free_;
  Eigen::VectorXd judged_;
  Eigen::Index count_ = 0;  ///< N, of the judged numbers.
  /// Values of ln lambda, evenly spaced, and ln p(lambda) - ln B at each.
  Eigen::ArrayXd log_lambda_, log_prior_;
};

}  // namespace myoid::fit
