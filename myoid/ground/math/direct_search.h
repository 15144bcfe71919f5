#pragma once

#include <functional>
#include <limits>

#include <Eigen/Core>

#include "myoid/ground/math/least_squares.h"

namespace myoid::inline ground::math {

/// A cost to be minimized without derivatives. Values that are not finite count as +inf.
using CostFunction = std::function<double(const Eigen::VectorXd& x)>;

struct DirectSearchResult {
  Termination termination = Termination::no_descent;
  Eigen::VectorXd x;  ///< The best point found.
  double cost = std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

/// Returns 1/2 |r(x)|^2 of a least-squares problem without bounds, so that other solvers find the same minimum.
[[nodiscard]] CostFunction cost_of(const LeastSquaresProblem& problem);

/// The cost as the searches see it: finite or +inf, with counted evaluations.
class CountedCost {
 public:
  explicit CountedCost(const CostFunction& cost) : cost_(cost) {}

  [[nodiscard]] double operator()(const Eigen::VectorXd& x);
  /// Returns the cost at a start. Throws InvalidInput if the start is empty, or the start or its cost is not finite.
  [[nodiscard]] double at_start(const Eigen::VectorXd& start);
  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  const CostFunction& cost_;
  int evaluations_ = 0;
};

}  // namespace myoid::inline ground::math
