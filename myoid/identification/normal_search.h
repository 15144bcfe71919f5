#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/math/least_squares.h"

namespace myoid::identification {

/// Cost C, its gradient J'r and the Gauss-Newton matrix J'J, summed over the samples.
struct NormalEquations {
  double cost = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};
using NormalFunction = std::function<NormalEquations(const Eigen::VectorXd& z)>;

struct NormalSearchOptions {
  bool gauss_newton = false;  ///< Takes full steps without damping.
  int max_iterations = 200;
  double step_tolerance = 1e-12;  ///< Stops when |d| <= tol (|x| + tol).
  double cost_tolerance = 1e-15;  ///< Stops when the cost falls by less than this share.
  Progress progress;
};

struct NormalSearchResult {
  math::Termination termination = math::Termination::no_descent;
  std::string message;
  Eigen::VectorXd x;
  double cost = 0.0;
  NormalEquations at;  ///< The normal equations at x.
  int iterations = 0;
  int evaluations = 0;
  std::vector<bool> at_bound;
  std::vector<double> cost_history;
};

/// Minimizes C(z) within bounds by Levenberg-Marquardt on the normal equations. These are p x p for any number of
/// samples, with one pass over the data per step. The columns are scaled to unit length before solving. The gradient is
/// exact, so the limit is exact, too, while the scaled condition number of J stays below about 1e7. `held` (empty, or
/// one per variable) keeps variables at their start.
[[nodiscard]] NormalSearchResult minimize_normal(const NormalFunction& function,
                                                 const Eigen::VectorXd& lower,
                                                 const Eigen::VectorXd& upper,
                                                 const Eigen::VectorXd& start,
                                                 const NormalSearchOptions& options = {},
                                                 const std::vector<bool>& held = {});

}  // namespace myoid::identification
