#include "myoid/body/forces/actuator_sharing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::body {
namespace {

constexpr double kSteepest = 1e8;  ///< Limit of a control's slope, infinite at 0 for p > 2.

/// The dual problem with its rows scaled to unit length.
class Dual {
 public:
  Dual(Eigen::MatrixXd a, Eigen::VectorXd b, Eigen::VectorXd lower, Eigen::VectorXd upper, double p)
      : a_(std::move(a)), b_(std::move(b)), lower_(std::move(lower)), upper_(std::move(upper)), p_(p) {
    x_.resize(a_.cols());
    slope_.resize(a_.cols());
  }

  /// Computes controls, gap and value at lambda.
  void evaluate(const Eigen::VectorXd& lambda) {
    pull_.noalias() = a_.transpose() * lambda;
    value_ = lambda.dot(b_);
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      double slope = 0.5;
      double x = 0.5 * pull_[i];
      if (p_ != 2.0) {
        const double size = std::pow(std::abs(pull_[i]) / p_, 1.0 / (p_ - 1.0));
        x = std::copysign(size, pull_[i]);
        slope = std::min(size / ((p_ - 1.0) * std::max(std::abs(pull_[i]), 1e-300)), kSteepest);
      }
      if (x <= lower_[i]) {
        x = lower_[i];
        slope = 0.0;
      } else if (x >= upper_[i]) {
        x = upper_[i];
        slope = 0.0;
      }
      x_[i] = x;
      slope_[i] = slope;
      value_ += (p_ == 2.0 ? x * x : std::pow(std::abs(x), p_)) - pull_[i] * x;
    }
    gap_ = b_;
    gap_.noalias() -= a_ * x_;
  }

  [[nodiscard]] Eigen::MatrixXd curvature(bool all_free) const {
    const Eigen::VectorXd slope = all_free ? Eigen::VectorXd::Constant(x_.size(), 0.5).eval() : slope_;
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(a_.rows(), a_.rows());
    h.selfadjointView<Eigen::Lower>().rankUpdate(Eigen::MatrixXd(a_ * slope.cwiseSqrt().asDiagonal()));
    return h;
  }

  [[nodiscard]] const Eigen::MatrixXd& a() const { return a_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }
  [[nodiscard]] const Eigen::VectorXd& x() const { return x_; }
  [[nodiscard]] const Eigen::VectorXd& gap() const { return gap_; }
  [[nodiscard]] double value() const { return value_; }

 private:
  Eigen::MatrixXd a_;
  Eigen::VectorXd b_, lower_, upper_;
  double p_;
  Eigen::VectorXd pull_, x_, slope_, gap_;
  double value_ = 0.0;
};

struct Maximum {
  Eigen::VectorXd lambda;
  int iterations = 0;
  bool balanced = false;
};

Maximum maximize(Dual& dual, Eigen::VectorXd lambda) {
  Maximum best{std::move(lambda), 0, false};
  const Eigen::Index m = dual.b().size();
  dual.evaluate(best.lambda);
  // Round-off of a row's sum.
  const double tolerance = 1e-14 * std::max(dual.b().cwiseAbs().maxCoeff(), dual.a().cwiseAbs().maxCoeff());
  const double size = std::max(dual.curvature(true).diagonal().mean(), 1e-300);
  double damping = 1e-12;
  int stalls = 0;
  for (; best.iterations < 200; ++best.iterations) {
    const double gap = dual.gap().cwiseAbs().maxCoeff();
    if (gap <= tolerance) break;
    if (best.lambda.cwiseAbs().maxCoeff() > 1e12) break;  // unbounded: the problem has no solution
    Eigen::MatrixXd h = dual.curvature(false);
    h.diagonal().array() += damping * size;
    const Eigen::LDLT<Eigen::MatrixXd> factor(h);
    const Eigen::VectorXd step = factor.solve(dual.gap());
    const double rise = dual.gap().dot(step);
    const double value = dual.value();
    const double round_off = 1e-13 * (std::abs(value) + 1.0);
    bool moved = false;
    for (double share = 1.0; share > 1e-10; share *= 0.5) {
      const Eigen::VectorXd next = best.lambda + share * step;
      dual.evaluate(next);
      const double gap_then = dual.gap().cwiseAbs().maxCoeff();
      if (dual.value() >= value + 1e-4 * share * rise || (gap_then < 0.9 * gap && dual.value() >= value - round_off)) {
        stalls = gap_then < 0.5 * gap ? 0 : stalls + 1;
        best.lambda = next;
        damping = std::max(0.1 * damping, 1e-12);
        moved = true;
        break;
      }
    }
    if (!moved) {
      dual.evaluate(best.lambda);
      damping *= 100.0;
      if (damping > 1e6) break;
    }
  }
  dual.evaluate(best.lambda);
  best.balanced = dual.gap().cwiseAbs().maxCoeff() <= 1e5 * tolerance && m > 0;
  return best;
}

void check(const ActuatorProblem& problem) {
  const Eigen::Index n = problem.forces.cols();
  if (problem.required.size() != problem.forces.rows() || problem.lower.size() != n || problem.upper.size() != n) {
    throw InvalidInput(fmt::format("actuators: sizes disagree for {} actuators and {} rows", n, problem.forces.rows()));
  }
  if (!(problem.exponent > 1.0))
    throw InvalidInput(fmt::format("actuators: exponent {}, expected above 1", problem.exponent));
  if (!(problem.lower.array() <= problem.upper.array()).all())
    throw InvalidInput("actuators: a lower bound lies above its upper bound");
  if (!problem.forces.allFinite() || !problem.required.allFinite())
    throw InvalidInput("actuators: a force is not a number");
}

double certificate(const ActuatorProblem& problem, const ActuatorSolution& s) {
  const Eigen::VectorXd& x = s.control;
  const double p = problem.exponent;
  double worst = 0.0;
  const Eigen::VectorXd gap = problem.required - problem.forces * x;
  for (Eigen::Index k = 0; k < gap.size(); ++k) {
    const double scale = std::max(std::abs(problem.required[k]), problem.forces.row(k).cwiseAbs().dot(x.cwiseAbs()));
    if (scale > 0.0) worst = std::max(worst, std::abs(gap[k]) / scale);
  }
  const Eigen::VectorXd pull = problem.forces.transpose() * s.multiplier;
  const Eigen::VectorXd parts = problem.forces.cwiseAbs().transpose() * s.multiplier.cwiseAbs();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double slope = std::copysign(p * std::pow(std::abs(x[i]), p - 1.0), x[i]);
    double violation = slope - pull[i];
    if (problem.lower[i] == problem.upper[i]) continue;
    if (x[i] <= problem.lower[i]) violation = std::min(violation, 0.0);
    if (x[i] >= problem.upper[i]) violation = std::max(violation, 0.0);
    const double scale = std::max({std::abs(slope), parts[i], 1e-3});
    worst = std::max({worst, std::abs(violation) / scale, problem.lower[i] - x[i], x[i] - problem.upper[i]});
  }
  return worst;
}

/// Returns the multipliers of the least-squares controls without bounds.
Eigen::VectorXd unbounded(const Dual& dual) {
  Eigen::MatrixXd h = dual.curvature(true);
  h.diagonal().array() += 1e-12;
  return h.selfadjointView<Eigen::Lower>().ldlt().solve(dual.b());
}

/// The controls of least sum |x|^q for rising q up to p, each by Newton's method from the controls before. A step is
/// the problem of exponent 2 with weights |x|^(q-2) and targets x (q-2)/(q-1), which the dual solves.
class RisingExponent {
 public:
  RisingExponent(const ActuatorProblem& problem, const Dual& scaled, Eigen::VectorXd start)
      : problem_(problem), scaled_(scaled), x_(std::move(start)) {}

  /// Leaves the controls in x().
  void run() {
    constexpr double kRise = 1.5;
    constexpr int kMostSteps = 60;
    for (double q = std::min(problem_.exponent, 2.0 * kRise);; q = std::min(problem_.exponent, q * kRise)) {
      for (int step = 0; step < kMostSteps && take_step(q); ++step) ++steps_;
      if (q >= problem_.exponent) return;
    }
  }
  [[nodiscard]] const Eigen::VectorXd& x() const { return x_; }
  /// Returns the multipliers of the scaled rows that agree best with the slopes of the free controls.
  [[nodiscard]] Eigen::VectorXd lambda() const {
    const double p = problem_.exponent, size = std::max(x_.cwiseAbs().maxCoeff(), 1e-300);
    Eigen::MatrixXd rows = scaled_.a().transpose();
    Eigen::VectorXd slope(x_.size());
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      slope[i] = std::copysign(std::pow(std::abs(x_[i]) / size, p - 1.0), x_[i]);
      const bool is_free = x_[i] > problem_.lower[i] && x_[i] < problem_.upper[i];
      const double weight = is_free ? 1.0 / std::max(std::abs(slope[i]), 1e-3) : 0.0;
      slope[i] *= weight;
      rows.row(i) *= weight;
    }
    return math::shortest_solution(rows, slope) * (p * std::pow(size, p - 1.0));
  }
  [[nodiscard]] int steps() const { return steps_; }

 private:
  /// Returns false if the controls are optimal or cannot be improved.
  bool take_step(double q) {
    constexpr double kLeastWeight = 1e-14;  // of the greatest: controls below it cost nothing
    const double size = std::max(x_.cwiseAbs().maxCoeff(), 1e-300);
    const Eigen::VectorXd weight = (x_.cwiseAbs() / size).array().pow(q - 2.0).max(kLeastWeight);
    const Eigen::VectorXd target = x_ * ((q - 2.0) / (q - 1.0));
    const Eigen::VectorXd root = weight.cwiseSqrt();
    Eigen::MatrixXd rows = scaled_.a() * root.cwiseInverse().asDiagonal();
    Eigen::VectorXd rest = scaled_.b() - scaled_.a() * target;
    normalize(rows, rest);
    Dual step(std::move(rows), std::move(rest), root.cwiseProduct(problem_.lower - target),
              root.cwiseProduct(problem_.upper - target), 2.0);
    (void)maximize(step, unbounded(step));
    Eigen::VectorXd next = (target + step.x().cwiseQuotient(root)).cwiseMax(problem_.lower).cwiseMin(problem_.upper);
    constexpr int kRefinements = 3;
    for (int k = 0; k < kRefinements; ++k) balance(root, next);
    const Eigen::VectorXd way = next - x_;
    const auto cost = [&](const Eigen::VectorXd& x) { return (x.cwiseAbs() / size).array().pow(q).sum(); };
    const double before = cost(x_);
    constexpr double kRoundOff = 1e-14;
    for (double share = 1.0; share > 1e-6; share *= 0.5) {
      const Eigen::VectorXd tried = x_ + share * way;
      if (cost(tried) > before * (1.0 + kRoundOff)) continue;
      x_ = share == 1.0 ? next : tried;
      return way.cwiseAbs().maxCoeff() > 1e-13 * size;
    }
    return false;
  }

  /// Removes the rest of the rows that rounding leaves: by the least change of the controls between their bounds, each
  /// weighed by its root.
  void balance(const Eigen::VectorXd& root, Eigen::VectorXd& x) const {
    Eigen::VectorXd rest = scaled_.b() - scaled_.a() * x;
    Eigen::MatrixXd rows = scaled_.a() * root.cwiseInverse().asDiagonal();
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (x[i] <= problem_.lower[i] || x[i] >= problem_.upper[i]) rows.col(i).setZero();
    normalize(rows, rest);
    const Eigen::VectorXd change = math::shortest_solution(rows, rest).cwiseQuotient(root);
    x = (x + change).cwiseMax(problem_.lower).cwiseMin(problem_.upper);
  }

  static void normalize(Eigen::MatrixXd& rows, Eigen::VectorXd& right) {
    for (Eigen::Index k = 0; k < right.size(); ++k) {
      const double length = rows.row(k).norm();
      if (!(length > 0.0)) continue;
      rows.row(k) /= length;
      right[k] /= length;
    }
  }

  const ActuatorProblem& problem_;
  const Dual& scaled_;
  Eigen::VectorXd x_;
  int steps_ = 0;
};

/// Finds the nearest controls if the actuators cannot produce the required torques: costly extra
/// actuators produce the rest.
void take_nearest(const ActuatorProblem& problem,
                  const Dual& dual,
                  const Eigen::VectorXd& scale,
                  ActuatorSolution& solution) {
  const Eigen::Index m = problem.required.size();
  const Eigen::Index n = problem.forces.cols();
  const double strength = 1e-3;
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd a(m, n + m);
  a << dual.a(), strength * Eigen::MatrixXd::Identity(m, m);
  Eigen::VectorXd lower(n + m), upper(n + m);
  lower << problem.lower, Eigen::VectorXd::Constant(m, -infinity);
  upper << problem.upper, Eigen::VectorXd::Constant(m, infinity);
  Dual helped(std::move(a), dual.b(), std::move(lower), std::move(upper), problem.exponent);
  const Maximum nearest = maximize(helped, Eigen::VectorXd::Zero(m));
  solution.control = helped.x().head(n);
  solution.multiplier = scale.cwiseProduct(nearest.lambda);
  solution.iterations += nearest.iterations;
  solution.kkt_residual = certificate(problem, solution);
  solution.feasible = false;
  solution.solved = false;
}

}  // namespace

ActuatorSolution solve_actuators(const ActuatorProblem& problem, const Eigen::VectorXd* start) {
  check(problem);
  const Eigen::Index m = problem.required.size();
  const Eigen::Index n = problem.forces.cols();
  ActuatorSolution solution;
  if (m == 0) {
    solution.control = Eigen::VectorXd::Zero(n).cwiseMax(problem.lower).cwiseMin(problem.upper);
    solution.multiplier.resize(0);
    solution.solved = true;
    return solution;
  }
  Eigen::VectorXd scale(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    const double norm = problem.forces.row(k).norm();
    scale[k] = norm > 0.0 ? 1.0 / norm : 1.0;
  }
  Dual dual(scale.asDiagonal() * problem.forces, scale.cwiseProduct(problem.required), problem.lower, problem.upper,
            problem.exponent);
  const bool started = start != nullptr && start->size() == m;
  Maximum best = maximize(dual, started ? start->cwiseQuotient(scale) : unbounded(dual));
  if (!best.balanced && start != nullptr) best = maximize(dual, unbounded(dual));
  solution.control = dual.x();
  solution.multiplier = scale.cwiseProduct(best.lambda);
  solution.iterations = best.iterations;
  solution.kkt_residual = certificate(problem, solution);
  solution.solved = best.balanced && solution.kkt_residual <= 1e-9;
  if (best.balanced || problem.exponent <= 2.0) {
    if (!best.balanced) take_nearest(problem, dual, scale, solution);
    return solution;
  }
  // The exponent has no part in the question whether the actuators can produce b.
  Dual squares(dual.a(), dual.b(), problem.lower, problem.upper, 2.0);
  const Maximum least = maximize(squares, unbounded(squares));
  if (!least.balanced) {
    take_nearest(problem, dual, scale, solution);
    return solution;
  }
  RisingExponent rising(problem, dual, squares.x());
  rising.run();
  solution.control = rising.x();
  solution.multiplier = scale.cwiseProduct(rising.lambda());
  solution.iterations += least.iterations + rising.steps();
  solution.kkt_residual = certificate(problem, solution);
  solution.solved = solution.kkt_residual <= 1e-9;
  return solution;
}

}  // namespace myoid::body
