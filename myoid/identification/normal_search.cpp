#include "myoid/identification/normal_search.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::identification {
namespace {

using math::Termination;

/// After a step that failed, the damping is at least twice this.
constexpr double kLeastRejected = 0.05;

bool step_is_small(const Eigen::VectorXd& step, const Eigen::VectorXd& x, double tolerance) {
  return (step.array().abs() <= tolerance * (x.array().abs() + tolerance)).all();
}

void finish(NormalSearchResult& r,
            const Eigen::VectorXd& lower,
            const Eigen::VectorXd& upper,
            Termination termination,
            std::string message) {
  r.termination = termination;
  r.message = std::move(message);
  r.at_bound.resize(static_cast<std::size_t>(r.x.size()));
  for (Eigen::Index j = 0; j < r.x.size(); ++j) {
    const double span = 1e-10 * (1.0 + std::abs(r.x[j]));
    r.at_bound[static_cast<std::size_t>(j)] =
        r.x[j] - lower[j] <= span || upper[j] - r.x[j] <= span;
  }
}

}  // namespace

NormalSearchResult minimize_normal(const NormalFunction& function,
                                   const Eigen::VectorXd& lower,
                                   const Eigen::VectorXd& upper,
                                   const Eigen::VectorXd& start,
                                   const NormalSearchOptions& options,
                                   const std::vector<bool>& held) {
  const Eigen::Index p = start.size();
  if (p == 0) throw InvalidInput("identification: there is no free parameter");
  NormalSearchResult r;
  r.x = start.cwiseMax(lower).cwiseMin(upper);
  const auto evaluate = [&](const Eigen::VectorXd& x, NormalEquations& out) {
    ++r.evaluations;
    function(x, true, out);
    return std::isfinite(out.cost) && out.gradient.allFinite() && out.curvature.allFinite();
  };
  if (!evaluate(r.x, r.at)) {
    throw InvalidInput("identification: the model is not finite at the starting values");
  }
  r.cost = r.at.cost;
  r.cost_history.push_back(r.cost);
  const double first_cost = r.cost;
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(p);
  double damping = options.gauss_newton ? 0.0 : 1e-3;
  double growth = 2.0;
  NormalEquations next;
  for (r.iterations = 0; r.iterations < options.max_iterations; ++r.iterations) {
    options.progress.check();
    std::vector<Eigen::Index> moving;
    bool flat = true;
    for (Eigen::Index j = 0; j < p; ++j) {
      const double norm = std::sqrt(std::max(0.0, r.at.curvature(j, j)));
      scale[j] = std::max(scale[j], norm);
      const bool out = (r.x[j] <= lower[j] && r.at.gradient[j] > 0.0) ||
                       (r.x[j] >= upper[j] && r.at.gradient[j] < 0.0);
      if (out || (!held.empty() && held[static_cast<std::size_t>(j)])) continue;
      moving.push_back(j);
      flat = flat && std::abs(r.at.gradient[j]) <= 1e-14 * norm * std::sqrt(2.0 * r.cost);
    }
    if (moving.empty()) {
      finish(r, lower, upper, Termination::converged, "every parameter leans on a bound");
      return r;
    }
    if (flat || r.cost == 0.0) {
      finish(r, lower, upper, Termination::converged, "the gradient vanishes");
      return r;
    }
    const auto q = static_cast<Eigen::Index>(moving.size());
    Eigen::VectorXd d(q);
    for (Eigen::Index k = 0; k < q; ++k) {
      const double s = scale[moving[static_cast<std::size_t>(k)]];
      d[k] = s > 0.0 ? 1.0 / s : 1.0;
    }
    const Eigen::MatrixXd matrix = d.asDiagonal() * r.at.curvature(moving, moving) * d.asDiagonal();
    const Eigen::VectorXd right = -d.cwiseProduct(r.at.gradient(moving).eval());
    for (bool accepted = false; !accepted;) {
      Eigen::MatrixXd damped = matrix;
      damped.diagonal().array() += std::max(damping, 1e-15);
      const Eigen::LDLT<Eigen::MatrixXd> solver(damped);
      Eigen::VectorXd step = Eigen::VectorXd::Zero(p);
      Eigen::VectorXd scaled = solver.solve(right);
      // One refinement: the matrix is the square of an ill-conditioned one.
      scaled += solver.solve((right - damped * scaled).eval());
      for (Eigen::Index k = 0; k < q; ++k)
        step[moving[static_cast<std::size_t>(k)]] = d[k] * scaled[k];
      const Eigen::VectorXd x = (r.x + step).cwiseMax(lower).cwiseMin(upper);
      const Eigen::VectorXd moved = x - r.x;
      const bool clipped = (moved - step).cwiseAbs().maxCoeff() > 0.0;
      if (step_is_small(moved, r.x, options.step_tolerance)) {
        finish(r, lower, upper, Termination::converged, "the step is below the tolerance");
        return r;
      }
      const double promised = -(r.at.gradient.dot(moved) + 0.5 * moved.dot(r.at.curvature * moved));
      const bool finite = evaluate(x, next);
      const double fall = r.cost - next.cost;
      if (options.gauss_newton) {
        if (!finite || next.cost > 1e12 * (first_cost + 1e-300)) {
          finish(r, lower, upper, Termination::not_finite,
                 "a full Gauss-Newton step left the domain of the model");
          return r;
        }
        accepted = true;
      } else if (finite && fall > 0.0) {
        accepted = true;
        const double ratio = promised > 0.0 ? fall / promised : 0.0;
        damping =
            std::max(1e-15, damping * std::clamp(1.0 - std::pow(2.0 * ratio - 1.0, 3), 0.1, 2.0));
        growth = 2.0;
      } else {
        // A step that a bound cut short may promise nothing and still hide a descent: shorten it.
        if (finite && !clipped && promised <= std::max(options.cost_tolerance, 1e-13) * r.cost) {
          finish(r, lower, upper, Termination::converged,
                 "the cost can fall no further within round-off");
          return r;
        }
        // Damping that changes nothing in the step is not worth an evaluation.
        damping = std::max(damping, kLeastRejected) * growth;
        growth *= 2.0;
        if (damping > 1e30) {
          finish(r, lower, upper, Termination::no_descent, "no step lowers the cost");
          return r;
        }
      }
      if (accepted) {
        const double before = r.cost;
        r.x = x;
        std::swap(r.at, next);
        r.cost = r.at.cost;
        r.cost_history.push_back(r.cost);
        if (!options.gauss_newton && before - r.cost <= options.cost_tolerance * before &&
            promised <= options.cost_tolerance * before) {
          ++r.iterations;
          finish(r, lower, upper, Termination::converged, "the cost falls no further");
          return r;
        }
      }
    }
  }
  finish(r, lower, upper, Termination::iteration_limit,
         fmt::format("not converged after {} iterations", r.iterations));
  return r;
}

}  // namespace myoid::identification
