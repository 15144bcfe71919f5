#include "myoid/ground/math/simulated_annealing.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"

namespace myoid::inline ground::math {
namespace {

constexpr double kStepGrowth = 2.0;           // Corana's c: the largest change of a step is 1 + c
constexpr std::size_t kLastTemperatures = 4;  // whose ends must agree with the best
constexpr int kMoves = 10;                    // of each parameter at a temperature
constexpr double kSpreadCooling = 0.7;        // lambda of Huang
constexpr double kSlowest = 0.85 * 0.85;      // ratio of successive temperatures
constexpr double kFrozen = 1e-8;              // share of the best cost

/// Running mean and spread (Welford), safe for huge costs. Infinite costs are left out.
class Spread {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    const double change = value - mean_;
    mean_ += change / ++count_;
    squares_ += change * (value - mean_);
  }
  [[nodiscard]] double sd() const { return count_ > 1 ? std::sqrt(squares_ / (count_ - 1)) : 0.0; }

 private:
  double mean_ = 0.0, squares_ = 0.0;
  int count_ = 0;
};

/// Returns the spread of the cost over a box.
double spread_of_costs(CountedCost& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, Random& random) {
  const Eigen::Index p = lower.size();
  Spread costs;
  for (Eigen::Index i = 0; i < 20 * p; ++i) {
    Eigen::VectorXd x(p);
    for (Eigen::Index j = 0; j < p; ++j)
      x[j] = std::clamp(lower[j] + random.uniform() * (upper[j] - lower[j]), lower[j], upper[j]);
    costs.add(cost(x));
  }
  const double spread = costs.sd();
  return std::isfinite(spread) && spread > 0.0 ? spread : 1.0;
}

/// Returns the ratio of the next temperature to the present one; `spread` is that of the costs at the present one.
double cooling(double temperature, double spread) {
  if (!(spread > 0.0)) return kSlowest;  // no point was kept
  return std::max(kSlowest, std::exp(-kSpreadCooling * temperature / spread));
}

/// The walk at one temperature: the point, the steps, and the best point found.
struct Walk {
  CountedCost& cost;
  Random& random;
  int max_evaluations = 0;
  Eigen::VectorXd reach;  ///< Largest steps.
  Eigen::VectorXd x, best, step;
  double current = 0.0, lowest = 0.0;
  Spread met;  ///< Costs of the points that were kept at this temperature.

  bool spent() const { return cost.evaluations() >= max_evaluations; }

  /// Tries a move of parameter j and returns whether it was accepted.
  bool try_move(Eigen::Index j, double temperature) {
    Eigen::VectorXd next = x;
    next[j] += (2.0 * random.uniform() - 1.0) * step[j];
    const double value = cost(next);
    const double luck = random.uniform();  // drawn in every case, so that the stream does not depend on the cost
    if (!(value <= current) && !(luck < std::exp((current - value) / temperature))) return false;
    x = next;
    current = value;
    if (value < lowest) {
      lowest = value;
      best = next;
    }
    return true;
  }

  void at(double temperature) {
    const Eigen::Index p = x.size();
    met = {};
    std::vector<int> accepted(static_cast<std::size_t>(p), 0);
    for (int move = 0; move < kMoves && !spent(); ++move) {
      for (Eigen::Index j = 0; j < p && !spent(); ++j) {
        if (step[j] > 0.0 && try_move(j, temperature)) ++accepted[static_cast<std::size_t>(j)];
        met.add(current);
      }
    }
    for (Eigen::Index j = 0; j < p; ++j) {
      const double share = static_cast<double>(accepted[static_cast<std::size_t>(j)]) / kMoves;
      if (share > 0.6) step[j] *= 1.0 + kStepGrowth * (share - 0.6) / 0.4;
      if (share < 0.4) step[j] /= 1.0 + kStepGrowth * (0.4 - share) / 0.4;
      step[j] = std::min(step[j], reach[j]);
    }
  }
};

}  // namespace

DirectSearchResult simulated_annealing(const CostFunction& function,
                                       const Eigen::VectorXd& start,
                                       const AnnealingOptions& options) {
  const Eigen::VectorXd& reach = options.reach;
  if (reach.size() != start.size() || !reach.allFinite() || (reach.array() < 0.0).any())
    throw InvalidInput("simulated annealing: reach must be one finite width per parameter");
  CountedCost cost(function);
  Random random(options.seed);
  const double first_cost = cost.at_start(start);
  double temperature = spread_of_costs(cost, start - 0.5 * reach, start + 0.5 * reach, random);
  Walk walk{.cost = cost,
            .random = random,
            .max_evaluations = options.max_evaluations,
            .reach = reach,
            .x = start,
            .best = start,
            .step = reach,
            .current = first_cost,
            .lowest = first_cost};
  DirectSearchResult result;
  std::deque<double> ends;
  for (;; temperature *= cooling(temperature, walk.met.sd())) {
    options.progress.check();
    walk.at(temperature);
    if (walk.spent()) {
      result.termination = Termination::iteration_limit;
      break;
    }
    const double tolerance = kFrozen * std::abs(walk.lowest);
    ends.push_back(walk.current);
    if (ends.size() > kLastTemperatures) ends.pop_front();
    const bool frozen = ends.size() == kLastTemperatures && std::all_of(ends.begin(), ends.end(), [&](double end) {
                          return end - walk.lowest <= tolerance;
                        });
    if (frozen) {
      result.termination = Termination::converged;
      break;
    }
    walk.x = walk.best;
    walk.current = walk.lowest;
  }
  result.x = walk.best;
  result.cost = walk.lowest;
  result.evaluations = cost.evaluations();
  return result;
}

}  // namespace myoid::inline ground::math
