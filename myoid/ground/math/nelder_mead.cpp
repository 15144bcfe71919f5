#include "myoid/ground/math/nelder_mead.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace myoid::inline ground::math {
namespace {

constexpr double kStepTolerance = 1e-9, kCostTolerance = 1e-15, kRestartTolerance = 1e-10;
constexpr int kMostRestarts = 10;
constexpr double kFirstEdge = 0.1;  // share of |x_j|, of 1 at zero

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

Eigen::VectorXd first_edges(const Eigen::VectorXd& x) {
  return kFirstEdge * (x.array() != 0.0).select(x.array().abs(), 1.0).matrix();
}

class Simplex {
 public:
  /// Builds a right-angled simplex at `corner`, with edges to the side of `sign`.
  Simplex(CountedCost& cost, Vertex corner, const Eigen::VectorXd& edges, double sign) : cost_(cost) {
    vertices_.push_back(std::move(corner));
    const Eigen::VectorXd origin = vertices_.front().x;
    for (Eigen::Index j = 0; j < edges.size(); ++j) {
      Eigen::VectorXd x = origin;
      x[j] += sign * edges[j];
      vertices_.push_back({x, cost(x)});
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
  Vertex at(const Eigen::VectorXd& x) { return {x, cost_(x)}; }
  void sort() {
    std::stable_sort(vertices_.begin(), vertices_.end(),
                     [](const Vertex& a, const Vertex& b) { return a.cost < b.cost; });
  }

  CountedCost& cost_;
  std::vector<Vertex> vertices_;
};

}  // namespace

DirectSearchResult nelder_mead(const CostFunction& function,
                               const Eigen::VectorXd& start,
                               int max_evaluations,
                               const Progress& progress) {
  CountedCost cost(function);
  const Coefficients by = coefficients(start.size());
  Vertex best{start, cost.at_start(start)};
  DirectSearchResult result;
  Eigen::VectorXd edges = first_edges(start);
  double sign = 1.0;
  for (int restarts = 0;; ++restarts) {
    const double before = best.cost;
    Simplex simplex(cost, best, edges, sign);
    while (!simplex.shrunk(edges) && cost.evaluations() < max_evaluations) {
      progress.check();
      simplex.move(by);
    }
    const bool shrunk = simplex.shrunk(edges);
    best = simplex.best();
    const bool confirmed = restarts > 0 && before - best.cost <= kRestartTolerance * std::abs(before);
    if (!shrunk || confirmed || restarts >= kMostRestarts) {
      result.termination = shrunk && confirmed ? Termination::converged : Termination::iteration_limit;
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
