#include "myoid/ground/math/direct_search.h"

#include <cmath>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {

CostFunction cost_of(const LeastSquaresProblem& problem) {
  return [evaluate = problem.evaluate, n = problem.residual_count](const Eigen::VectorXd& x) {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(n);
    evaluate(x, r, nullptr);
    return 0.5 * r.squaredNorm();
  };
}

double CountedCost::operator()(const Eigen::VectorXd& x) {
  ++evaluations_;
  const double cost = cost_(x);
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

double CountedCost::at_start(const Eigen::VectorXd& start) {
  if (start.size() == 0) throw InvalidInput("direct search: there is no free parameter");
  if (!start.allFinite()) throw InvalidInput("direct search: the start is not finite");
  const double cost = (*this)(start);
  if (!std::isfinite(cost)) throw InvalidInput("direct search: no finite cost at the start");
  return cost;
}

}  // namespace myoid::inline ground::math
