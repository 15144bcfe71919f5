#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "myoid/math/least_squares.h"

namespace myoid::math {

/// The columns Phi(a) that enter linearly and, when `derivatives` is not null, dPhi/da_j, one
/// matrix per nonlinear parameter. Sizes are preset: residual_count x linear_count.
using BasisFunction = std::function<void(const Eigen::VectorXd& nonlinear,
                                         Eigen::MatrixXd& basis,
                                         std::vector<Eigen::MatrixXd>* derivatives)>;

/// min over c and a of 1/2 |Phi(a) c - y|^2. Weights are factors of the rows of Phi and y; a prior
/// on c is one more row each.
struct SeparableProblem {
  Eigen::Index linear_count = 0;
  BasisFunction basis;
  Eigen::VectorXd response;  ///< y.
  Eigen::VectorXd lower;     ///< Of the nonlinear parameters; empty, or one each.
  Eigen::VectorXd upper;
  bool nonnegative = false;  ///< c >= 0 (Lawson and Hanson 1974).
};

enum class ProjectionJacobian {
  kaufman,  ///< P (dPhi/da_j) c, P = I - Phi Phi^+: cheaper, the gradient is exact all the same.
  golub_pereyra  ///< With the term -(Phi^+)' (dPhi/da_j)' r: the exact Jacobian.
};

struct VariableProjectionOptions {
  ProjectionJacobian jacobian = ProjectionJacobian::golub_pereyra;
  /// Singular values of Phi with unit columns below this share of the largest are zero: c is then
  /// the shortest (in scaled columns) of equally good ones.
  double rank_tolerance = 1e-13;
  LeastSquaresOptions search;
};

struct VariableProjectionResult {
  LeastSquaresResult search;  ///< Over the nonlinear parameters: search.x, termination, cost ...
  Eigen::VectorXd linear;     ///< c at the minimum.
  int linear_rank = 0;  ///< Of Phi there: below linear_count, c is not determined by the data.
  /// dr/d(c, a) at the minimum, linear parameters first: for math::covariance of all parameters.
  Eigen::MatrixXd jacobian;
};

/// Best linear parameters for given nonlinear ones, the residual Phi c - y, and its derivatives.
struct Projection {
  Eigen::VectorXd linear;
  Eigen::VectorXd residual;
  int rank = 0;
};
[[nodiscard]] Projection project(const Eigen::MatrixXd& basis,
                                 const Eigen::VectorXd& response,
                                 bool nonnegative,
                                 double rank_tolerance = 1e-13);

/// The least-squares problem in the nonlinear parameters alone, linear ones eliminated (Golub and
/// Pereyra 1973; Kaufman 1975): for any solver, multistart included. `problem` is copied.
[[nodiscard]] LeastSquaresProblem reduced_problem(const SeparableProblem& problem,
                                                  Eigen::Index nonlinear_count,
                                                  const VariableProjectionOptions& options = {});

/// Minimizes the reduced problem from `nonlinear_start`. No start of the linear parameters is
/// needed. Throws InvalidInput as minimize() does, or if sizes disagree.
[[nodiscard]] VariableProjectionResult variable_projection(
    const SeparableProblem& problem,
    const Eigen::VectorXd& nonlinear_start,
    const VariableProjectionOptions& options = {});

}  // namespace myoid::math
