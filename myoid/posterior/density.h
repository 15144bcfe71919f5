#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/posterior/likelihood.h"

namespace myoid::identification {

/// The inverse covariance of the priors of z. Every spread s_i that the literature states of a
/// muscle, and the study does not, is `unlikeness` (lambda) times the belief's. Of F_max a share of
/// that variance is common to the person's muscles (UnseenSpreads::common_strength):
///
///   cov(z_i, z_j) = common_share lambda^2 s_i s_j,    var(z_i) = sd_i^2 + (lambda^2 - 1) s_i^2,
///
/// s_i the belief's spread, at most sd_i. A spread that a missing maximal contraction adds
/// (sd_i > s_i) is each muscle's own, and lambda does not change it.
[[nodiscard]] Eigen::MatrixXd prior_precision(const std::vector<Unknown>& free,
                                              double common_share,
                                              double unlikeness = 1.0);

/// The posterior's density over unknowns x without bounds: one for each entry of the solver's z,
///
///   z = lower + (upper - lower) / (1 + exp(-x)),
///
/// then the hyperparameters phi of the errors, the size s of the model's error by its normal score,
///
///   erf(s / (sqrt(2) sd)) = Phi(x),    Phi the standard normal distribution,
///
/// for ln s would have no end where the model is right. Densities are those of x: dz/dx is in them.
///
///   ln p(x | y) = ln p(y | z, phi) + ln p(z) + ln p(phi) + sum ln dz/dx
///
/// The priors of z are the study's (ParameterMap), joined over muscles by prior_precision; those of
/// phi in beliefs.h: ln sigma_T, ln tau_T, ln kappa and ln b normal, s half normal.
///
/// The literature's spreads are uncertain themselves: a person whose every muscle lies two of them
/// away is one surprise, not twenty. Their common factor lambda (`unlikeness`) has a prior, and is
/// taken at the greatest density that Laplace's approximation leaves of it,
///
///   ln p(lambda | y) = 1/2 b' (I + P)^-1 b + 1/2 ln |P| - 1/2 ln |I + P| + ln p(lambda),
///   b = (I + P_0) (z - m),    P the prior's precision at lambda, P_0 at the last lambda,
///
/// with I the data's information of z at the reference.
class Density {
 public:
  Density(const StudyData& data, const EstimatorOptions& options);

  /// Takes the unseen quantities (Likelihood) and lambda at this point.
  void refer_to(const Eigen::VectorXd& x);
  void believe(Believed believed) { likelihood_.believe(believed); }

  [[nodiscard]] const Likelihood& likelihood() const { return likelihood_; }
  [[nodiscard]] const ParameterMap& parameters() const { return likelihood_.parameters(); }
  [[nodiscard]] Eigen::Index size() const { return parameters().size() + noise_mean_.size(); }
  /// Spread of this person's muscles about the literature, over the literature's own spread.
  [[nodiscard]] double unlikeness() const { return unlikeness_; }
  /// Of the priors of z (prior_precision).
  [[nodiscard]] const Eigen::MatrixXd& precision() const { return precision_; }
  [[nodiscard]] Eigen::VectorXd z_of(const Eigen::VectorXd& x) const;
  [[nodiscard]] NoiseValues noise_of(const Eigen::VectorXd& x) const;
  /// dz/dx, one for each entry of z.
  [[nodiscard]] Eigen::VectorXd slope(const Eigen::VectorXd& x) const;
  /// Where a search begins: the starting values of the study, and errors that are large, lest it is
  /// led astray by a point at which hardly anything is met.
  [[nodiscard]] Eigen::VectorXd start() const;
  /// The longest step of a search that each entry of x may take: a standard deviation of the prior,
  /// and no more than 2, by which the logistic map is another.
  [[nodiscard]] Eigen::VectorXd longest_step(const Eigen::VectorXd& x) const;
  /// The x of these z and phi: values near a bound are moved inside to 0.03 of the range.
  [[nodiscard]] Eigen::VectorXd x_of(const Eigen::VectorXd& z, const NoiseValues& noise) const;

  [[nodiscard]] double value(const Eigen::VectorXd& x) const { return evaluate(x, nullptr); }
  [[nodiscard]] double value(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const {
    return evaluate(x, &gradient);
  }
  /// Minus its second derivatives as far as the mean torque makes them: that of the data, of the
  /// priors, and of the logistic map. Positive definite.
  [[nodiscard]] Eigen::MatrixXd gauss_newton(const Eigen::VectorXd& x) const;

 private:
  [[nodiscard]] double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) const;
  [[nodiscard]] double likeliest_unlikeness(const Eigen::VectorXd& x) const;

  double common_strength_ = 0.0, unlikeness_ = 1.0;
  Likelihood likelihood_;
  Eigen::VectorXd lower_, range_, prior_mean_;
  Eigen::MatrixXd precision_;
  NoiseValues noise_mean_, noise_sd_;  ///< Of the normal ones.
};

}  // namespace myoid::identification
