#pragma once

#include <functional>
#include <limits>
#include <string>

#include <Eigen/Core>

#include "myoid/ground/math/least_squares.h"

namespace myoid::inline ground::math {

/// A cost to be minimized without derivatives. Values that are not finite count as +inf.
using CostFunction = std::function<double(const Eigen::VectorXd& x)>;

struct DirectSearchProblem {
  CostFunction cost;
  Eigen::VectorXd lower;  ///< One per parameter, -inf without a bound; or empty.
  Eigen::VectorXd upper;
};

struct DirectSearchResult {
  Termination termination = Termination::no_descent;
  std::string message;  ///< Names the rule that stopped the search, in one sentence.
  Eigen::VectorXd x;    ///< The best point found.
  double cost = std::numeric_limits<double>::infinity();
  int evaluations = 0;
  int iterations = 0;  ///< Moves of the simplex, or temperatures.
  int restarts = 0;    ///< Simplices started where another shrank; 0 in annealing.
};

/// Returns 1/2 |r(x)|^2 of a least-squares problem with its bounds, so that other solvers find the same minimum.
[[nodiscard]] DirectSearchProblem direct_search_problem(const LeastSquaresProblem& problem);

/// The problem as the searches see it: with all bounds, counted evaluations, and x clipped. Throws
/// InvalidInput if sizes disagree, lower > upper, or a bound is NaN.
class CountedCost {
 public:
  CountedCost(const DirectSearchProblem& problem, Eigen::Index parameters);

  [[nodiscard]] double operator()(const Eigen::VectorXd& x);
  [[nodiscard]] Eigen::VectorXd clipped(const Eigen::VectorXd& x) const;
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  const CostFunction& cost_;
  Eigen::VectorXd lower_, upper_;
  int evaluations_ = 0;
};

}  // namespace myoid::inline ground::math
