#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/unlikeness.h"
#include "myoid/fit/posterior/likelihood.h"

namespace myoid::fit {

/// Returns true for the slack length of a tendon, a part of the geometry. Measured fascicles tell their tendon.
[[nodiscard]] bool is_exact_geometry(const Unknown& of, const StudyData& data);

/// The posterior's density over unbounded unknowns x. One entry of x belongs to each entry of the solver's z,
///
///   z = lower + (upper - lower) / (1 + exp(-x)),
///
/// the next entries are the hyperparameters phi of the errors. The size s of the model's error enters by its normal
/// score,
///
///   erf(s / (sqrt(2) sd)) = Phi(x),    Phi the standard normal distribution,
///
/// because ln s has no lower end where the model is exact. The size y of a kind of unseen quantities, over the spread
/// that is believed, is half normal and enters by ln y, whose density y exp(-y^2 / 2) has its mode at the belief, y =
/// 1: where the torque tells nothing of the kind, its quantities have the spread that they have over all y. The density
/// is that of x, with dz/dx:
///
///   ln p(x | y) = ln p(y | z, phi) + ln p(z) + ln p(phi) + sum ln dz/dx
///
/// The priors of z are the study's (ParameterMap); prior_precision joins them over muscles. The priors of phi stand in
/// beliefs.h: ln sigma_T, ln tau_T, ln kappa and ln b are normal, the sizes are half normal.
///
/// Spreads that are judgments are uncertain themselves, by a common factor lambda (Unlikeness). A search takes their
/// priors at one value of lambda: the density integrated over lambda has its greatest value where all numbers are the
/// priors' means, far from where the probability is. The sampler draws from the integrated density.
class Density {
 public:
  Density(const StudyData& data, const EstimatorOptions& options);

  /// Makes x the reference: takes the unseen quantities (Likelihood) and lambda at x.
  void refer_to(const Eigen::VectorXd& x);
  /// With geometry exact the tendons have the lengths of the model, too: their priors become narrow.
  void believe(Believed believed);
  /// Integrates the priors over lambda from now on.
  void integrate_unlikeness() { integrates_ = unlike_.uncertain(); }

  [[nodiscard]] const Likelihood& likelihood() const { return likelihood_; }
  [[nodiscard]] const ParameterMap& parameters() const { return likelihood_.parameters(); }
  [[nodiscard]] Eigen::Index size() const { return parameters().size() + noise_mean_.size(); }
  /// lambda at the reference (Unlikeness::expected).
  [[nodiscard]] double unlikeness() const { return unlikeness_; }
  /// Returns true for an unknown that `believe` takes to be exact.
  [[nodiscard]] bool is_exact_geometry(Eigen::Index unknown) const { return exact_[static_cast<std::size_t>(unknown)]; }
  /// Inverse covariance of the priors of z (prior_precision).
  [[nodiscard]] const Eigen::MatrixXd& precision() const { return precision_; }
  [[nodiscard]] Eigen::VectorXd z_of(const Eigen::VectorXd& x) const;
  [[nodiscard]] NoiseValues noise_of(const Eigen::VectorXd& x) const;
  /// Returns ln of the size that is believed (NoiseField, from kModelErrorSize on).
  [[nodiscard]] double believed_size(Eigen::Index field) const { return noise_mean_[field]; }
  /// Returns dz/dx for each entry of z.
  [[nodiscard]] Eigen::VectorXd slope(const Eigen::VectorXd& x) const;
  /// Returns the point at which a search begins: the study's starting values, with large errors.
  /// Small errors would give far points gradients that lead the search astray.
  [[nodiscard]] Eigen::VectorXd start() const;
  /// Returns the point of another fit's answer, EstimatorOptions::begin_at, which is the reference of a new density.
  /// Unknowns and trials that this density alone has begin as in `start`.
  [[nodiscard]] Eigen::VectorXd start_at(const FittedUnknowns& at) const;
  /// Returns the longest step of a search for each entry of x: a standard deviation of the prior,
  /// and at most 2, over half of the way between the bounds.
  [[nodiscard]] Eigen::VectorXd longest_step(const Eigen::VectorXd& x) const;
  /// Returns the x of z and phi; moves values near a bound inside, to 0.003 of the range.
  [[nodiscard]] Eigen::VectorXd x_of(const Eigen::VectorXd& z, const NoiseValues& noise) const;

  [[nodiscard]] double value(const Eigen::VectorXd& x) const { return evaluate(x, nullptr); }
  [[nodiscard]] double value(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const {
    return evaluate(x, &gradient);
  }
  /// Returns minus the second derivatives of data (by the mean torque only), priors and bounds' map: positive definite.
  [[nodiscard]] Eigen::MatrixXd gauss_newton(const Eigen::VectorXd& x) const;

 private:
  /// Returns the share of the way between the bounds of an unknown.
  [[nodiscard]] math::Bounded at(Eigen::Index unknown, const Eigen::VectorXd& x) const;
  [[nodiscard]] double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) const;
  /// Returns ln p(z) and its gradient, for the deviations of z from the priors' means.
  double prior(const Eigen::VectorXd& off, Eigen::VectorXd& gradient) const;

  void take_precision();

  std::vector<bool> exact_;  ///< Of each unknown: is_exact_geometry.
  double unlikeness_ = 1.0;
  Believed believed_ = Believed::nothing_exact;
  bool integrates_ = false;
  Likelihood likelihood_;
  Unlikeness unlike_;
  Eigen::VectorXd lower_, range_, prior_mean_;
  Eigen::MatrixXd precision_;
  NoiseValues noise_mean_, noise_sd_;  ///< Priors of the normal entries of phi.
};

}  // namespace myoid::fit
