#include "myoid/methods/start_box.h"

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

test::ElbowStudy small_study() { return test::elbow_study({.trials = 1, .seconds = 4.0, .with_priors = true}); }

TEST(StartBox, OfThePublishedMethodTurnsAPriorOfALogarithmIntoItsOwnUnit) {
  test::ElbowStudy study = small_study();
  study.data.muscles[0].priors["optimal_fiber_length"] = {0.1, 0.05, true};
  study.data.muscles[0].priors["force_length_width"] = {0.05, 0.004, false};
  study.data.muscles[0].priors.erase("concentric_curvature");
  const PaperCase samples = paper_case(study.data, 0, true);
  const StartBox box = start_box(samples, study.data.muscles[0]);
  ASSERT_EQ(box.given.size(), 3);  // l0, l_sh, V_sh
  EXPECT_DOUBLE_EQ(box.spread[0], 0.05 * box.given[0]);
  EXPECT_DOUBLE_EQ(box.spread[1], 0.004);
  EXPECT_DOUBLE_EQ(box.spread[2], 0.1 * box.given[2]);
  EXPECT_DOUBLE_EQ(box.upper[1], box.given[1] + 0.008);
}

StartBox unit_box(Eigen::Index unknowns) {
  return {.given = Eigen::VectorXd::Constant(unknowns, 0.1),
          .spread = Eigen::VectorXd::Constant(unknowns, 0.25),
          .lower = Eigen::VectorXd::Zero(unknowns),
          .upper = Eigen::VectorXd::Ones(unknowns)};
}

TEST(StartBox, StartsAreTheGivenOneAndPointsThatFillTheBox) {
  const StartBox box = unit_box(3);
  const auto starts = starts_in(box, 65);
  ASSERT_EQ(starts.size(), 65U);
  EXPECT_EQ(starts[0], box.given);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t s = 1; s < starts.size(); ++s) {
    EXPECT_GT(starts[s].minCoeff(), 0.0);
    EXPECT_LT(starts[s].maxCoeff(), 1.0);
    mean += starts[s] / 64.0;
  }
  EXPECT_LT((mean - Eigen::Vector3d::Constant(0.5)).norm(), 0.05);
  EXPECT_EQ(starts_in(box, 1).size(), 1U);
}

TEST(StartBox, MoreUnknownsThanTheSequenceHasDimensionsGetStartsOfTheirOwn) {
  // A whole leg has some 150. Sobol numbers go to 64; the 65th must not repeat the first.
  const auto starts = starts_in(unit_box(150), 33);
  ASSERT_EQ(starts.size(), 33U);
  double same = 0.0;
  for (std::size_t s = 1; s < starts.size(); ++s) {
    EXPECT_GE(starts[s].minCoeff(), 0.0);
    EXPECT_LE(starts[s].maxCoeff(), 1.0);
    same += (starts[s].head(64) - starts[s].segment(64, 64)).cwiseAbs().mean() / 32.0;
  }
  EXPECT_GT(same, 0.2);  // 1/3 for two independent uniform numbers
}

TEST(StartBox, DistanceIsTheRootMeanSquareInSpreads) {
  const StartBox box = unit_box(4);
  EXPECT_DOUBLE_EQ(distance(box.given, box.given.array() + 0.5, box), 2.0);
}

}  // namespace
}  // namespace myoid::identification
