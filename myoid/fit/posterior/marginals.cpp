#include "myoid/fit/posterior/marginals.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/draws.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

constexpr double kGridEnd = 9.0;  // standard deviations
constexpr double kGridStep = 0.05;
constexpr double kLeastSlope = 0.5, kMostSlope = 8.0;  // of a tail; a normal one has 2
constexpr double kLeastBend = 0.2, kMostBend = 4.0;    // of a tail; a normal one has 1
constexpr double kLeastFall = 0.5, kMostFall = 8.0;    // of ln density to a side; a normal one has 2
constexpr double kMostPromise = 2.0;                   // of ln density: the most that a step of Newton may promise
constexpr double kSmallPromise = 0.02;                 // of ln density: a smaller one is believed without a step
constexpr double kMostDrift = 2.0;                     // standard deviations by which a volume may move a mean

/// Returns the cubic on [0, 2] with value and slope 0 at 0.
double hermite(const Marginal::Side& side, double outward_slope, double distance) {
  const double x = distance / Marginal::kSide;
  return x * x * (side.log_density * (3.0 - 2.0 * x) + Marginal::kSide * outward_slope * (x - 1.0));
}

/// Returns minus the cubic's second derivative at 2, clamped.
double tail_curvature(const Marginal::Side& side, double outward_slope) {
  const double at_side =
      (4.0 * Marginal::kSide * outward_slope - 6.0 * side.log_density) / (Marginal::kSide * Marginal::kSide);
  return std::clamp(-at_side, kLeastBend, kMostBend);
}

Marginal::Side side_of(const LogDensity& density, const Mode& mode, Eigen::Index j, double sign) {
  const Marginal::Side normal{-2.0, -2.0 * sign};
  const Eigen::VectorXd response = mode.covariance.col(j) / std::sqrt(mode.covariance(j, j));  // C e_j / sd_j
  const auto follow = [&](const Eigen::VectorXd& gradient) -> Eigen::VectorXd {
    return mode.covariance * gradient - response * response.dot(gradient);
  };
  Eigen::VectorXd x = mode.x + sign * Marginal::kSide * response, gradient;
  double value = density(x, gradient);
  if (!std::isfinite(value)) return normal;
  const Eigen::VectorXd step = follow(gradient);
  if (0.5 * gradient.dot(step) > kSmallPromise) {
    Eigen::VectorXd there;
    const double reached = density(x + step, there);
    if (std::isfinite(reached) && reached > value) {
      value = reached;
      gradient = there;
    }
  }
  value += std::min(kMostPromise, 0.5 * gradient.dot(follow(gradient)));
  const double fall = std::clamp(mode.log_density - value, kLeastFall, kMostFall);
  const double slope = std::clamp(-sign * response.dot(gradient), kLeastSlope, kMostSlope);
  return {-fall, -sign * slope};
}

/// Returns w, from second differences of the gradient along the columns of a root of C.
Eigen::VectorXd third_derivatives(const LogDensity& density, const Mode& mode, const Progress& progress) {
  const Eigen::Index d = mode.x.size();
  const Eigen::MatrixXd root = mode.covariance.llt().matrixL();
  Eigen::VectorXd at_mode;
  density(mode.x, at_mode);
  Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(d, d);
  parallel_ranges(d, Eigen::Index{1}, [&](const auto& range) {
    for (Eigen::Index k = range.begin(); k < range.end(); ++k) {
      progress.check();
      Eigen::VectorXd above, below;
      if (std::isfinite(density(mode.x + root.col(k), above)) && std::isfinite(density(mode.x - root.col(k), below)))
        parts.col(k) = above + below - 2.0 * at_mode;
    }
  });
  return parts.rowwise().sum();
}

}  // namespace

Marginal::Marginal(const Side& below, const Side& above, double drift) : sides_{below, above}, drift_(drift) {
  const auto count = static_cast<std::size_t>(std::lround(2.0 * kGridEnd / kGridStep)) + 1;
  share_.resize(count);
  double sum = 0.0, before = std::exp(log_density(-kGridEnd));
  for (std::size_t i = 1; i < count; ++i) {
    const double here = std::exp(log_density(-kGridEnd + static_cast<double>(i) * kGridStep));
    share_[i] = sum += 0.5 * (before + here);
    before = here;
  }
  for (double& share : share_) share /= sum;
}

double Marginal::log_density(double t) const {
  const Side& side = sides_[t < 0.0 ? 0 : 1];
  const double outward = t < 0.0 ? -side.slope : side.slope, distance = std::abs(t);
  if (distance > kSide) {
    const double beyond = distance - kSide;
    return side.log_density + beyond * (outward - 0.5 * beyond * tail_curvature(side, outward)) + drift_ * t;
  }
  return hermite(side, outward, distance) + drift_ * t;
}

double Marginal::at(double normal) const {
  const double wanted = math::normal_below(normal);
  const auto above = std::upper_bound(share_.begin(), share_.end(), wanted);
  if (above == share_.begin()) return -kGridEnd;
  if (above == share_.end()) return kGridEnd;
  const double low = *(above - 1), high = *above;
  const double place = high > low ? (wanted - low) / (high - low) : 0.0;
  return -kGridEnd + kGridStep * (static_cast<double>(above - share_.begin() - 1) + place);
}

std::vector<Marginal> marginals(const LogDensity& density,
                                const Mode& mode,
                                Eigen::Index followed,
                                const Progress& progress) {
  std::vector<Marginal::Side> sides(static_cast<std::size_t>(2 * followed));
  std::atomic<int> done{0};
  parallel_ranges(2 * followed, Eigen::Index{1}, [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      progress.check();
      // The modes come before, in the first half of a fit.
      progress.tell(0.5 + 0.2 * static_cast<double>(++done) / static_cast<double>(followed), "finds intervals");
      sides[static_cast<std::size_t>(i)] = side_of(density, mode, i / 2, i % 2 == 0 ? -1.0 : 1.0);
    }
  });
  const Eigen::VectorXd w = third_derivatives(density, mode, progress);
  std::vector<Marginal> found;
  for (Eigen::Index j = 0; j < followed; ++j) {
    const Marginal::Side &below = sides[static_cast<std::size_t>(2 * j)],
                         &above = sides[static_cast<std::size_t>(2 * j + 1)];
    const double along = mode.covariance.col(j).dot(w) / std::sqrt(mode.covariance(j, j)),
                 own = (below.slope + above.slope) / (Marginal::kSide * Marginal::kSide);
    found.emplace_back(below, above, std::clamp(0.5 * (along - own), -kMostDrift, kMostDrift));
  }
  found.resize(static_cast<std::size_t>(mode.x.size()), Marginal({-2.0, 2.0}, {-2.0, -2.0}));
  return found;
}

Eigen::MatrixXd draw_about(const Mode& mode,
                           const std::vector<Marginal>& marginals,
                           Eigen::Index count,
                           std::uint64_t seed) {
  Eigen::MatrixXd draws = math::draw_normal(Eigen::VectorXd::Zero(mode.x.size()), mode.covariance, count, seed);
  const Eigen::VectorXd sd = mode.covariance.diagonal().cwiseSqrt();
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < sd.size(); ++j)
      draws(j, i) = mode.x[j] + sd[j] * marginals[static_cast<std::size_t>(j)].at(draws(j, i) / sd[j]);
  }
  return draws;
}

}  // namespace myoid::fit
