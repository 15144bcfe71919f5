#include "myoid/intervals/profile_likelihood.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <Eigen/Cholesky>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/intervals/score_blocks.h"

namespace myoid::identification {
namespace {

/// Least fall of C that makes a step of the other variables worth trying, as a share of C's rise to the goal.
constexpr double kSmallFall = 0.05;
constexpr int kMostSteps = 20;
/// Distance of v from the goal, relative, within which the parabola gives the root.
constexpr double kNear = 0.12;
constexpr int kMostDistances = 8;

/// The point that the search for the constrained minimum reached.
struct Point {
  Eigen::VectorXd x, gradient;
  double cost = 0.0;
};

/// C(x) of a problem with variable `held` fixed and the others free within their bounds.
class Constrained {
 public:
  Constrained(const ProfileProblem& problem, Eigen::Index held, double goal)
      : problem_(problem), held_(held), small_fall_(kSmallFall * 0.5 * goal * goal), curvature_(problem.curvature) {}

  [[nodiscard]] Point at(Eigen::VectorXd x) const {
    Point point{std::move(x), {}, 0.0};
    point.cost = problem_.cost(point.x, point.gradient);
    return point;
  }

  /// Returns the others' step to the minimum of the model of C within the bounds. Variables that
  /// would leave the bounds stop there, and the rest adapts.
  [[nodiscard]] Eigen::VectorXd step_from(const Point& from) const {
    const Eigen::VectorXd down = problem_.lower - from.x, up = problem_.upper - from.x;
    std::vector<Eigen::Index> moving;
    for (Eigen::Index k = 0; k < from.x.size(); ++k) {
      const bool out = (down[k] >= 0.0 && from.gradient[k] >= 0.0) || (up[k] <= 0.0 && from.gradient[k] <= 0.0);
      if (k != held_ && !out) moving.push_back(k);
    }
    Eigen::VectorXd step = Eigen::VectorXd::Zero(from.x.size());
    while (!moving.empty()) {
      step(moving).setZero();
      const Eigen::VectorXd slope = from.gradient + curvature_ * step;
      step(moving) = solve(moving, -slope(moving));
      std::vector<Eigen::Index> inside;
      for (const Eigen::Index k : moving) {
        if (step[k] > down[k] && step[k] < up[k]) inside.push_back(k);
        step[k] = std::clamp(step[k], down[k], up[k]);
      }
      if (inside.size() == moving.size()) break;
      moving = std::move(inside);
    }
    return step;
  }

  [[nodiscard]] double fall_of(const Point& from, const Eigen::VectorXd& step) const {
    return -(from.gradient.dot(step) + 0.5 * step.dot(curvature_ * step));
  }

  /// Updates the model by BFGS with the gradient's change along a step.
  void learn(const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
    const double along = step.dot(change);
    const Eigen::VectorXd expected = curvature_ * step;
    const double before = step.dot(expected);
    if (!(along > 1e-3 * before) || !(before > 0.0)) return;
    curvature_ += change * change.transpose() / along - expected * expected.transpose() / before;
  }

  /// Brings the others to their minimum and returns the point that the last step promises.
  Point minimize(Point best) {
    double shorter = 1.0;
    for (int count = 0;; ++count) {
      const Eigen::VectorXd step = shorter * step_from(best);
      const double promised = fall_of(best, step);
      if (count == kMostSteps || !(promised > small_fall_)) {
        best.x += step;
        best.cost -= std::max(promised, 0.0);
        best.gradient += curvature_ * step;
        return best;
      }
      Point next = at(best.x + step);
      if (!std::isfinite(next.cost)) {
        shorter *= 0.25;
        continue;
      }
      learn(step, next.gradient - best.gradient);
      const bool better = next.cost < best.cost;
      shorter = better ? 1.0 : 0.5 * shorter;
      if (better) best = std::move(next);
    }
  }

  /// Solves C_mm x = b, with the columns scaled to 1.
  [[nodiscard]] Eigen::VectorXd solve(const std::vector<Eigen::Index>& moving, const Eigen::VectorXd& b) const {
    Eigen::MatrixXd matrix = curvature_(moving, moving);
    const Eigen::VectorXd scale = matrix.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
    matrix.diagonal().array() += 1e-10;
    return scale.cwiseProduct(matrix.ldlt().solve(scale.cwiseProduct(b)));
  }

 private:
  const ProfileProblem& problem_;
  Eigen::Index held_;
  double small_fall_;
  Eigen::MatrixXd curvature_;
};

/// Returns the root of v = goal on the parabola through (0, 0) and (t, v) with this slope at t.
double parabola_root(double t, double v, double slope, double goal) {
  if (!(v > 0.0)) return 4.0 * t;
  const double a = 2.0 * v / t - slope;
  const double b = (slope - v / t) / t;
  const double square = a * a + 4.0 * b * goal;
  const double root = a + std::sqrt(std::max(square, 0.0));
  if (square >= 0.0 && root > 0.0) return 2.0 * goal / root;
  return slope > 0.0 ? t + (goal - v) / slope : 4.0 * t;
}

}  // namespace

std::optional<double> profile_distance(const ProfileProblem& problem, Eigen::Index j, bool above, double goal) {
  const double side = above ? 1.0 : -1.0;
  const Eigen::VectorXd& minimum = problem.minimum;
  const double reach = std::abs((above ? problem.upper[j] : problem.lower[j]) - minimum[j]);
  if (!(reach > 0.0)) return std::nullopt;
  Constrained others(problem, j, goal);
  // The others' response to variable j, to first order; variables on a bound stay.
  std::vector<Eigen::Index> following;
  for (Eigen::Index k = 0; k < minimum.size(); ++k) {
    const bool held = (minimum[k] <= problem.lower[k] && problem.gradient[k] > 0.0) ||
                      (minimum[k] >= problem.upper[k] && problem.gradient[k] < 0.0);
    if (k != j && !held) following.push_back(k);
  }
  Eigen::VectorXd along = Eigen::VectorXd::Zero(minimum.size());
  along(following) = others.solve(following, -problem.curvature(following, j).eval());
  along[j] = 1.0;
  const double stiffness = along.dot(problem.curvature * along);
  // The curvature of the others' path, from the last minimum.
  Eigen::VectorXd bend = Eigen::VectorXd::Zero(minimum.size());
  double near = 0.0, beyond = reach;
  bool bracketed = false;
  double t = stiffness > 0.0 ? std::min(goal / std::sqrt(stiffness), reach) : reach;
  for (int count = 0; count < kMostDistances; ++count) {
    Eigen::VectorXd start = minimum + (side * t) * along + (t * t) * bend;
    start[j] = minimum[j] + side * t;
    start = start.cwiseMax(problem.lower).cwiseMin(problem.upper);
    const Point found = others.minimize(others.at(std::move(start)));
    const double v = std::sqrt(std::max(0.0, 2.0 * (found.cost - problem.least)));
    const double root = parabola_root(t, v, side * found.gradient[j] / std::max(v, 1e-300), goal);
    const bool same = std::abs(v - goal) < kNear * goal && std::abs(root - t) < 2.0 * kNear * t;
    if (same && root <= reach) return root;
    if (v < goal) {
      if (t >= reach * (1.0 - 1e-12)) return std::nullopt;
      near = t;
    } else {
      beyond = t;
      bracketed = true;
    }
    bend = (found.x - minimum - (side * t) * along) / (t * t);
    const double margin = bracketed ? 0.05 * (beyond - near) : 0.0;
    t = std::clamp(root, std::max(near + margin, 0.25 * t), std::min(beyond - margin, 4.0 * t));
  }
  // The steps ran out; the bracket is close enough.
  return bracketed ? std::optional<double>(0.5 * (near + beyond)) : std::nullopt;
}

std::vector<Interval> profile(const Estimator& estimator,
                              const Estimator::Solution& solution,
                              const Eigen::VectorXd& variance) {
  const Eigen::Index p = solution.search.x.size();
  const NormalEquations there =
      estimator.normal_equations(solution.search.x, solution.weighting, Derivatives::curvature);
  const ProfileProblem problem{.cost =
                                   [&](const Eigen::VectorXd& z, Eigen::VectorXd& gradient) {
                                     estimator.options().progress.check();
                                     NormalEquations at =
                                         estimator.normal_equations(z, solution.weighting, Derivatives::gradient);
                                     gradient = std::move(at.gradient);
                                     return at.cost;
                                   },
                               .lower = estimator.lower(),
                               .upper = estimator.upper(),
                               .minimum = solution.search.x,
                               .least = there.cost,
                               .gradient = there.gradient,
                               .curvature = there.curvature};
  const Eigen::ArrayXd ratio = variance.array() / inverse_of(there.curvature).diagonal().array().max(1e-300);
  const Eigen::ArrayXd rise = (ratio.isFinite() && ratio > 0.0).select(ratio, 1.0);
  std::vector<Interval> intervals(static_cast<std::size_t>(p));
  std::atomic<int> done = 0;
  oneapi::tbb::parallel_for(Eigen::Index{0}, 2 * p, [&](Eigen::Index task) {
    const Eigen::Index j = task / 2;
    const bool above = task % 2 == 1;
    const double goal = kNormal95 * std::sqrt(rise[j]);
    if (const auto distance = profile_distance(problem, j, above, goal)) {
      Interval& interval = intervals[static_cast<std::size_t>(j)];
      (above ? interval.high : interval.low) = problem.minimum[j] + (above ? *distance : -*distance);
    }
    estimator.options().progress.tell(static_cast<double>(++done) / static_cast<double>(2 * p), "profiles");
  });
  return intervals;
}

}  // namespace myoid::identification
