#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/choice.h"

namespace myoid::run {

/// The information of one movement about the parameters, for each of several persons drawn from the priors.
struct MovementInformation {
  std::string name;
  double duration_s = 0.0;
  /// Fisher information J' W J nu in the solver's scale, p x p, one per person; empty for a person
  /// who cannot do the movement.
  std::vector<Eigen::MatrixXd> per_person;
};

struct DesignProblem {
  std::vector<std::string> parameters;  ///< p labels.
  Eigen::MatrixXd prior_precision;      ///< p x p, positive definite.
  std::vector<Eigen::Index> targets;    ///< Parameters to determine; the others are nuisances.
  std::vector<MovementInformation> catalogue;
};

enum class DesignCriterion {
  d_optimal,  ///< log det of the targets' covariance: the volume of their confidence ellipsoid.
  a_optimal,  ///< Sum of the targets' variances, each relative to its prior's.
};
inline constexpr std::string_view kCriterionNames[] = {"D", "A"};
constexpr ChoiceNames choice_names(DesignCriterion) { return kCriterionNames; }

struct DesignOptions {
  DesignCriterion criterion = DesignCriterion::d_optimal;
  int movements = 8;               ///< Number of movements to choose.
  int most_of_each = 2;            ///< Limit on the repetitions of one movement.
  std::optional<double> budget_s;  ///< Limit on the recording time.
};

struct DesignStep {
  std::size_t movement = 0;  ///< Index in the catalogue.
  double criterion = 0.0;    ///< Mean over the persons after this step; decreases from step to step.
  Eigen::VectorXd sd;        ///< p: root mean posterior variance after this and all earlier steps.
};

struct DesignResult {
  double prior_criterion = 0.0;
  Eigen::VectorXd prior_sd;             ///< p
  std::vector<DesignStep> steps;        ///< In the order of their information.
  int exchanges = 0;                    ///< Improvements after the greedy choice.
  std::vector<std::size_t> infeasible;  ///< Movements that too few persons could do.
};

/// Chooses movements by Bayesian optimal design: minimizes the mean over the persons of
///
///   log det S_tt   (D)   or   sum_t S_tt / P_tt   (A),     S = (P^-1 + sum_m n_m M_m)^-1,
///
/// with P the prior covariance and t the targets. The best movement is added repeatedly, then movements are exchanged
/// one by one until nothing improves (Fedorov). Ties go to the first movement of the catalogue, so that the result does
/// not depend on threads. Throws InvalidInput if sizes disagree, there is no target, or no person can do any movement.
[[nodiscard]] DesignResult choose_movements(const DesignProblem& problem, const DesignOptions& options = {});

}  // namespace myoid::run
