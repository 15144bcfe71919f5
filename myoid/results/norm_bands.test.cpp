#include "myoid/results/norm_bands.h"

#include <gtest/gtest.h>

namespace myoid::results {
namespace {

/// A trial from 2 to 4 s with an angle and a torque of the elbow.
struct NormBands : ::testing::Test {
  NormBands() {
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(201, 2.0, 4.0);
    trial.spec.name = "lift";
    trial.motion.joints.q = TimeSeries(t, {{"elbow_flexion", Unit::radian}}, Eigen::VectorXd(t));
    shown.clocks = {t};
    shown.plots = {{.kind = "angle", .title = "elbow flexion", .lines = {{.name = "angle"}}},
                   {.kind = "torque", .title = "elbow flexion", .lines = {{.name = "measured"}}}};
    study::Norm norm{"adults", {}, Eigen::Vector3d(0.0, 25.0, 100.0), {}};
    norm.curves = {{"elbow_flexion", false, Eigen::Vector3d(10, 20, 30), Eigen::Vector3d(1, 2, 3)}};
    source.norms = {norm};
  }

  run::StudySource source;
  run::TrialResult trial;
  page::WorkbenchTrial shown;
};

TEST_F(NormBands, LieBehindThePlotOfTheirQuantityFromBeginToEnd) {
  add_norms(source, trial, shown);
  ASSERT_EQ(shown.plots[0].lines.size(), 2U);
  EXPECT_EQ(shown.plots[1].lines.size(), 1U);  // the norm has no torque
  const page::TimeLine& band = shown.plots[0].lines[0];
  EXPECT_EQ(band.name, "adults, mean ± 1 SD");
  EXPECT_EQ(band.role, page::Role::norm);
  const Eigen::VectorXd& t = shown.clocks.at(static_cast<std::size_t>(band.clock));
  EXPECT_TRUE(t.isApprox(Eigen::Vector3d(2.0, 2.5, 4.0)));
  EXPECT_TRUE(band.value.isApprox(Eigen::Vector3d(9, 18, 27)));
  EXPECT_TRUE(band.upper.isApprox(Eigen::Vector3d(11, 22, 33)));
}

TEST_F(NormBands, BelongToTheTrialsThatTheyName) {
  source.norms[0].trials = {"gait"};
  add_norms(source, trial, shown);
  EXPECT_EQ(shown.plots[0].lines.size(), 1U);
  source.norms[0].trials = {"gait", "lift"};
  add_norms(source, trial, shown);
  EXPECT_EQ(shown.plots[0].lines.size(), 2U);
}

TEST_F(NormBands, AreNotOfAPartOfAMovement) {
  trial.input.remarks = {{.code = RemarkCode::clock_pause, .severity = Severity::warning}};
  add_norms(source, trial, shown);
  EXPECT_EQ(shown.plots[0].lines.size(), 1U);
}

}  // namespace
}  // namespace myoid::results
