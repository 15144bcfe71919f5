#include "myoid/fit/posterior/recorded.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"
#include "tests/support/leg_study.h"

namespace myoid::fit {
namespace {

/// A study and its runs.
struct RecordedStudy {
  explicit RecordedStudy(StudyData of)
      : data(std::move(of)), map(data, options), runs(trial_runs(data, options, map)) {}
  [[nodiscard]] Recorded session() const { return recorded(runs, map.held().muscles); }

  StudyData data;
  EstimatorOptions options;
  ParameterMap map;
  std::vector<TrialRun> runs;
};

StudyData two_efforts() { return test::elbow_study({.trials = 2, .seconds = 6.0}).data; }

TEST(Recorded, ARangeHoldsEveryLengthAndRateOfAllRuns) {
  RecordedStudy of(two_efforts());
  for (TrialRun& run : of.runs) run.velocity_mps.col(0).setConstant(-3.0);
  of.runs[0].length_m.col(0).setConstant(0.3);
  of.runs[1].length_m.col(0).setConstant(0.5);
  const Recorded::Range range = of.session().muscles[0];
  EXPECT_EQ(range.shortest_m, 0.3);
  EXPECT_EQ(range.longest_m, 0.5);
  EXPECT_EQ(range.fastest_mps, 3.0);
  const Eigen::ArrayXd place = range.place(Eigen::Array3d(0.3, 0.4, 0.5));
  EXPECT_NEAR(place[0], -1.0, 1e-12);
  EXPECT_NEAR(place[1], 0.0, 1e-12);
  EXPECT_NEAR(place[2], 1.0, 1e-12);
}

TEST(Recorded, AMuscleThatIsHeldHasARangeOfLengthsAndSpeeds) {
  RecordedStudy of(two_efforts());
  for (TrialRun& run : of.runs) {
    run.length_m.setConstant(0.3);
    run.velocity_mps.setZero();
  }
  const Recorded session = of.session();
  for (std::size_t k = 0; k < 4; ++k) {
    const muscle::HillParameters<double>& start = of.data.muscles[k].start;
    EXPECT_NEAR(session.muscles[k].span_m(), 0.5 * start.optimal_fiber_length_m,
                2e-6);  // a micrometer is the least span
    EXPECT_NEAR(session.muscles[k].fastest_mps, 0.1 * start.max_shortening_speed_mps, 1e-12);
  }
}

TEST(Recorded, TorquesHaveTheRootMeanSquareOfEachJointAndOfAll) {
  RecordedStudy of(test::leg_study({.seconds = 6.0}).data);
  const Eigen::Index joints = static_cast<Eigen::Index>(of.map.joints().size());
  ASSERT_EQ(joints, 2);
  for (TrialRun& run : of.runs) {
    const Eigen::Index m = run.measured_nm.size() / joints;
    run.measured_nm.head(m).setConstant(-3.0);
    run.measured_nm.tail(m).setConstant(4.0);
  }
  Recorded session = of.session();
  const auto first = static_cast<std::size_t>(of.runs[0].joints[0]);
  EXPECT_NEAR(session.joint_torque_nm[first], 3.0, 1e-12);
  EXPECT_NEAR(session.joint_torque_nm[1 - first], 4.0, 1e-12);
  EXPECT_NEAR(session.torque_nm, std::sqrt(12.5), 1e-12);
  EXPECT_NEAR(session.size_share(static_cast<int>(first)), 3.0 / std::sqrt(12.5), 1e-12);
  // A joint that carries nothing errs by a hundredth of the rest.
  session.joint_torque_nm[first] = 0.0;
  EXPECT_EQ(session.size_share(static_cast<int>(first)), 0.01);
}

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
}  // namespace myoid::fit
