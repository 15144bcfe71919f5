#include "myoid/ground/math/halved_steps.h"

#include <cmath>
#include <utility>

#include <Eigen/QR>
#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

constexpr int kMostSteps = 1000;
constexpr int kMostHalvings = 40;
/// Share of the cost below which a step promises nothing.
constexpr double kNothing = 1e-12;
/// Share of the unknowns below which a full step is round-off if it lowers nothing.
constexpr double kRoundOff = 1e-7;

/// Returns argmin |J d + r| with the columns of J scaled.
Eigen::VectorXd full_step(const LeastSquaresResult& at) {
  const Eigen::VectorXd size = at.jacobian.colwise().norm();
  const Eigen::VectorXd scale = (size.array() > 0.0).select(size.cwiseInverse(), 1.0);
  const Eigen::MatrixXd scaled = at.jacobian * scale.asDiagonal();
  return scale.cwiseProduct(scaled.colPivHouseholderQr().solve(-at.residual).eval());
}

bool ended(LeastSquaresResult& result, Termination termination, std::string message) {
  result.termination = termination;
  result.message = std::move(message);
  return true;
}

/// Takes one step; returns true if it is the last.
bool step(const LeastSquaresProblem& problem, LeastSquaresResult& result) {
  const double before = result.cost;
  Eigen::VectorXd d = full_step(result);
  const double promised = before - 0.5 * (result.residual + result.jacobian * d).squaredNorm();
  const bool tiny = (d.array().abs() <= kRoundOff * result.x.array().abs()).all();
  Eigen::VectorXd residual = result.residual;
  Eigen::MatrixXd jacobian = result.jacobian;
  for (int halved = 0; halved <= kMostHalvings; ++halved, d *= 0.5) {
    const Eigen::VectorXd x = result.x + d;
    problem.evaluate(x, residual, &jacobian);
    ++result.evaluations;
    const double cost = 0.5 * residual.squaredNorm();
    if (!(x.allFinite() && jacobian.allFinite() && cost < before)) continue;
    result.x = x;
    result.residual = residual;
    result.jacobian = jacobian;
    result.cost = cost;
    result.cost_history.push_back(cost);
    const bool settled = cost == 0.0 || (promised <= kNothing * before && before - cost <= kNothing * before);
    return settled && ended(result, Termination::converged, "the cost falls no further");
  }
  if (tiny || promised <= kNothing * before)
    return ended(result, Termination::converged, "the cost can fall no further within round-off");
  return ended(result, Termination::no_descent, "no step lowers the cost");
}

}  // namespace

LeastSquaresResult minimize_by_halved_steps(const LeastSquaresProblem& problem, const Eigen::VectorXd& start) {
  LeastSquaresResult result;
  result.x = start;
  result.residual.setZero(problem.residual_count);
  result.jacobian.setZero(problem.residual_count, start.size());
  problem.evaluate(start, result.residual, &result.jacobian);
  result.evaluations = 1;
  result.cost = 0.5 * result.residual.squaredNorm();
  if (!std::isfinite(result.cost) || !result.jacobian.allFinite())
    throw InvalidInput("halved steps: the residual or its Jacobian is not finite at the start");
  result.cost_history.push_back(result.cost);
  while (result.iterations < kMostSteps) {
    ++result.iterations;
    if (step(problem, result)) return result;
  }
  result.termination = Termination::iteration_limit;
  result.message = fmt::format("not converged after {} steps", result.iterations);
  return result;
}

}  // namespace myoid::inline ground::math
