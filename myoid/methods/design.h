#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace myoid::identification {

/// The information of one movement about the parameters, for each of several persons drawn from the
/// priors.
struct MovementInformation {
  std::string name;
  double duration_s = 0.0;
  /// Fisher information J' W J nu in the solver's scale, p x p, one per person; empty where that
  /// person could not do it.
  std::vector<Eigen::MatrixXd> per_person;
};

struct DesignProblem {
  std::vector<std::string> parameters;  ///< p labels.
  Eigen::MatrixXd prior_precision;      ///< p x p, positive definite.
  std::vector<Eigen::Index> targets;    ///< The parameters that matter; the others are nuisance.
  std::vector<MovementInformation> catalogue;
};

enum class DesignCriterion {
  d_optimal,  ///< log det of the targets' covariance: the volume of their confidence ellipsoid.
  a_optimal,  ///< Sum of the targets' variances, each over its prior's.
};

struct DesignOptions {
  DesignCriterion criterion = DesignCriterion::d_optimal;
  int movements = 8;                                          ///< To choose.
  int most_of_each = 2;                                       ///< Repetitions of one movement.
  double budget_s = std::numeric_limits<double>::infinity();  ///< Of recording time.
  double least_feasible = 0.8;  ///< Share of the persons who must be able to do a movement.
};

struct DesignStep {
  std::size_t movement = 0;  ///< In the catalogue.
  double criterion = 0.0;    ///< After this step, mean over the persons; falls from step to step.
  Eigen::VectorXd sd;        ///< p: root mean posterior variance after this and all earlier steps.
};

struct DesignResult {
  double prior_criterion = 0.0;
  Eigen::VectorXd prior_sd;             ///< p
  std::vector<DesignStep> steps;        ///< The most telling first.
  int exchanges = 0;                    ///< Improvements after the greedy choice.
  std::vector<std::size_t> infeasible;  ///< Movements that too few persons could do.
};

/// Bayesian optimal choice of movements: minimizes the mean over the persons of
///
///   log det S_tt   (D)   or   sum_t S_tt / P_tt   (A),     S = (P^-1 + sum_m n_m M_m)^-1,
///
/// with P the covariance beforehand and t the targets, by adding the best movement again and again
/// and then exchanging one for another (Fedorov) until nothing improves. Ties go to the movement
/// that stands first in the catalogue: the result does not depend on threads. Throws InvalidInput
/// if sizes disagree, there is no target, or nobody can do anything.
[[nodiscard]] DesignResult choose_movements(const DesignProblem& problem,
                                            const DesignOptions& options = {});

}  // namespace myoid::identification
