#pragma once

#include <string>
#include <vector>

#include "myoid/identification/estimator.h"
#include "myoid/math/multistart.h"

namespace myoid::identification {

/// One search by one solver from one start.
struct SolverRun {
  std::string solver;  ///< gauss_newton | levenberg_marquardt | nelder_mead | simulated_annealing
  int start = 0;
  math::Termination termination = math::Termination::no_descent;
  double cost = 0.0;
  double distance =
      0.0;              ///< To the best minimum of all runs: rms over the unknowns, each in spreads
                        ///< of its prior (0.3 of a logarithm, a tenth of a value, without one).
  int evaluations = 0;  ///< Of the whole residual.
  double seconds = 0.0;
};

struct SolverComparison {
  std::vector<SolverRun> runs;
  double best_cost = 0.0;
  math::MultistartResult multistart;  ///< Levenberg-Marquardt from Sobol points: the basins.
};

struct CompareOptions {
  int starts = 3;                  ///< The given one and Sobol points of the box two spreads wide.
  int direct_evaluations = 20000;  ///< At most, of the simplex and of annealing, per start.
  int multistarts = 30;            ///< For the table of basins.
  std::uint64_t seed = 1;          ///< Of the annealing.
};

/// The four solvers that the source paper weighs against each other, on the same cost, with the
/// same weights (those of the usual fit) and bounds, from the same starts. Gauss-Newton takes full
/// steps.
[[nodiscard]] SolverComparison compare_solvers(const StudyData& data,
                                               const EstimatorOptions& estimator,
                                               const CompareOptions& options = {});

}  // namespace myoid::identification
