#include "myoid/ground/math/simulated_annealing.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"

namespace myoid::inline ground::math {
namespace {

constexpr double kStepGrowth = 2.0;           // Corana's c: the largest change of a step is 1 + c
constexpr std::size_t kLastTemperatures = 4;  // whose ends must agree with the best

void validate(const CountedCost& cost, const AnnealingOptions& options) {
  const Eigen::VectorXd& reach = options.reach;
  if (reach.size() > 0 && (reach.size() != cost.lower().size() || !reach.allFinite() || (reach.array() < 0.0).any()))
    throw InvalidInput("simulated annealing: reach must be one finite width per parameter");
  if (reach.size() == 0 && (!cost.lower().allFinite() || !cost.upper().allFinite()))
    throw InvalidInput("simulated annealing: every parameter needs two finite bounds");
  if (!(options.cooling > 0.0 && options.cooling < 1.0)) {
    throw InvalidInput(fmt::format("simulated annealing: cooling is {}; between 0 and 1", options.cooling));
  }
  if (options.cycles < 1 || options.adjustments < 1 || !(options.first_temperature >= 0.0) ||
      !(options.spread_cooling >= 0.0)) {
    throw InvalidInput(
        "simulated annealing: cycles and adjustments must be at least 1, the first temperature and the cooling by "
        "spread not negative");
  }
}

double uniform_between(Random& random, double low, double high) {
  return std::clamp(low + random.uniform() * (high - low), low, high);
}

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
    for (Eigen::Index j = 0; j < p; ++j) x[j] = uniform_between(random, lower[j], upper[j]);
    costs.add(cost(x));
  }
  const double spread = costs.sd();
  return std::isfinite(spread) && spread > 0.0 ? spread : 1.0;
}

/// Returns the ratio of the next temperature to the present one; `spread` is that of the costs at the present one.
double cooling(const AnnealingOptions& options, double temperature, double spread) {
  if (!(options.spread_cooling > 0.0)) return options.cooling;
  const double slowest = options.cooling * options.cooling;
  if (!(spread > 0.0)) return slowest;  // no point was kept
  return std::max(slowest, std::exp(-options.spread_cooling * temperature / spread));
}

/// The walk at one temperature: the point, the steps, and the best point found.
struct Walk {
  CountedCost& cost;
  Random& random;
  const AnnealingOptions& options;
  Eigen::VectorXd reach;  ///< Largest steps.
  Eigen::VectorXd x, best, step;
  double current = 0.0, lowest = 0.0;
  Spread met;  ///< Costs of the points that were kept at this temperature.

  bool spent() const { return cost.evaluations() >= options.max_evaluations; }

  /// Tries a move of parameter j and returns whether it was accepted.
  bool try_move(Eigen::Index j, double temperature) {
    const double low = cost.lower()[j], high = cost.upper()[j];
    Eigen::VectorXd next = x;
    next[j] += (2.0 * random.uniform() - 1.0) * step[j];
    if (next[j] < low || next[j] > high) {
      next[j] = uniform_between(random, std::isfinite(low) ? low : x[j] - step[j],
                                std::isfinite(high) ? high : x[j] + step[j]);
    }
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
    for (int adjustment = 0; adjustment < options.adjustments && !spent(); ++adjustment) {
      std::vector<int> accepted(static_cast<std::size_t>(p), 0);
      for (int cycle = 0; cycle < options.cycles && !spent(); ++cycle) {
        for (Eigen::Index j = 0; j < p && !spent(); ++j) {
          if (step[j] > 0.0 && try_move(j, temperature)) ++accepted[static_cast<std::size_t>(j)];
          met.add(current);
        }
      }
      for (Eigen::Index j = 0; j < p; ++j) {
        const double share = static_cast<double>(accepted[static_cast<std::size_t>(j)]) / options.cycles;
        if (share > 0.6) step[j] *= 1.0 + kStepGrowth * (share - 0.6) / 0.4;
        if (share < 0.4) step[j] /= 1.0 + kStepGrowth * (0.4 - share) / 0.4;
        step[j] = std::min(step[j], reach[j]);
      }
    }
  }
};

}  // namespace

DirectSearchResult simulated_annealing(const DirectSearchProblem& problem,
                                       const Eigen::VectorXd& start,
                                       const AnnealingOptions& options) {
  CountedCost cost(problem, start.size());
  validate(cost, options);
  if (!start.allFinite()) throw InvalidInput("simulated annealing: the start is not finite");
  Random random(options.seed);
  const Eigen::VectorXd inside = cost.clipped(start);
  const double first_cost = cost(inside);
  if (!std::isfinite(first_cost)) throw InvalidInput("simulated annealing: no finite cost at the start");
  const bool near = options.reach.size() > 0;
  const Eigen::VectorXd reach = near ? options.reach : cost.upper() - cost.lower();
  const Eigen::VectorXd low = near ? cost.clipped(inside - 0.5 * reach) : cost.lower();
  const Eigen::VectorXd high = near ? cost.clipped(inside + 0.5 * reach) : cost.upper();
  const double first_temperature =
      options.first_temperature > 0.0 ? options.first_temperature : spread_of_costs(cost, low, high, random);
  Walk walk{.cost = cost,
            .random = random,
            .options = options,
            .reach = reach,
            .x = inside,
            .best = inside,
            .step = reach,
            .current = first_cost,
            .lowest = first_cost};
  DirectSearchResult result;
  std::deque<double> ends;
  double temperature = first_temperature;
  for (;; temperature *= cooling(options, temperature, walk.met.sd())) {
    options.progress.check();
    walk.at(temperature);
    if (walk.spent()) {
      result.termination = Termination::iteration_limit;
      result.message = fmt::format("not frozen after {} evaluations", cost.evaluations());
      break;
    }
    ++result.iterations;
    const double scale = options.spread_cooling > 0.0 ? 0.0 : first_temperature;
    const double tolerance = options.cost_tolerance * (std::abs(walk.lowest) + scale);
    ends.push_back(walk.current);
    if (ends.size() > kLastTemperatures) ends.pop_front();
    const bool frozen = ends.size() == kLastTemperatures && std::all_of(ends.begin(), ends.end(), [&](double end) {
                          return end - walk.lowest <= tolerance;
                        });
    if (frozen) {
      result.termination = Termination::converged;
      result.message = fmt::format("{} temperatures in a row ended at the best cost", kLastTemperatures);
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
