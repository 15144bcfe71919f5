#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/fit/methods/basins.h"
#include "myoid/ground/core/progress.h"

namespace myoid::run {

/// One search by one solver from one start.
struct SolverRun {
  std::string solver;  ///< gauss_newton | levenberg_marquardt | nelder_mead | simulated_annealing
  int start = 0;
  math::Termination termination = math::Termination::no_descent;
  double cost = 0.0;
  double distance = 0.0;  ///< Distance to the best minimum of all runs (basins.h).
  int evaluations = 0;    ///< Evaluations of the whole residual.
  double seconds = 0.0;
};

/// The solvers on one fit.
struct SolverContest {
  std::string fit;  ///< PaperCase::name
  std::vector<SolverRun> runs;
  double best_cost = 0.0;
  fit::BasinTable basins;  ///< Minima found by Levenberg-Marquardt.
};

struct ContestOptions {
  int starts = 3;                  ///< Number of starts: the given one and Sobol points of the box (basins.h).
  int direct_evaluations = 20000;  ///< Limit per start for the simplex and annealing.
  int basin_starts = 31;           ///< Number of starts for the table of basins.
  std::uint64_t seed = 1;          ///< Seed of annealing.
  Progress progress;
};

/// Compares the four solvers that the source paper weighs on its problem: 1/2 sum (F_t - F_m(x))^2 of one muscle in one
/// branch (paper_case.h), without weights, priors or bounds, from the same starts. Gauss-Newton takes the paper's plain
/// steps; annealing begins with steps as wide as the box of the starts. Costs are in N^2. No runs if the branch has
/// fewer samples than unknowns, or all numbers are held. Throws Interrupted.
[[nodiscard]] SolverContest compare_paper_solvers(const fit::StudyData& data,
                                                  std::size_t muscle,
                                                  bool shortening,
                                                  const ContestOptions& options = {});

/// Runs every solver on all fits of method `paper`. Throws Interrupted.
[[nodiscard]] std::vector<SolverContest> solver_contests(const fit::StudyData& data, const ContestOptions& options);

}  // namespace myoid::run
