#pragma once

#include <Eigen/Core>

#include "tests/coverage/made_person.h"

namespace myoid::test {

/// Weighted draws of z and of the hyperparameters, one column each.
struct PosteriorDraws {
  Eigen::MatrixXd values;
  Eigen::VectorXd weight;  ///< Adds to 1.
  double khat = 0.0;
  bool approximate = false;
  bool converged = false;
  int modes = 0;
  double gain_from_truth = 0.0;  ///< ln density that the search from the truth finds more.
  Eigen::VectorXd reference_z;   ///< Where the unseen quantities' columns belong to.
  Eigen::VectorXd best_x;        ///< The highest mode, without bounds (Density).
  Eigen::MatrixXd covariance;    ///< Of x there, by Laplace.
};

/// Parts of the estimator that are replaced, to tell a cause of false intervals.
struct DrawOptions {
  int draws = 500;                  ///< 0: of the normal approximation.
  bool reference_is_truth = false;  ///< The unseen quantities' columns at the true unknowns.
  bool search_from_truth = false;   ///< A third search, from the truth.
};

/// The posterior of a made person by the estimator's own steps: modes from two starts, the unseen
/// quantities' columns at the best, Laplace, importance.
[[nodiscard]] PosteriorDraws posterior_draws(const MadePerson& person, const DrawOptions& options);

}  // namespace myoid::test
