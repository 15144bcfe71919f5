#include "myoid/fit/posterior/mode.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::fit {
namespace {

constexpr int kMostIterations = 300;
constexpr double kOfFresh = 10.0;          // a promise by Gauss and Newton's curvature over the search's
constexpr double kStillToGo = 0.95;        // of the search behind an iteration
constexpr double kLonger = 2.6;            // the first share of a step over the share of the step before
constexpr double kDifference = 1.0 / 3.0;  // standard deviations
constexpr double kLeastCurvature = 0.1;    // over Gauss and Newton's curvature

}  // namespace

Mode find_mode(const Density& density,
               const Mode& start,
               const Progress& progress,
               double least_promise,
               const std::function<bool(const Eigen::VectorXd&)>& is_known) {
  Mode mode{.x = start.x, .covariance = start.covariance};
  Eigen::VectorXd gradient;
  mode.log_density = density.value(mode.x, gradient);
  if (!std::isfinite(mode.log_density)) {
    mode.message = "the density is not finite at the starting values";
    return mode;
  }
  Eigen::MatrixXd& inverse = mode.covariance;
  const bool rough = least_promise > kFinePromise;
  bool fresh = false;
  double last_share = 1.0;
  const auto refresh = [&] {
    inverse = math::inverse_of_positive(density.gauss_newton(mode.x));
    fresh = true;
    last_share = 1.0;
  };
  if (inverse.size() == 0) refresh();
  Eigen::VectorXd at_trial;
  for (mode.iterations = 0; mode.iterations < kMostIterations; ++mode.iterations) {
    progress.check();
    progress.tell(1.0 - std::pow(kStillToGo, mode.iterations), kFits);
    Eigen::VectorXd step = inverse * gradient;
    double promise = 0.5 * gradient.dot(step);
    if (promise >= 0.0 && promise < (fresh && !rough ? kOfFresh : 1.0) * least_promise) {
      if (fresh || rough) {
        mode.converged = true;
        break;
      }
      // The quasi-Newton steps may have learned a wrong curvature; Gauss and Newton's replaces it.
      refresh();
      continue;
    }
    // Near a bound the map of the bounds makes one entry's step very long; only this entry is cut.
    const Eigen::VectorXd longest = density.longest_step(mode.x);
    step = step.cwiseMax(-longest).cwiseMin(longest);
    promise = 0.5 * gradient.dot(step);
    double share = std::min(1.0, kLonger * last_share), value = 0.0;
    bool climbed = false;
    for (int halvings = 0; halvings < 12 && promise > 0.0; ++halvings, share *= 0.4) {
      value = density.value(mode.x + share * step, at_trial);
      climbed = std::isfinite(value) && value > mode.log_density + 1e-4 * share * gradient.dot(step);
      if (climbed) break;
    }
    if (!climbed) {
      if (fresh) {
        mode.converged = promise < 100.0 * kFinePromise;
        mode.message = fmt::format("no step climbs, and {:.2g} of ln density are promised", promise);
        break;
      }
      refresh();
      continue;
    }
    last_share = share;
    const Eigen::VectorXd moved = share * step, turned = gradient - at_trial;
    const double bend = moved.dot(turned);
    if (bend > 1e-12 * moved.norm() * turned.norm()) {
      const Eigen::VectorXd seen = inverse * turned;
      inverse += (1.0 + turned.dot(seen) / bend) / bend * moved * moved.transpose() -
                 (moved * seen.transpose() + seen * moved.transpose()) / bend;
      fresh = false;
    }
    mode.x += moved;
    mode.log_density = value;
    gradient = at_trial;
    if (is_known && is_known(mode.x)) {
      mode.message = "leads to a known mode";
      break;
    }
  }
  if (mode.converged) {
    mode.message = "converged";
  } else if (mode.message.empty()) {
    mode.message = fmt::format("not at the top after {} steps", kMostIterations);
  }
  return mode;
}

void add_curvature(const Density& density, bool exact, Mode& mode, const Progress& progress) {
  const Eigen::Index d = density.size();
  const Eigen::MatrixXd expected = density.gauss_newton(mode.x);
  const Eigen::VectorXd scale = expected.diagonal().cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd h = expected;
  if (exact) {
    parallel_ranges(d, Eigen::Index{1}, [&](const auto& range) {
      for (Eigen::Index j = range.begin(); j < range.end(); ++j) {
        progress.check();
        const Eigen::VectorXd step = kDifference * scale[j] * Eigen::VectorXd::Unit(d, j);
        Eigen::VectorXd above = Eigen::VectorXd::Zero(d), below = Eigen::VectorXd::Zero(d);
        const bool finite =
            std::isfinite(density.value(mode.x + step, above)) && std::isfinite(density.value(mode.x - step, below));
        h.col(j) = finite ? Eigen::VectorXd((below - above) / (2.0 * kDifference * scale[j]))
                          : Eigen::VectorXd(expected.col(j));
      }
    });
  }
  const Eigen::MatrixXd scaled = scale.asDiagonal() * (0.5 * (h + h.transpose())).eval() * scale.asDiagonal();
  const Eigen::MatrixXd scaled_expected = scale.asDiagonal() * expected * scale.asDiagonal();
  const math::SymmetricEigen eigen = math::symmetric_eigen(scaled);
  Eigen::VectorXd curvature = eigen.values;
  for (Eigen::Index j = 0; j < d; ++j) {
    const auto direction = eigen.vectors.col(j);
    curvature[j] = std::max(curvature[j], kLeastCurvature * direction.dot(scaled_expected * direction));
  }
  const Eigen::MatrixXd root = scale.asDiagonal() * eigen.vectors * curvature.cwiseSqrt().cwiseInverse().asDiagonal();
  mode.covariance = root * root.transpose();
  mode.log_evidence = mode.log_density + 0.5 * static_cast<double>(d) * std::log(2.0 * std::numbers::pi) +
                      scale.array().log().sum() - 0.5 * curvature.array().log().sum();
}

}  // namespace myoid::fit
