#include "myoid/run/solver_contest.h"

#include <chrono>
#include <limits>
#include <utility>

#include "myoid/fit/methods/paper_case.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/progress_part.h"
#include "myoid/ground/math/direct_search.h"
#include "myoid/ground/math/nelder_mead.h"
#include "myoid/ground/math/simulated_annealing.h"

namespace myoid::run {
namespace {

/// One cost in the forms that the solvers need.
struct Contestants {
  fit::LocalSearch gauss_newton, levenberg_marquardt;
  math::CostFunction cost;
  Eigen::Index samples = 0;  ///< See fit::find_basins.
};

template <typename Found>
fit::LocalMinimum end_of(const Found& found) {
  return {found.termination, found.x, found.cost, found.evaluations};
}

/// Searches; returns an end without a minimum if the cost is not finite at the start.
fit::LocalMinimum searched(const fit::LocalSearch& search, const Eigen::VectorXd& start) {
  try {
    return search(start);
  } catch (const InvalidInput&) {
    return {.termination = math::Termination::not_finite, .x = start};
  }
}

using Solver = std::pair<const char*, fit::LocalSearch>;

/// Returns the four solvers by name; they refer to the arguments.
std::vector<Solver> solvers_of(const Contestants& who,
                               const fit::StartBox& box,
                               const ContestOptions& options,
                               const Progress& stop) {
  const auto simplex = [&](const Eigen::VectorXd& x) {
    return end_of(math::nelder_mead(who.cost, x, options.direct_evaluations, stop));
  };
  const auto annealing = [&, seed = options.seed](const Eigen::VectorXd& x) mutable {
    return end_of(math::simulated_annealing(who.cost, x,
                                            {.seed = seed++,
                                             .max_evaluations = options.direct_evaluations,
                                             .reach = box.upper - box.lower,
                                             .progress = stop}));
  };
  return {{"gauss_newton", who.gauss_newton},
          {"levenberg_marquardt", who.levenberg_marquardt},
          {"nelder_mead", simplex},
          {"simulated_annealing", annealing}};
}

SolverContest contest(const Contestants& who, const fit::StartBox& box, const ContestOptions& options) {
  const std::vector<Eigen::VectorXd> starts = fit::starts_in(box, options.starts);
  const Progress stop{{}, options.progress.stop};
  const std::vector<Solver> solvers = solvers_of(who, box, options, stop);
  SolverContest result;
  std::vector<Eigen::VectorXd> ends;
  // The searches for the basins count as one start more.
  const double total = static_cast<double>(solvers.size() * (starts.size() + 1));
  for (std::size_t s = 0; s < starts.size(); ++s) {
    for (const auto& [name, search] : solvers) {
      options.progress.check();
      options.progress.tell(static_cast<double>(ends.size()) / total, name);
      const auto begin = std::chrono::steady_clock::now();
      fit::LocalMinimum end = searched(search, starts[s]);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      result.runs.push_back({.solver = name,
                             .start = static_cast<int>(s),
                             .termination = end.termination,
                             .cost = end.cost,
                             .evaluations = end.evaluations,
                             .seconds = taken.count()});
      ends.push_back(std::move(end.x));
    }
  }
  options.progress.tell(static_cast<double>(ends.size()) / total, "searching from many starts");
  result.basins = fit::find_basins([&](const Eigen::VectorXd& x) { return searched(who.levenberg_marquardt, x); }, box,
                                   options.basin_starts, who.samples, stop);

  Eigen::VectorXd best = box.given;
  result.best_cost = std::numeric_limits<double>::infinity();
  const auto take = [&](double cost, const Eigen::VectorXd& x) {
    if (!(cost < result.best_cost)) return;
    result.best_cost = cost;
    best = x;
  };
  for (const fit::BasinRow& basin : result.basins.basins) take(basin.cost, basin.x);
  for (std::size_t i = 0; i < ends.size(); ++i) take(result.runs[i].cost, ends[i]);
  for (std::size_t i = 0; i < ends.size(); ++i) result.runs[i].distance = fit::distance(ends[i], best, box);
  return result;
}

}  // namespace

SolverContest compare_paper_solvers(const fit::StudyData& data,
                                    std::size_t muscle,
                                    bool shortening,
                                    const ContestOptions& options) {
  const fit::PaperCase samples = fit::paper_case(data, muscle, shortening);
  const fit::StartBox box = fit::start_box(samples, data.muscles[muscle]);
  const auto p = box.given.size();
  if (p == 0 || static_cast<Eigen::Index>(samples.samples.size()) < p) return {.fit = samples.name()};
  const math::LeastSquaresProblem problem = samples.problem();
  const Progress stop{{}, options.progress.stop};
  SolverContest result = contest(
      {.gauss_newton = [&](const Eigen::VectorXd& x) { return end_of(fit::search_as_published(samples, x, stop)); },
       .levenberg_marquardt =
           [&](const Eigen::VectorXd& x) { return end_of(math::minimize(problem, x, {.progress = stop})); },
       .cost = math::cost_of(problem),
       .samples = problem.residual_count},
      box, options);
  result.fit = samples.name();
  return result;
}

std::vector<SolverContest> solver_contests(const fit::StudyData& data, const ContestOptions& options) {
  std::vector<SolverContest> contests;
  const auto total = static_cast<double>(2 * data.muscles.size());
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    for (const bool shortening : {true, false}) {
      ContestOptions how = options;
      const auto done = static_cast<double>(contests.size());
      how.progress = part_of(options.progress, done / total, (done + 1.0) / total);
      contests.push_back(compare_paper_solvers(data, k, shortening, how));
    }
  }
  return contests;
}

}  // namespace myoid::run
