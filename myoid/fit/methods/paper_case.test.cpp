#include "myoid/fit/methods/paper_case.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

std::vector<std::string> names(const PaperCase& of) {
  std::vector<std::string> result;
  for (const muscle::HillField* unknown : of.unknowns) result.emplace_back(unknown->name);
  return result;
}

TEST(PaperCase, HoldsWhatTheSetupHoldsUnlessALaterRuleFreesIt) {
  StudyData data = test::elbow_study({.trials = 1, .seconds = 4.0}).data;
  data.muscles[0].fixed = {"optimal_fiber_length"};
  EXPECT_EQ(names(paper_case(data, 0, true)), (std::vector<std::string>{"force_length_width", "concentric_curvature"}));
  EXPECT_EQ(names(paper_case(data, 1, false)),
            (std::vector<std::string>{"optimal_fiber_length", "force_length_width", "eccentric_curvature_product",
                                      "eccentric_plateau"}));
  data.rules = {{.parameter = "optimal_fiber_length", .owners = {"BIC"}, .free = true},
                {.parameter = "force_length_width", .free = false, .value = 0.04}};
  const PaperCase ruled = paper_case(data, 0, true);
  EXPECT_EQ(names(ruled), (std::vector<std::string>{"optimal_fiber_length", "concentric_curvature"}));
  EXPECT_EQ(ruled.start.force_length_width_m, 0.04);
}

TEST(PaperCase, EverySampleIsInOneBranchOrCountedAsDropped) {
  StudyData data = test::elbow_study({.trials = 2, .seconds = 4.0, .delay_s = 0.0}).data;
  // No muscle shortens at 0.05 m/s or faster any more, as far as this one is concerned.
  data.muscles[0].start.max_shortening_speed_mps = 0.05;
  std::size_t samples = 0;
  int dropped = 0;
  for (const bool shortening : {true, false}) {
    const PaperCase one = paper_case(data, 0, shortening);
    Eigen::Index in_pieces = 0;
    for (const Eigen::Index n : one.pieces) in_pieces += n;
    EXPECT_EQ(in_pieces, static_cast<Eigen::Index>(one.samples.size()));
    samples += one.samples.size();
    dropped += one.dropped;
  }
  EXPECT_GT(dropped, 0);
  EXPECT_EQ(samples + static_cast<std::size_t>(dropped), 2u * 401u);
}

TEST(PaperCase, StepsThatRunAwayAreNoMinimumHoweverFlatItIsOutThere) {
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 6.0, .delay_s = 0.0});
  StudyData& data = study.data;
  data.muscles[0].start = study.truth[0];
  data.muscles[0].start.optimal_fiber_length_m *= 1.02;
  const PaperCase samples = paper_case(data, 0, true);
  const Eigen::VectorXd start = samples.start_vector();
  const auto good = search_as_published(samples, start);
  EXPECT_EQ(good.termination, math::Termination::converged) << good.message;
  // From far outside of the fibers' lengths the force is zero, and so is its slope.
  Eigen::VectorXd far = start;
  far[0] *= 4.0;
  const auto away = search_as_published(samples, far);
  EXPECT_NE(away.termination, math::Termination::converged);
  // The width enters squared.
  Eigen::VectorXd mirrored = start;
  mirrored[1] *= -1.0;
  EXPECT_NEAR(search_as_published(samples, mirrored).x[1], good.x[1], 1e-6 * good.x[1]);
  mirrored[0] = std::nan("");
  EXPECT_EQ(search_as_published(samples, mirrored).termination, math::Termination::not_finite);
}

TEST(PaperCase, TheTruthIsFoundWhereverPlainStepsDoAndFromFartherStarts) {
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 6.0, .delay_s = 0.0});
  study.data.muscles[0].start = study.truth[0];
  int rescued = 0;
  for (const bool shortening : {true, false}) {
    const PaperCase samples = paper_case(study.data, 0, shortening);
    const Eigen::VectorXd truth = samples.start_vector();
    for (const double length : {0.8, 0.9, 1.1, 1.2}) {
      for (const double width : {0.7, 1.4}) {
        Eigen::VectorXd start = truth;
        start[0] *= length;
        start[1] *= width;
        start[2] *= 1.5;
        const auto is_truth = [&](const math::LeastSquaresResult& found) {
          return found.termination == math::Termination::converged &&
                 ((found.x - truth).array().abs() <= 1e-6 * truth.array().abs()).all();
        };
        const bool plain = is_truth(search_as_published(samples, start));
        const bool found = is_truth(search_for_minimum(samples, start).found);
        EXPECT_TRUE(found || !plain) << length << " " << width << " " << shortening;
        rescued += found && !plain ? 1 : 0;
      }
    }
  }
  EXPECT_GT(rescued, 0);
}

TEST(PaperCase, WhereTheMuscleMakesNoForceThereIsNoMinimum) {
  const test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 6.0, .delay_s = 0.0});
  const PaperCase samples = paper_case(study.data, 0, true);
  Eigen::VectorXd far = samples.start_vector();
  far[0] *= 100.0;
  const math::LeastSquaresResult end = search_for_minimum(samples, far).found;
  EXPECT_EQ(end.termination, math::Termination::no_descent);
  EXPECT_NE(end.message.find("makes no force"), std::string::npos) << end.message;
}

TEST(PaperCase, ACriterionThatFallsWithoutLimitHasNoMinimum) {
  // The force of a straight line over speed, f_v = (v_max + v) / v_max, which is that of V_sh without limit.
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 6.0, .delay_s = 0.0});
  study.data.muscles[0].start = study.truth[0];
  PaperCase samples = paper_case(study.data, 0, true);
  const double v_max = samples.start.max_shortening_speed_mps, v_sh = samples.start.concentric_curvature;
  const Eigen::VectorXd start = samples.start_vector();
  for (MuscleSample& s : samples.samples) s.force_n *= (v_sh * v_max - s.fiber_velocity_mps) / (v_sh * v_max);
  const math::LeastSquaresResult end = search_for_minimum(samples, start).found;
  EXPECT_EQ(end.termination, math::Termination::no_descent);
  EXPECT_NE(end.message.find("concentric_curvature grows without limit"), std::string::npos) << end.message;
  EXPECT_NEAR(end.x[0], start[0], 1e-4 * start[0]);
  EXPECT_NEAR(end.x[1], start[1], 1e-4 * start[1]);
}

TEST(PaperCase, TenSamplesPerUnknownAndAForceAreNeeded) {
  StudyData data = test::elbow_study({.trials = 1, .seconds = 4.0, .delay_s = 0.0}).data;
  EXPECT_EQ(paper_case(data, 0, true).obstacle(), "");
  StudyData idle = data;
  idle.trials[0].force_n.col(0).setZero();
  EXPECT_NE(paper_case(idle, 0, true).obstacle().find("no force"), std::string::npos);
  data.trials[0].velocity_mps.col(0).setConstant(0.1);
  data.trials[0].velocity_mps.col(0).head(29).setConstant(-0.1);
  EXPECT_EQ(paper_case(data, 0, true).obstacle(), "only 29 samples in shortening");
}

}  // namespace
}  // namespace myoid::fit
