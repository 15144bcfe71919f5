#include "myoid/identification/compare_paper_solvers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "myoid/core/error.h"
#include "myoid/identification/paper_case.h"
#include "myoid/math/direct_search.h"
#include "myoid/math/nelder_mead.h"
#include "myoid/math/simulated_annealing.h"
#include "myoid/math/sobol.h"

namespace myoid::identification {
namespace {

/// Spread of an unknown beforehand, in its own unit; a tenth of its start without one.
double spread_of(const MuscleSetup& setup, const PaperUnknown& unknown, double start) {
  const auto prior = setup.priors.find(std::string(unknown.field->name));
  if (prior == setup.priors.end()) return 0.1 * std::abs(start);
  return prior->second.logarithmic ? prior->second.sd * std::abs(start) : prior->second.sd;
}

}  // namespace

SolverComparison compare_paper_solvers(const StudyData& data,
                                       std::size_t muscle,
                                       bool shortening,
                                       const CompareOptions& options) {
  const PaperCase samples = paper_case(data, muscle, shortening);
  const Eigen::VectorXd given = samples.start_vector();
  const auto p = given.size();
  SolverComparison result;
  if (p == 0 || static_cast<Eigen::Index>(samples.samples.size()) < p) return result;
  const math::LeastSquaresProblem problem = samples.problem();

  // Starts: the given one and Sobol points of the box two spreads wide, inside what is physical.
  Eigen::VectorXd spread(p), lower(p), upper(p);
  for (Eigen::Index j = 0; j < p; ++j) {
    const PaperUnknown& unknown = samples.unknowns[static_cast<std::size_t>(j)];
    spread[j] = spread_of(data.muscles[muscle], unknown, given[j]);
    const muscle::Range bounds = unknown.field->bounds;
    lower[j] = std::max(std::min(bounds.lower, given[j]), given[j] - 2.0 * spread[j]);
    upper[j] = std::min(std::max(bounds.upper, given[j]), given[j] + 2.0 * spread[j]);
  }
  std::vector<Eigen::VectorXd> starts{given};
  const Eigen::MatrixXd points =
      math::sobol_points(std::max(1, options.starts - 1), static_cast<int>(p));
  for (int s = 1; s < options.starts; ++s)
    starts.push_back(lower + points.row(s - 1).transpose().cwiseProduct(upper - lower));

  std::vector<Eigen::VectorXd> ends;
  const auto add = [&](const char* solver, int start, auto search) {
    const auto begin = std::chrono::steady_clock::now();
    SolverRun run;
    run.solver = solver;
    run.start = start;
    Eigen::VectorXd end = starts[static_cast<std::size_t>(start)];
    try {
      const auto found = search();
      run.termination = found.termination;
      run.cost = found.cost;
      run.evaluations = found.evaluations;
      end = found.x;
    } catch (const InvalidInput&) {  // no finite force at this start
      run.termination = math::Termination::not_finite;
      run.cost = std::numeric_limits<double>::infinity();
    }
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result.runs.push_back(run);
    ends.push_back(end);
  };
  const math::LeastSquaresOptions full_steps{.method = math::LeastSquaresMethod::gauss_newton,
                                             .max_iterations = 100,
                                             .step_tolerance = 1e-10,
                                             .gradient_tolerance = 1e-13};
  const math::DirectSearchProblem direct = math::direct_search_problem(problem);
  const math::DirectSearchProblem boxed{direct.cost, lower, upper};
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const int number = static_cast<int>(s);
    add("gauss_newton", number, [&] { return math::minimize(problem, starts[s], full_steps); });
    add("levenberg_marquardt", number, [&] { return math::minimize(problem, starts[s]); });
    add("nelder_mead", number, [&] {
      return math::nelder_mead(direct, starts[s], {.max_evaluations = options.direct_evaluations});
    });
    add("simulated_annealing", number, [&] {
      return math::simulated_annealing(
          boxed, starts[s],
          {.seed = options.seed + s, .max_evaluations = options.direct_evaluations});
    });
  }
  math::MultistartOptions many;
  many.starts = options.multistarts;
  many.lower = lower;
  many.upper = upper;
  many.given = {given};
  many.x_tolerance = 1e-2;
  result.multistart = math::multistart(problem, {}, many);

  Eigen::VectorXd best = given;
  result.best_cost = std::numeric_limits<double>::infinity();
  const auto take = [&](double cost, const Eigen::VectorXd& x) {
    if (!(cost < result.best_cost)) return;
    result.best_cost = cost;
    best = x;
  };
  if (!result.multistart.basins.empty())
    take(result.multistart.basins.front().cost, result.multistart.basins.front().x);
  for (std::size_t i = 0; i < ends.size(); ++i) take(result.runs[i].cost, ends[i]);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    result.runs[i].distance =
        std::sqrt((ends[i] - best).cwiseQuotient(spread).squaredNorm() / static_cast<double>(p));
  }
  return result;
}

}  // namespace myoid::identification
