#include "myoid/study/checks/unlike_trials.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

/// An isometric push of the flexors, or the extensors, of `share` of full activation against a dynamometer whose
/// numbers are `unit` N m; the opposite muscles act with `against` of the share.
struct EffortInUnit {
  TrialSpec spec;
  TimeSeries torque, envelopes;

  EffortInUnit(const std::string& name, double share, double unit, double against = 0.2, bool flexion = true) {
    spec.name = name;
    spec.external_torque = name + ".sto";
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(500, 0.0, 5.0);
    const Eigen::VectorXd effort = (0.63 * t.array()).sin();
    torque = TimeSeries(t, {{"elbow_flexion_moment", Unit::newton_meter}},
                        Eigen::MatrixXd((flexion ? -60.0 : 60.0) * share / unit * effort));
    Eigen::MatrixXd a(500, 4);
    for (Eigen::Index c = 0; c < 4; ++c) a.col(c) = ((c == 3) == flexion ? against : 1.0) * share * effort;
    std::vector<Channel> channels;
    for (const char* muscle : {"BIC", "BRA", "BRD", "TRI"}) channels.push_back({muscle, Unit::volt});
    envelopes = TimeSeries(t, channels, 1e-3 * a);
  }
};

std::vector<Remark> torques(const std::vector<EffortInUnit>& pushes) {
  std::vector<EffortTrial> trials;
  for (const EffortInUnit& p : pushes) trials.push_back({&p.spec, &p.torque, p.envelopes, nullptr});
  return unlike_torques(arm_study(), arm(), trials);
}

TEST(UnlikeTorques, ATrialInAnotherUnitIsAnErrorOfThatTrial) {
  const std::vector<EffortInUnit> others{
      {"a", 1.0, 1.0}, {"b", 0.3, 1.0}, {"c", 0.6, 1.3}, {"d", 0.8, 0.7}, {"down", 1.0, 1.0, 0.2, false}};
  EXPECT_TRUE(torques(others).empty());
  for (const double unit : {1000.0, 57.3, 1.0 / 8.0}) {
    std::vector<EffortInUnit> all = others;
    all.insert(all.begin() + 2, EffortInUnit("other", 0.5, unit));
    const std::vector<Remark> found = torques(all);
    ASSERT_EQ(found.size(), 1U) << unit;
    EXPECT_EQ(found[0].where, "other");
    // Inch-pounds could be an uncommon trial.
    EXPECT_EQ(found[0].severity, unit < 1.0 ? Severity::warning : Severity::error);
    EXPECT_EQ(found[0].code, RemarkCode::unit_doubtful);
    EXPECT_NEAR(std::log(found[0].value.value() * unit), 0.0, 0.5);
  }
}

TEST(UnlikeTorques, NobodyKnowsOfFewTrialsOrOfMusclesThatWorkAgainstEachOther) {
  EXPECT_TRUE(torques({{"a", 1.0, 1.0}, {"down", 1.0, 1.0, 0.2, false}, {"kilo", 0.6, 1000.0}}).empty());
  std::vector<EffortInUnit> stiff{
      {"a", 1.0, 1.0}, {"b", 0.3, 1.0}, {"down", 1.0, 1.0, 0.2, false}, {"stiff", 0.6, 100.0, 1.5}};
  EXPECT_TRUE(torques(stiff).empty());
}

TrialAngles moved(const std::string& trial, double least_deg, double greatest_deg, bool held = false) {
  return {trial, held, {least_deg * kDegree, greatest_deg * kDegree}};
}

TEST(UnlikeAngles, RadiansOfOneTrialUnderDegreesAreAWarning) {
  const std::vector<TrialAngles> others{moved("a", 10.0, 130.0), moved("b", 20.0, 100.0), moved("c", 5.0, 90.0)};
  EXPECT_TRUE(unlike_angles({{"elbow", others}}).empty());
  std::vector<TrialAngles> all = others;
  all.push_back(moved("radians", 20.0 * kDegree, 120.0 * kDegree));
  const std::vector<Remark> found = unlike_angles({{"elbow", all}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].where, "radians");
  EXPECT_EQ(found[0].code, RemarkCode::unit_doubtful);
  EXPECT_EQ(found[0].severity, Severity::warning);
}

TEST(UnlikeAngles, AJointThatIsHeldStraightOrLeavesTheRangeOfTheOthersIsAnAngle) {
  std::vector<TrialAngles> all{moved("a", 10.0, 130.0), moved("b", 20.0, 100.0), moved("c", 5.0, 90.0)};
  all.push_back(moved("straight", 0.5, 1.5, true));  // no other trial is held
  EXPECT_TRUE(unlike_angles({{"elbow", all}}).empty());
  all.back() = moved("small", -1.0, 1.0);  // as radians from -57 degrees on
  EXPECT_TRUE(unlike_angles({{"elbow", all}}).empty());
  all.back() = moved("less", 0.0, 12.0);
  EXPECT_TRUE(unlike_angles({{"elbow", all}}).empty());
}

}  // namespace
}  // namespace myoid::study
