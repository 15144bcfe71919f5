#include "myoid/run/solver_contest.h"

#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/fit/methods/paper.h"
#include "myoid/ground/core/error.h"

#include "tests/support/elbow_study.h"

namespace myoid::run {
namespace {

using test::elbow_study;
using test::ElbowStudy;

/// The method holds F_max: a study in which it starts at the truth, with forces that carry noise.
ElbowStudy noisy_forces() {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0, .delay_s = 0.0});
  test::StudyNoise noise(3);
  for (std::size_t k = 0; k < 4; ++k)
    study.data.muscles[k].start.max_isometric_force_n = study.truth[k].max_isometric_force_n;
  for (fit::TrialData& trial : study.data.trials) {
    for (Eigen::Index k = 0; k < 4; ++k) trial.force_n.col(k) += 2.0 * noise.band(trial.time_s.size(), 6.0, 100.0);
  }
  return study;
}

TEST(SolverContest, GaussNewtonOfThePublishedMethodIsTheMethodItself) {
  const ElbowStudy study = noisy_forces();
  const fit::IdentificationResult paper = fit::identify_paper(study.data, {.muscles = {"BIC"}});
  const SolverContest c = compare_paper_solvers(study.data, 0, true, {.starts = 1, .direct_evaluations = 3000});
  ASSERT_EQ(c.runs.size(), 4U);
  ASSERT_EQ(c.runs[0].solver, "gauss_newton");
  ASSERT_EQ(c.runs[0].termination, math::Termination::converged);
  // The cost, by hand from what the estimator found: half the squares of the force's errors over
  // the samples of this branch.
  double cost = 0.0;
  for (std::size_t t = 0; t < study.data.trials.size(); ++t) {
    const fit::TrialData& trial = study.data.trials[t];
    for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
      if (trial.velocity_mps(i, 0) <= 0.0)
        cost += 0.5 * std::pow(paper.trials[t].force_fit_n(i, 0) - trial.force_n(i, 0), 2);
    }
  }
  EXPECT_NEAR(c.runs[0].cost, cost, 1e-9 * cost);
}

TEST(SolverContest, AllFourSearchTheSameSumOfSquaresOfThePublishedMethod) {
  const ElbowStudy study = noisy_forces();
  const SolverContest c = compare_paper_solvers(study.data, 0, true, {.starts = 1});
  ASSERT_EQ(c.runs.size(), 4U);
  for (const SolverRun& run : c.runs) {
    // Three unknowns and one basin: the simplex gets there too, annealing near it within its evaluations.
    const bool annealing = run.solver == "simulated_annealing";
    EXPECT_NEAR(run.cost, c.best_cost, (annealing ? 0.1 : 1e-6) * c.best_cost) << run.solver;
    EXPECT_LT(run.distance, annealing ? 0.2 : 1e-3) << run.solver;
  }
  EXPECT_GT(c.runs[2].evaluations, 2 * c.runs[0].evaluations);
  EXPECT_EQ(c.basins.starts, 31);
}

TEST(SolverContest, ABranchInWhichAllIsHeldHasNothingToCompare) {
  ElbowStudy study = noisy_forces();
  study.data.muscles[0].fixed = {"optimal_fiber_length", "force_length_width", "concentric_curvature"};
  EXPECT_TRUE(compare_paper_solvers(study.data, 0, true).runs.empty());
}

TEST(SolverContest, TellsItsProgressAndStopsWhenAsked) {
  const ElbowStudy forces = noisy_forces();
  {
    std::stop_source source;
    double last = -1.0;
    int told = 0;
    ContestOptions options{.starts = 2, .direct_evaluations = 200, .basin_starts = 2};
    options.progress.stop = source.get_token();
    options.progress.report = [&](double share, std::string_view what) {
      EXPECT_GT(share, last);
      EXPECT_LT(share, 1.0);
      last = share;
      // In the middle of the second start's simplex, which then may not come to its end.
      if (++told == 7) {
        EXPECT_EQ(what, "nelder_mead");
        source.request_stop();
      }
    };
    const auto run = [&] { return compare_paper_solvers(forces.data, 0, true, options); };
    EXPECT_THROW((void)run(), Interrupted);
    EXPECT_EQ(told, 7);
  }
}

}  // namespace
}  // namespace myoid::run
