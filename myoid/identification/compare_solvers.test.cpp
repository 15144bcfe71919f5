#include "myoid/identification/compare_solvers.h"

#include <gtest/gtest.h>

#include "myoid/identification/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(CompareSolvers, TheDescentsAgreeAndTheRivalsDoNotGoLower) {
  ElbowStudy study =
      elbow_study({.trials = 1, .seconds = 8.0, .torque_sd_nm = 0.3, .with_priors = true});
  for (MuscleSetup& setup : study.data.muscles)
    setup.fixed = {"concentric_curvature", "eccentric_curvature_product", "eccentric_plateau"};
  const SolverComparison c =
      compare_solvers(study.data, {.muscles = {"TRI"}},
                      {.starts = 2, .direct_evaluations = 3000, .multistarts = 6});
  ASSERT_EQ(c.runs.size(), 8U);
  for (const SolverRun& run : c.runs) {
    EXPECT_GE(run.cost, c.best_cost * (1.0 - 1e-9)) << run.solver;
    if (run.solver == "levenberg_marquardt" || run.solver == "gauss_newton") {
      EXPECT_LT(run.distance, 1e-3) << run.solver;
      EXPECT_LT(run.evaluations, 200);
    }
  }
  EXPECT_EQ(c.multistart.basins.size(), 1U);
}

}  // namespace
}  // namespace myoid::identification
