#include "myoid/posterior/joint_parts.h"

#include <gtest/gtest.h>

#include "tests/support/leg_study.h"

namespace myoid::identification {
namespace {

/// The runs of a leg study, with the angles of its joints.
std::vector<TrialRun> leg_runs(bool bent) {
  const StudyData data = test::leg_study({.seconds = 7.0, .bent = bent}).data;
  return trial_runs(data, {}, ParameterMap(data, {}));
}

/// Root mean square of a - b less its mean, over that of b.
double off(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::ArrayXd difference = a - b, of = b.array() - b.mean();
  return (difference - difference.mean()).matrix().norm() / of.matrix().norm();
}

constexpr std::size_t kGas = 1;

TEST(JointParts, AreWhatEachJointMakesOfTheLength) {
  for (const bool bent : {false, true}) {
    const std::vector<TrialRun> runs = leg_runs(bent);
    const JointParts parts(runs);
    for (const TrialRun& run : runs) {
      for (std::size_t j = 0; j < 2; ++j) {
        const auto q = run.motion.col(0).segment(run.first_row(j), run.time_s.size());
        const Eigen::VectorXd truth =
            q.unaryExpr([&](double of) { return test::leg_part_m(test::kLegMuscles[kGas], j, of, bent); });
        // Exact of constant arms; else as far as the arms differ from their means, here by up to a quarter.
        EXPECT_LT(off(parts.of(run.length_m, kGas, static_cast<int>(j)), truth), bent ? 0.15 : 1e-9) << j;
        const auto rate = run.motion.col(1).segment(run.first_row(j), run.time_s.size());
        const Eigen::VectorXd true_rate =
            -run.arm_m.col(kGas).segment(run.first_row(j), run.time_s.size()).cwiseProduct(rate);
        EXPECT_LT(off(parts.of(run.velocity_mps, kGas, static_cast<int>(j)), true_rate), bent ? 0.15 : 1e-9) << j;
      }
    }
  }
}

TEST(JointParts, AddToTheLengthAndAreAllOfItForOneJoint) {
  const std::vector<TrialRun> runs = leg_runs(true);
  const JointParts parts(runs);
  ASSERT_EQ(parts.joint_count(), 2);
  for (const TrialRun& run : runs) {
    const Eigen::VectorXd both = parts.of(run.length_m, kGas, 0) + parts.of(run.length_m, kGas, 1);
    // Up to round-off.
    EXPECT_LT(off(both, run.length_m.col(kGas)), 1e-10);
    EXPECT_EQ(parts.of(run.length_m, 0, 0), run.length_m.col(0));
  }
  EXPECT_TRUE(parts.crosses(0, 0));
  EXPECT_FALSE(parts.crosses(0, 1));
  EXPECT_TRUE(parts.crosses(kGas, 0) && parts.crosses(kGas, 1));
  EXPECT_FALSE(parts.crosses(3, 0));
}

}  // namespace
}  // namespace myoid::identification
