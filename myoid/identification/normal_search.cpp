#include "myoid/identification/normal_search.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::identification {
namespace {

using math::Termination;

/// Least half of the damping after a failed step.
constexpr double kLeastRejected = 0.05;

bool step_is_small(const Eigen::VectorXd& step, const Eigen::VectorXd& x, double tolerance) {
  return (step.array().abs() <= tolerance * (x.array().abs() + tolerance)).all();
}

/// A search by Newton's steps with the damping of Nielsen, within bounds.
class Search {
 public:
  Search(const NormalFunction& function,
         const Eigen::VectorXd& lower,
         const Eigen::VectorXd& upper,
         const NormalSearchOptions& options,
         const std::vector<bool>& held)
      : function_(function), lower_(lower), upper_(upper), options_(options), held_(held) {}

  NormalSearchResult run(const Eigen::VectorXd& start) {
    r_.x = start.cwiseMax(lower_).cwiseMin(upper_);
    if (!evaluate(r_.x, r_.at)) throw InvalidInput("identification: the model is not finite at the starting values");
    r_.cost = r_.at.cost;
    r_.cost_history.push_back(r_.cost);
    first_cost_ = r_.cost;
    scale_ = Eigen::VectorXd::Zero(start.size());
    damping_ = options_.gauss_newton ? 0.0 : 1e-3;
    for (r_.iterations = 0; r_.iterations < options_.max_iterations; ++r_.iterations) {
      options_.progress.check();
      if (iterate()) return std::move(r_);
    }
    end(Termination::iteration_limit, fmt::format("not converged after {} iterations", r_.iterations));
    return std::move(r_);
  }

 private:
  /// The normal equations of the parameters that may move, scaled.
  struct Scaled {
    std::vector<Eigen::Index> moving;
    bool flat = true;
    Eigen::VectorXd d;
    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;
  };
  struct Trial {
    Eigen::VectorXd x, moved;
    bool clipped = false;   ///< A bound shortened the step.
    double promised = 0.0;  ///< Fall of the cost by the quadratic model.
  };

  bool evaluate(const Eigen::VectorXd& x, NormalEquations& out) {
    ++r_.evaluations;
    out = function_(x);
    return std::isfinite(out.cost) && out.gradient.allFinite() && out.curvature.allFinite();
  }

  /// Ends the search and returns true.
  bool end(Termination termination, std::string message) {
    r_.termination = termination;
    r_.message = std::move(message);
    r_.at_bound.resize(static_cast<std::size_t>(r_.x.size()));
    for (Eigen::Index j = 0; j < r_.x.size(); ++j) {
      const double span = 1e-10 * (1.0 + std::abs(r_.x[j]));
      r_.at_bound[static_cast<std::size_t>(j)] = r_.x[j] - lower_[j] <= span || upper_[j] - r_.x[j] <= span;
    }
    return true;
  }

  Scaled scaled() {
    Scaled s;
    for (Eigen::Index j = 0; j < r_.x.size(); ++j) {
      const double norm = std::sqrt(std::max(0.0, r_.at.curvature(j, j)));
      scale_[j] = std::max(scale_[j], norm);
      const bool out =
          (r_.x[j] <= lower_[j] && r_.at.gradient[j] > 0.0) || (r_.x[j] >= upper_[j] && r_.at.gradient[j] < 0.0);
      if (out || (!held_.empty() && held_[static_cast<std::size_t>(j)])) continue;
      s.moving.push_back(j);
      s.flat = s.flat && std::abs(r_.at.gradient[j]) <= 1e-14 * norm * std::sqrt(2.0 * r_.cost);
    }
    const auto q = static_cast<Eigen::Index>(s.moving.size());
    s.d.resize(q);
    for (Eigen::Index k = 0; k < q; ++k) {
      const double size = scale_[s.moving[static_cast<std::size_t>(k)]];
      s.d[k] = size > 0.0 ? 1.0 / size : 1.0;
    }
    s.matrix = s.d.asDiagonal() * r_.at.curvature(s.moving, s.moving) * s.d.asDiagonal();
    s.right = -s.d.cwiseProduct(r_.at.gradient(s.moving).eval());
    return s;
  }

  [[nodiscard]] Trial trial_of(const Scaled& s) const {
    Eigen::MatrixXd damped = s.matrix;
    damped.diagonal().array() += std::max(damping_, 1e-15);
    const Eigen::LDLT<Eigen::MatrixXd> solver(damped);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(r_.x.size());
    Eigen::VectorXd scaled = solver.solve(s.right);
    // Refines once, because the matrix is the square of an ill-conditioned one.
    scaled += solver.solve((s.right - damped * scaled).eval());
    for (Eigen::Index k = 0; k < s.d.size(); ++k) step[s.moving[static_cast<std::size_t>(k)]] = s.d[k] * scaled[k];
    Trial trial;
    trial.x = (r_.x + step).cwiseMax(lower_).cwiseMin(upper_);
    trial.moved = trial.x - r_.x;
    trial.clipped = (trial.moved - step).cwiseAbs().maxCoeff() > 0.0;
    trial.promised = -(r_.at.gradient.dot(trial.moved) + 0.5 * trial.moved.dot(r_.at.curvature * trial.moved));
    return trial;
  }

  /// Takes one step, with as much damping as the step needs; true: the search has ended.
  bool iterate() {
    const Scaled s = scaled();
    if (s.moving.empty()) return end(Termination::converged, "every parameter leans on a bound");
    if (s.flat || r_.cost == 0.0) return end(Termination::converged, "the gradient vanishes");
    for (;;) {
      const Trial trial = trial_of(s);
      if (step_is_small(trial.moved, r_.x, options_.step_tolerance))
        return end(Termination::converged, "the step is below the tolerance");
      const bool finite = evaluate(trial.x, next_);
      if (options_.gauss_newton) {
        if (!finite || next_.cost > 1e12 * (first_cost_ + 1e-300))
          return end(Termination::not_finite, "a full Gauss-Newton step left the domain of the model");
        return accept(trial);
      }
      const double fall = r_.cost - next_.cost;
      if (finite && fall > 0.0) {
        const double ratio = trial.promised > 0.0 ? fall / trial.promised : 0.0;
        damping_ = std::max(1e-15, damping_ * std::clamp(1.0 - std::pow(2.0 * ratio - 1.0, 3), 0.1, 2.0));
        growth_ = 2.0;
        return accept(trial);
      }
      if (reject(trial, finite)) return true;
    }
  }

  /// Moves to the trial; true: the cost falls no further.
  bool accept(const Trial& trial) {
    const double before = r_.cost;
    r_.x = trial.x;
    std::swap(r_.at, next_);
    r_.cost = r_.at.cost;
    r_.cost_history.push_back(r_.cost);
    if (options_.gauss_newton || before - r_.cost > options_.cost_tolerance * before ||
        trial.promised > options_.cost_tolerance * before)
      return false;
    ++r_.iterations;
    return end(Termination::converged, "the cost falls no further");
  }

  /// Raises the damping; true: no shorter step can lower the cost.
  bool reject(const Trial& trial, bool finite) {
    // A step that a bound shortened may promise nothing and still hide a descent: shortens it.
    if (finite && !trial.clipped && trial.promised <= std::max(options_.cost_tolerance, 1e-13) * r_.cost)
      return end(Termination::converged, "the cost can fall no further within round-off");
    // Skips damping too small to change the step: an evaluation costs more.
    damping_ = std::max(damping_, kLeastRejected) * growth_;
    growth_ *= 2.0;
    return damping_ > 1e30 && end(Termination::no_descent, "no step lowers the cost");
  }

  const NormalFunction& function_;
  const Eigen::VectorXd& lower_;
  const Eigen::VectorXd& upper_;
  const NormalSearchOptions& options_;
  const std::vector<bool>& held_;
  NormalSearchResult r_;
  NormalEquations next_;
  Eigen::VectorXd scale_;
  double first_cost_ = 0.0;
  double damping_ = 0.0;
  double growth_ = 2.0;
};

}  // namespace

NormalSearchResult minimize_normal(const NormalFunction& function,
                                   const Eigen::VectorXd& lower,
                                   const Eigen::VectorXd& upper,
                                   const Eigen::VectorXd& start,
                                   const NormalSearchOptions& options,
                                   const std::vector<bool>& held) {
  if (start.size() == 0) throw InvalidInput("identification: there is no free parameter");
  return Search(function, lower, upper, options, held).run(start);
}

}  // namespace myoid::identification
