#include "myoid/ground/math/nelder_mead.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

constexpr double kStepTolerance = 1e-9, kCostTolerance = 1e-15, kRestartTolerance = 1e-10;
constexpr int kMostRestarts = 10;

struct Vertex {
  Eigen::VectorXd x;
  double cost;
};

struct Coefficients {
  double reflect = 1.0, expand = 2.0, contract = 0.5, shrink = 0.5;
};

Coefficients coefficients(Eigen::Index parameters) {
  if (parameters < 3) return {};  // below 3 the adaptive simplex shrinks to a point
  const auto n = static_cast<double>(parameters);
  return {1.0, 1.0 + 2.0 / n, 0.75 - 0.5 / n, 1.0 - 1.0 / n};
}

Eigen::VectorXd first_edges(const CountedCost& cost, const Eigen::VectorXd& x, double share) {
  Eigen::VectorXd edges(x.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double span = cost.upper()[j] - cost.lower()[j];
    edges[j] = share * (std::isfinite(span) ? span : x[j] != 0.0 ? std::abs(x[j]) : 1.0);
  }
  return edges;
}

class Simplex {
 public:
  /// Builds a right-angled simplex at `corner`, with edges to the side of `sign`, or inward
  /// at a bound.
  Simplex(CountedCost& cost, Vertex corner, const Eigen::VectorXd& edges, double sign) : cost_(cost) {
    vertices_.push_back(std::move(corner));
    const Eigen::VectorXd origin = vertices_.front().x;
    for (Eigen::Index j = 0; j < edges.size(); ++j) {
      Eigen::VectorXd x = origin;
      x[j] += sign * edges[j];
      if (x[j] > cost.upper()[j] || x[j] < cost.lower()[j]) x[j] = origin[j] - sign * edges[j];
      x = cost.clipped(x);
      if (edges[j] > 0.0) vertices_.push_back({x, cost(x)});
    }
    sort();
  }

  [[nodiscard]] const Vertex& best() const { return vertices_.front(); }

  [[nodiscard]] bool shrunk(const Eigen::VectorXd& edges) const {
    const double spread = vertices_.back().cost - best().cost;
    if (spread <= kCostTolerance * std::abs(best().cost)) return true;
    for (const Vertex& vertex : vertices_) {
      const Eigen::ArrayXd reach = kStepTolerance * best().x.array().abs().max(edges.array());
      if (((vertex.x - best().x).array().abs() > reach).any()) return false;
    }
    return true;
  }

  void move(const Coefficients& by) {
    const std::size_t last = vertices_.size() - 1;
    if (last == 0) return;
    Eigen::VectorXd center = Eigen::VectorXd::Zero(best().x.size());
    for (std::size_t i = 0; i < last; ++i) center += vertices_[i].x / static_cast<double>(last);
    Vertex& worst = vertices_[last];
    const Eigen::VectorXd away = center - worst.x;
    const Vertex reflected = at(center + by.reflect * away);
    if (reflected.cost < best().cost) {
      const Vertex expanded = at(center + by.reflect * by.expand * away);
      worst = expanded.cost < reflected.cost ? expanded : reflected;
    } else if (reflected.cost < vertices_[last - 1].cost) {
      worst = reflected;
    } else {
      const bool outside = reflected.cost < worst.cost;
      const Vertex contracted = at(center + (outside ? by.reflect * by.contract : -by.contract) * away);
      if (contracted.cost < std::min(reflected.cost, worst.cost)) {
        worst = contracted;
      } else {
        for (std::size_t i = 1; i <= last; ++i) vertices_[i] = at(best().x + by.shrink * (vertices_[i].x - best().x));
      }
    }
    sort();
  }

 private:
  Vertex at(const Eigen::VectorXd& x) {
    const Eigen::VectorXd inside = cost_.clipped(x);
    const double cost = cost_(inside);
    return {inside, cost};
  }
  void sort() {
    std::stable_sort(vertices_.begin(), vertices_.end(),
                     [](const Vertex& a, const Vertex& b) { return a.cost < b.cost; });
  }

  CountedCost& cost_;
  std::vector<Vertex> vertices_;
};

}  // namespace

DirectSearchResult nelder_mead(const DirectSearchProblem& problem,
                               const Eigen::VectorXd& start,
                               const NelderMeadOptions& options) {
  CountedCost cost(problem, start.size());
  if (!start.allFinite()) throw InvalidInput("nelder_mead: the start is not finite");
  if (!(options.first_edge > 0.0)) {
    throw InvalidInput(fmt::format("nelder_mead: first_edge is {}; it must be positive", options.first_edge));
  }
  const Coefficients by = coefficients(start.size());
  Vertex best{cost.clipped(start), 0.0};
  best.cost = cost(best.x);
  if (!std::isfinite(best.cost)) throw InvalidInput("nelder_mead: no finite cost at the start");

  DirectSearchResult result;
  Eigen::VectorXd edges = first_edges(cost, best.x, options.first_edge);
  double sign = 1.0;
  for (;; ++result.restarts) {
    const double before = best.cost;
    Simplex simplex(cost, best, edges, sign);
    while (!simplex.shrunk(edges) && cost.evaluations() < options.max_evaluations) {
      options.progress.check();
      simplex.move(by);
      ++result.iterations;
    }
    const bool shrunk = simplex.shrunk(edges);
    best = simplex.best();
    if (!shrunk) {
      result.termination = Termination::iteration_limit;
      result.message = fmt::format("not converged after {} evaluations", cost.evaluations());
      break;
    }
    const bool confirmed = result.restarts > 0 && before - best.cost <= kRestartTolerance * std::abs(before);
    if (confirmed) {
      result.termination = Termination::converged;
      result.message = "a fresh simplex found nothing lower";
      break;
    }
    if (result.restarts >= kMostRestarts) {
      result.termination = Termination::iteration_limit;
      result.message = fmt::format("still improving after {} restarts of the simplex", result.restarts);
      break;
    }
    sign = -sign;  // the next simplex points the other way
  }
  result.x = best.x;
  result.cost = best.cost;
  result.evaluations = cost.evaluations();
  return result;
}

}  // namespace myoid::inline ground::math
