#include "myoid/ground/math/direct_search.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"

namespace myoid::inline ground::math {

DirectSearchProblem direct_search_problem(const LeastSquaresProblem& problem) {
  return {.cost =
              [evaluate = problem.evaluate, n = problem.residual_count](const Eigen::VectorXd& x) {
                Eigen::VectorXd r = Eigen::VectorXd::Zero(n);
                evaluate(x, r, nullptr);
                return 0.5 * r.squaredNorm();
              },
          .lower = problem.lower,
          .upper = problem.upper};
}

CountedCost::CountedCost(const DirectSearchProblem& problem, Eigen::Index parameters)
    : cost_(problem.cost), lower_(problem.lower), upper_(problem.upper) {
  if (parameters == 0) throw InvalidInput("direct search: there is no free parameter");
  if (lower_.size() == 0) lower_ = Eigen::VectorXd::Constant(parameters, -kInfinity);
  if (upper_.size() == 0) upper_ = Eigen::VectorXd::Constant(parameters, kInfinity);
  if (lower_.size() != parameters || upper_.size() != parameters) {
    throw InvalidInput(fmt::format("direct search: {} lower and {} upper bounds for {} parameters", lower_.size(),
                                   upper_.size(), parameters));
  }
  for (Eigen::Index j = 0; j < parameters; ++j) {
    if (!(lower_[j] <= upper_[j])) {
      throw InvalidInput(
          fmt::format("direct search: parameter {} has the bounds [{}, {}]", j + 1, lower_[j], upper_[j]));
    }
  }
}

double CountedCost::operator()(const Eigen::VectorXd& x) {
  ++evaluations_;
  const double cost = cost_(x);
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd CountedCost::clipped(const Eigen::VectorXd& x) const { return x.cwiseMax(lower_).cwiseMin(upper_); }

}  // namespace myoid::inline ground::math
