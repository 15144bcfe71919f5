#include "myoid/ground/math/least_squares.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"

namespace myoid::inline ground::math {
namespace {

/// The problem with its bounds filled in, counting evaluations.
struct Search {
  const LeastSquaresProblem& problem;
  const LeastSquaresOptions& options;
  Eigen::VectorXd lower, upper;
  LeastSquaresResult result;

  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    ++result.evaluations;
    problem.evaluate(x, r, jacobian);
  }
  [[nodiscard]] Eigen::VectorXd clipped(const Eigen::VectorXd& x) const { return x.cwiseMax(lower).cwiseMin(upper); }
};

double column_norm(const Eigen::MatrixXd& jacobian, Eigen::Index j) {
  const double norm = jacobian.col(j).norm();
  return norm > 0.0 ? norm : 1.0;
}

/// Returns max |cos(J column, r)| over the variables that may move.
double largest_cosine(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& r, const std::vector<bool>& held) {
  const double norm = r.norm();
  if (norm == 0.0) return 0.0;
  double largest = 0.0;
  for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
    if (!held[static_cast<std::size_t>(j)]) {
      largest = std::max(largest, std::abs(jacobian.col(j).dot(r)) / (column_norm(jacobian, j) * norm));
    }
  }
  return largest;
}

bool step_is_small(const Eigen::VectorXd& step, const Eigen::VectorXd& x, double tolerance) {
  return (step.array().abs() <= tolerance * (x.array().abs() + tolerance)).all();
}

void finish(Search& search, Termination termination, std::string message) {
  LeastSquaresResult& result = search.result;
  result.termination = termination;
  result.message = std::move(message);
  result.at_bound.resize(static_cast<std::size_t>(result.x.size()));
  for (Eigen::Index j = 0; j < result.x.size(); ++j) {
    const double span = std::max(1e-10 * (1.0 + std::abs(result.x[j])), 0.0);
    result.at_bound[static_cast<std::size_t>(j)] =
        result.x[j] - search.lower[j] <= span || search.upper[j] - result.x[j] <= span;
  }
}

/// Steps by d = argmin |J d + r|, by QR of the column-scaled J.
void gauss_newton(Search& search) {
  LeastSquaresResult& result = search.result;
  const std::vector<bool> none(static_cast<std::size_t>(result.x.size()), false);
  for (result.iterations = 0; result.iterations < search.options.max_iterations; ++result.iterations) {
    search.options.progress.check();
    if (!result.jacobian.allFinite()) {
      return finish(search, Termination::not_finite,
                    "the Jacobian is not finite; the search left the domain of the model");
    }
    Eigen::VectorXd scale(result.x.size());
    for (Eigen::Index j = 0; j < scale.size(); ++j) scale[j] = 1.0 / column_norm(result.jacobian, j);
    const Eigen::MatrixXd scaled = result.jacobian * scale.asDiagonal();
    const Eigen::VectorXd step = scale.cwiseProduct(scaled.colPivHouseholderQr().solve(-result.residual).eval());
    const Eigen::VectorXd x = search.clipped(result.x + step);
    Eigen::VectorXd r = result.residual;
    Eigen::MatrixXd jacobian = result.jacobian;
    search.evaluate(x, r, &jacobian);
    const double cost = 0.5 * r.squaredNorm();
    if (!std::isfinite(cost) || !x.allFinite()) {
      return finish(search, Termination::not_finite, "a full Gauss-Newton step left the domain of the model");
    }
    const Eigen::VectorXd moved = x - result.x;
    result.x = x;
    result.residual = r;
    result.jacobian = jacobian;
    result.cost = cost;
    result.cost_history.push_back(cost);
    if (step_is_small(moved, x, search.options.step_tolerance) ||
        largest_cosine(jacobian, r, none) <= search.options.gradient_tolerance || cost == 0.0) {
      ++result.iterations;
      return finish(search, Termination::converged, "the step is below the tolerance");
    }
    if (result.cost > 1e12 * (result.cost_history.front() + 1e-300)) {
      return finish(search, Termination::no_descent, "plain Gauss-Newton steps diverged");
    }
  }
  finish(search, Termination::iteration_limit, fmt::format("not converged after {} iterations", result.iterations));
}

/// The linear problem of one iteration in scaled variables, min |J d + r| with |d| <= radius, ready
/// to be solved for any radius: by the SVD of the triangle of J,
///
///   d(mu) = -sum_i s_i u_i / (s_i^2 + mu) v_i ,     |d(mu)| = radius  unless  |d(0)| <= radius.
class TrustRegion {
 public:
  TrustRegion(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual) {
    const Eigen::Index rows = std::min(jacobian.rows(), jacobian.cols());
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian);
    const Eigen::MatrixXd triangle = qr.matrixQR().topRows(rows).template triangularView<Eigen::Upper>();
    Eigen::VectorXd rotated = residual;
    rotated.applyOnTheLeft(qr.householderQ().adjoint());
    svd_.compute(triangle, Eigen::ComputeThinU | Eigen::ComputeThinV);
    projected_ = svd_.matrixU().transpose() * rotated.head(rows);
    rank_floor_ = 1e-15 * (rows > 0 ? svd_.singularValues()[0] : 0.0);
  }

  /// Returns the step, and whether the radius bounds it.
  [[nodiscard]] Eigen::VectorXd step(double radius) const {
    if (length(0.0) <= radius) return step_of(0.0);
    // Newton on 1/|d(mu)| - 1/radius, which is concave and nearly linear in mu; kept in a bracket.
    double low = 0.0;
    double high = svd_.singularValues().cwiseProduct(projected_).norm() / radius;
    double mu = 1e-3 * high;
    for (int i = 0; i < 60; ++i) {
      const double size = length(mu);
      if (std::abs(size - radius) <= 1e-2 * radius) break;
      (size > radius ? low : high) = mu;
      const double next = mu + (size - radius) / radius * size * size / half_slope(mu);
      mu = next > low && next < high ? next : std::max(std::sqrt(low * high), 1e-3 * high);
    }
    return step_of(mu);
  }

 private:
  [[nodiscard]] double coefficient(Eigen::Index i, double mu) const {
    const double s = svd_.singularValues()[i];
    return s <= rank_floor_ ? 0.0 : s * projected_[i] / (s * s + mu);
  }
  [[nodiscard]] double length(double mu) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < projected_.size(); ++i) sum += std::pow(coefficient(i, mu), 2);
    return std::sqrt(sum);
  }
  /// Returns -d(|d|^2)/dmu / 2.
  [[nodiscard]] double half_slope(double mu) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < projected_.size(); ++i) {
      const double s = svd_.singularValues()[i];
      if (s > rank_floor_) sum += std::pow(coefficient(i, mu), 2) / (s * s + mu);
    }
    return sum;
  }
  [[nodiscard]] Eigen::VectorXd step_of(double mu) const {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(svd_.matrixV().rows());
    for (Eigen::Index i = 0; i < projected_.size(); ++i) d -= coefficient(i, mu) * svd_.matrixV().col(i);
    return d;
  }

  Eigen::JacobiSVD<Eigen::MatrixXd> svd_;
  Eigen::VectorXd projected_;
  double rank_floor_ = 0.0;
};

/// Searches by More's trust region (1978): |D d| <= radius, D the greatest column norms so far, so that the search does
/// not depend on the units of the parameters. The radius follows the gain ratio.
void levenberg_marquardt(Search& search) {
  LeastSquaresResult& result = search.result;
  const Eigen::Index p = result.x.size();
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(p);
  double radius = 0.0;
  for (result.iterations = 0; result.iterations < search.options.max_iterations; ++result.iterations) {
    search.options.progress.check();
    // Variables that lean on a bound and are pushed further out stay there.
    const Eigen::VectorXd gradient = result.jacobian.transpose() * result.residual;
    std::vector<bool> held(static_cast<std::size_t>(p), false);
    std::vector<Eigen::Index> moving;
    for (Eigen::Index j = 0; j < p; ++j) {
      const bool out = (result.x[j] <= search.lower[j] && gradient[j] > 0.0) ||
                       (result.x[j] >= search.upper[j] && gradient[j] < 0.0);
      held[static_cast<std::size_t>(j)] = out;
      if (!out) moving.push_back(j);
      scale[j] = std::max(scale[j], column_norm(result.jacobian, j));
    }
    if (moving.empty()) return finish(search, Termination::converged, "every parameter leans on a bound");
    if (result.cost == 0.0 ||
        largest_cosine(result.jacobian, result.residual, held) <= search.options.gradient_tolerance) {
      return finish(search, Termination::converged, "the gradient vanishes");
    }
    const Eigen::Index q = static_cast<Eigen::Index>(moving.size());
    Eigen::MatrixXd jacobian(result.jacobian.rows(), q);
    for (Eigen::Index k = 0; k < q; ++k) {
      const Eigen::Index j = moving[static_cast<std::size_t>(k)];
      jacobian.col(k) = result.jacobian.col(j) / scale[j];
    }
    const TrustRegion region(jacobian, result.residual);
    if (result.iterations == 0) {
      const double size = scale.cwiseProduct(result.x).norm();
      radius = search.options.initial_radius * (size > 0.0 ? size : 1.0);
    }
    bool accepted = false;
    while (!accepted) {
      const Eigen::VectorXd scaled_step = region.step(radius);
      Eigen::VectorXd step = Eigen::VectorXd::Zero(p);
      for (Eigen::Index k = 0; k < q; ++k) {
        const Eigen::Index j = moving[static_cast<std::size_t>(k)];
        step[j] = scaled_step[k] / scale[j];
      }
      const Eigen::VectorXd x = search.clipped(result.x + step);
      const Eigen::VectorXd moved = x - result.x;
      const bool last = step_is_small(moved, result.x, search.options.step_tolerance);
      const double size = scale.cwiseProduct(moved).norm();
      if (result.cost_history.size() == 1) radius = std::min(radius, scaled_step.norm());
      Eigen::VectorXd r = result.residual;
      Eigen::MatrixXd next = result.jacobian;
      search.evaluate(x, r, nullptr);
      const double cost = 0.5 * r.squaredNorm();
      const double model_cost = 0.5 * (result.residual + result.jacobian * moved).squaredNorm();
      const double promised = result.cost - model_cost;
      const double ratio = std::isfinite(cost) && promised > 0.0 ? (result.cost - cost) / promised : -1.0;
      const double previous = result.cost;
      if (ratio > 1e-4 || (std::isfinite(cost) && cost < result.cost)) {
        search.evaluate(x, r, &next);
        accepted = next.allFinite();
      }
      if (accepted) {
        result.x = x;
        result.residual = r;
        result.jacobian = next;
        result.cost = cost;
        result.cost_history.push_back(cost);
        if (ratio >= 0.75) radius = std::max(radius, 2.0 * size);
        if (ratio <= 0.25) radius = 0.5 * std::min(radius, size);
        if (previous - cost <= search.options.cost_tolerance * previous &&
            promised <= search.options.cost_tolerance * previous) {
          ++result.iterations;
          return finish(search, Termination::converged, "the cost falls no further");
        }
      }
      if (last) {
        return finish(search, Termination::converged, "the step is below the tolerance");
      }
      if (!accepted) {
        // A step that the bounds cut may promise nothing where a shorter one does.
        const bool cut = (result.x + step - x).cwiseAbs().maxCoeff() > 0.0;
        if (!cut && promised <= search.options.cost_tolerance * result.cost) {
          return finish(search, Termination::converged, "the cost can fall no further within round-off");
        }
        // The minimum of the parabola through the cost and its slope here and the cost there.
        const double slope = gradient.dot(moved);
        const double rise = cost - previous;
        const double shrink = std::isfinite(rise) && rise > slope ? -0.5 * slope / (rise - slope) : 0.1;
        radius = std::clamp(shrink, 0.1, 0.5) * std::min(radius, size);
        if (radius < 1e-300) return finish(search, Termination::no_descent, "no step lowers the cost");
      }
    }
  }
  finish(search, Termination::iteration_limit, fmt::format("not converged after {} iterations", result.iterations));
}

Eigen::VectorXd filled(const Eigen::VectorXd& bound, Eigen::Index size, double otherwise, std::string_view what) {
  if (bound.size() == 0) return Eigen::VectorXd::Constant(size, otherwise);
  if (bound.size() != size) {
    throw InvalidInput(fmt::format("least squares: {} {} bounds for {} parameters", bound.size(), what, size));
  }
  return bound;
}

}  // namespace

std::string_view name(Termination termination) {
  switch (termination) {
    case Termination::converged:
      return "converged";
    case Termination::iteration_limit:
      return "iteration_limit";
    case Termination::no_descent:
      return "no_descent";
    case Termination::not_finite:
      return "not_finite";
  }
  return "?";
}

LeastSquaresResult minimize(const LeastSquaresProblem& problem,
                            const Eigen::VectorXd& start,
                            const LeastSquaresOptions& options) {
  const Eigen::Index p = start.size();
  if (p == 0) throw InvalidInput("least squares: there is no free parameter");
  if (problem.residual_count <= 0) throw InvalidInput("least squares: there is no residual");
  Search search{problem,
                options,
                filled(problem.lower, p, -kInfinity, "lower"),
                filled(problem.upper, p, kInfinity, "upper"),
                {}};
  LeastSquaresResult& result = search.result;
  result.x = search.clipped(start);
  result.residual.setZero(problem.residual_count);
  result.jacobian.setZero(problem.residual_count, p);
  search.evaluate(result.x, result.residual, &result.jacobian);
  result.cost = 0.5 * result.residual.squaredNorm();
  if (!std::isfinite(result.cost) || !result.jacobian.allFinite()) {
    throw InvalidInput("least squares: the residual or its Jacobian is not finite at the start");
  }
  result.cost_history.push_back(result.cost);
  options.method == LeastSquaresMethod::gauss_newton ? gauss_newton(search) : levenberg_marquardt(search);
  return std::move(search.result);
}

}  // namespace myoid::inline ground::math
