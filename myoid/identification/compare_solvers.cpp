#include "myoid/identification/compare_solvers.h"

#include <chrono>
#include <cmath>

#include "myoid/math/nelder_mead.h"
#include "myoid/math/simulated_annealing.h"
#include "myoid/math/sobol.h"

namespace myoid::identification {

SolverComparison compare_solvers(const StudyData& data,
                                 const EstimatorOptions& estimator_options,
                                 const CompareOptions& options) {
  EstimatorOptions plain = estimator_options;
  plain.gauss_newton = false;
  plain.correct_attenuation = false;  // one fixed sum of squares for all
  const Estimator estimator(data, plain);
  EstimatorOptions full_steps = plain;
  full_steps.gauss_newton = true;
  const Estimator by_full_steps(data, full_steps);
  const Eigen::VectorXd given = estimator.model().parameters().start();
  const Weighting weighting = estimator.solve(given).weighting;
  const auto p = given.size();
  Eigen::VectorXd spread(p), lower(p), upper(p);
  for (Eigen::Index j = 0; j < p; ++j) {
    const FreeParameter& f = estimator.free()[static_cast<std::size_t>(j)];
    spread[j] = f.prior_sd > 0.0 ? f.prior_sd
                : f.field->logarithmic
                    ? 0.3
                    : std::max(0.1 * std::abs(f.start), 0.1 * (f.upper - f.lower));
    lower[j] = std::max(f.lower, given[j] - 2.0 * spread[j]);
    upper[j] = std::min(f.upper, given[j] + 2.0 * spread[j]);
  }
  std::vector<Eigen::VectorXd> starts{given};
  const Eigen::MatrixXd points =
      math::sobol_points(std::max(1, options.starts - 1), static_cast<int>(p));
  for (int s = 1; s < options.starts; ++s) {
    starts.push_back(lower + points.row(s - 1).transpose().cwiseProduct(upper - lower));
  }
  SolverComparison result;
  std::vector<Eigen::VectorXd> ends;
  const auto add = [&](const std::string& solver, int start, auto search) {
    const auto begin = std::chrono::steady_clock::now();
    const auto found = search();
    SolverRun run;
    run.solver = solver;
    run.start = start;
    run.termination = found.termination;
    run.cost = found.cost;
    run.evaluations = found.evaluations;
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result.runs.push_back(run);
    ends.push_back(found.x);
  };
  const math::DirectSearchProblem direct{
      [&](const Eigen::VectorXd& z) {
        return estimator.normal_equations(z, weighting, Derivatives::none).cost;
      },
      estimator.lower(), estimator.upper()};
  const double total = 4.0 * static_cast<double>(starts.size());
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const int number = static_cast<int>(s);
    const auto tell = [&](double done, const char* what) {
      plain.progress.tell((4.0 * static_cast<double>(s) + done) / total, what);
    };
    tell(0.0, "gauss_newton");
    add("gauss_newton", number,
        [&] { return by_full_steps.search(starts[s], weighting, 1e-9, 1e-12, 100); });
    tell(1.0, "levenberg_marquardt");
    add("levenberg_marquardt", number,
        [&] { return estimator.search(starts[s], weighting, 1e-9, 1e-12, 200); });
    tell(2.0, "nelder_mead");
    add("nelder_mead", number, [&] {
      return math::nelder_mead(
          direct, starts[s],
          {.max_evaluations = options.direct_evaluations, .progress = {{}, plain.progress.stop}});
    });
    tell(3.0, "simulated_annealing");
    // The box of the starts, so that the temperature fits what is searched.
    const math::DirectSearchProblem boxed{direct.cost, lower, upper};
    add("simulated_annealing", number, [&] {
      return math::simulated_annealing(boxed, starts[s],
                                       {.seed = options.seed + s,
                                        .max_evaluations = options.direct_evaluations,
                                        .progress = {{}, plain.progress.stop}});
    });
  }
  math::MultistartOptions many;
  many.starts = options.multistarts;
  many.lower = lower;
  many.upper = upper;
  many.given = {given};
  many.x_tolerance = 1e-2;
  many.progress.stop = plain.progress.stop;
  result.multistart = math::multistart(
      [&](const Eigen::VectorXd& start, Eigen::Index) {
        const NormalSearchResult found = estimator.search(start, weighting, 1e-8, 1e-10, 200);
        return math::LocalMinimum{found.termination, found.x, found.cost, found.evaluations};
      },
      many);
  // The best of all, and how far each run ended from it.
  Eigen::VectorXd best = given;
  result.best_cost = std::numeric_limits<double>::infinity();
  if (!result.multistart.basins.empty()) {
    best = result.multistart.basins.front().x;
    result.best_cost = result.multistart.basins.front().cost;
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (std::isfinite(result.runs[i].cost) && result.runs[i].cost < result.best_cost) {
      result.best_cost = result.runs[i].cost;
      best = ends[i];
    }
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    result.runs[i].distance =
        std::sqrt((ends[i] - best).cwiseQuotient(spread).squaredNorm() / static_cast<double>(p));
  }
  return result;
}

}  // namespace myoid::identification
