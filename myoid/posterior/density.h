#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/posterior/likelihood.h"

namespace myoid::identification {

/// Returns the standard deviation of an unknown's prior. That of F_max, if it is the literature's
/// and not the study's, has the person's strength (UnseenSpreads::strength) beside the muscle's
/// own.
[[nodiscard]] double prior_spread(const Unknown& of, double strength_sd);

/// Returns true for a number of a muscle whose prior spread is a judgment: all but F_max and l_m0,
/// of which public models tell the spread, and those of which the study states a prior.
[[nodiscard]] bool spread_is_judgment(const Unknown& of);

/// Returns the inverse covariance of the priors of z. Where the spread of a muscle's number is a
/// judgment, `unlikeness` (lambda) multiplies it. All ln F_max of a person share the person's
/// strength, of spread c = `strength_sd`:
///
///   cov(ln F_i, ln F_j) = c^2,    i not j.
[[nodiscard]] Eigen::MatrixXd prior_precision(const std::vector<Unknown>& free,
                                              double strength_sd,
                                              double unlikeness = 1.0);

/// The posterior's density over unbounded unknowns x. One entry of x belongs to each entry of the
/// solver's z,
///
///   z = lower + (upper - lower) / (1 + exp(-x)),
///
/// the next entries are the hyperparameters phi of the errors. The size s of the model's error
/// enters by its normal score,
///
///   erf(s / (sqrt(2) sd)) = Phi(x),    Phi the standard normal distribution,
///
/// because ln s has no lower end where the model is exact. The density is that of x, with dz/dx:
///
///   ln p(x | y) = ln p(y | z, phi) + ln p(z) + ln p(phi) + sum ln dz/dx
///
/// The priors of z are the study's (ParameterMap); prior_precision joins them over muscles. The
/// priors of phi stand in beliefs.h: ln sigma_T, ln tau_T, ln kappa and ln b are normal, s is half
/// normal.
///
/// Spreads that are judgments are uncertain themselves: if all muscles of a person deviate by two
/// spreads, that is one coincidence, not twenty. Their common factor lambda (`unlikeness`) has a
/// prior. Laplace's approximation gives the density of lambda, whose maximum is taken,
///
///   ln p(lambda | y) = 1/2 b' (I + P)^-1 b + 1/2 ln |P| - 1/2 ln |I + P| + ln p(lambda),
///   b = (I + P_0) (z - m),    P the prior's precision at lambda, P_0 at the last lambda,
///
/// where I is the data's information about z at the reference.
class Density {
 public:
  Density(const StudyData& data, const EstimatorOptions& options);

  /// Makes x the reference: takes the unseen quantities (Likelihood) and lambda at x.
  void refer_to(const Eigen::VectorXd& x);
  void believe(Believed believed) { likelihood_.believe(believed); }

  [[nodiscard]] const Likelihood& likelihood() const { return likelihood_; }
  [[nodiscard]] const ParameterMap& parameters() const { return likelihood_.parameters(); }
  [[nodiscard]] Eigen::Index size() const { return parameters().size() + noise_mean_.size(); }
  /// This person's deviation from the literature, over the literature's spread (lambda).
  [[nodiscard]] double unlikeness() const { return unlikeness_; }
  /// Inverse covariance of the priors of z (prior_precision).
  [[nodiscard]] const Eigen::MatrixXd& precision() const { return precision_; }
  [[nodiscard]] Eigen::VectorXd z_of(const Eigen::VectorXd& x) const;
  [[nodiscard]] NoiseValues noise_of(const Eigen::VectorXd& x) const;
  /// Returns dz/dx for each entry of z.
  [[nodiscard]] Eigen::VectorXd slope(const Eigen::VectorXd& x) const;
  /// Returns the point at which a search begins: the study's starting values, with large errors.
  /// Small errors would give far points gradients that lead the search astray.
  [[nodiscard]] Eigen::VectorXd start() const;
  /// Returns the longest step of a search for each entry of x: a standard deviation of the prior,
  /// and at most 2, over which the logistic map changes its shape.
  [[nodiscard]] Eigen::VectorXd longest_step(const Eigen::VectorXd& x) const;
  /// Returns the x of z and phi; moves values near a bound inside, to 0.003 of the range.
  [[nodiscard]] Eigen::VectorXd x_of(const Eigen::VectorXd& z, const NoiseValues& noise) const;

  [[nodiscard]] double value(const Eigen::VectorXd& x) const { return evaluate(x, nullptr); }
  [[nodiscard]] double value(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const {
    return evaluate(x, &gradient);
  }
  /// Returns minus the second derivatives of the data (by the mean torque only), the priors and the
  /// logistic map. The matrix is positive definite.
  [[nodiscard]] Eigen::MatrixXd gauss_newton(const Eigen::VectorXd& x) const;

 private:
  [[nodiscard]] double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) const;
  [[nodiscard]] double likeliest_unlikeness(const Eigen::VectorXd& x) const;

  double strength_sd_ = 0.0, unlikeness_ = 1.0;
  Likelihood likelihood_;
  Eigen::VectorXd lower_, range_, prior_mean_;
  Eigen::MatrixXd precision_;
  NoiseValues noise_mean_, noise_sd_;  ///< Priors of the normal entries of phi.
};

}  // namespace myoid::identification
