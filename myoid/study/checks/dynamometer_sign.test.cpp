#include "myoid/study/checks/dynamometer_sign.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

/// An isometric push of the elbow: up to `share` of full activation in flexors or extensors, held
/// by a dynamometer of `torque_nm` that pushes the other way.
struct Push {
  TrialSpec spec;
  TimeSeries torque, envelopes;

  Push(const std::string& name, bool flexion, double share, double torque_nm) {
    spec.name = name;
    spec.external_torque = name + ".sto";
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(500, 0.0, 5.0);
    const Eigen::VectorXd effort = (0.63 * t.array()).sin();
    torque = TimeSeries(t, {{"elbow_flexion_moment", Unit::newton_meter}},
                        Eigen::MatrixXd((flexion ? -torque_nm : torque_nm) * effort));
    // A fifth of it is cocontraction.
    Eigen::MatrixXd a(500, 4);
    for (Eigen::Index c = 0; c < 4; ++c) a.col(c) = ((c == 3) != flexion ? 1.0 : 0.2) * share * effort;
    std::vector<Channel> channels;
    for (const char* muscle : {"BIC", "BRA", "BRD", "TRI"}) channels.push_back({muscle, Unit::volt});
    envelopes = TimeSeries(t, channels, 1e-3 * a);
  }
};

std::vector<Remark> findings(const std::vector<Push>& pushes) {
  std::vector<EffortTrial> trials;
  for (const Push& p : pushes) trials.push_back({&p.spec, &p.torque, p.envelopes, nullptr});
  return dynamometer_signs(arm_study(), arm(), trials);
}

TEST(DynamometerSigns, AreRightWhereItPushesAgainstTheMuscles) {
  EXPECT_TRUE(findings({{"up", true, 1.0, 50.0}, {"down", false, 1.0, 40.0}}).empty());
}

TEST(DynamometerSigns, ReversedInEveryTrialAreAnErrorThatSaysWhatToNegate) {
  const std::vector<Remark> found = findings({{"up", true, 1.0, -50.0}, {"down", false, 1.0, -40.0}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_EQ(found[0].where, "up");
  EXPECT_EQ(found[0].code, RemarkCode::dynamometer_sign);
  EXPECT_EQ(found[0].says.find("up.sto"), 0U) << found[0].says;
  EXPECT_NE(found[0].says.find("elbow_flexion"), std::string::npos) << found[0].says;
}

TEST(DynamometerSigns, ReversedInOneTrialAreAWarningOfThatTrial) {
  const std::vector<Remark> found =
      findings({{"up", true, 1.0, 50.0}, {"down", false, 1.0, -40.0}, {"again", true, 0.7, 30.0}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_EQ(found[0].where, "down");
}

/// Its torque turns about at a share of the trial.
void turn_after(Push& push, double share) {
  Eigen::MatrixXd values = push.torque.values();
  values.bottomRows(static_cast<Eigen::Index>((1.0 - share) * 500.0)) *= -1.0;
  push.torque = TimeSeries(push.torque.time_s(), push.torque.channels(), values);
}

TEST(DynamometerSigns, AreAnErrorOnlyWhereAllTrialsAndAllOfThemSaySo) {
  // A torque half against and half with the muscles says nothing.
  std::vector<Push> half{{"both", true, 1.0, -50.0}};
  turn_after(half[0], 0.5);
  EXPECT_TRUE(findings(half).empty());
  // The muscles' effort is sin(0.63 t): its squares are even about the middle of 5 s, and by 71 %
  // of the time 81 % of them are past: cosine -0.62.
  std::vector<Push> most{{"most", true, 1.0, -50.0}};
  turn_after(most[0], 0.71);
  const std::vector<Remark> unsure = findings(most);
  ASSERT_EQ(unsure.size(), 1U);
  EXPECT_EQ(unsure[0].severity, Severity::warning);
  // A small torque of the right sign beside a large one of the wrong sign.
  const std::vector<Remark> one = findings({{"large", true, 1.0, -50.0}, {"small", true, 0.3, 15.0}});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].severity, Severity::warning);
}

TEST(DynamometerSigns, OfAllTrialsTogetherAreCertainWhereEachAloneIsNot) {
  std::vector<Push> pushes;
  for (const char* name : {"a", "b", "c", "d"}) {
    pushes.push_back({name, true, 1.0, -50.0});
    turn_after(pushes.back(), 0.6);  // cosine -0.39
  }
  // The fifth is a light touch, which is no evidence and has the same sign.
  pushes.push_back({"light", true, 1.0, -3.0});
  const std::vector<Remark> found = findings(pushes);
  ASSERT_EQ(found.size(), 5U);
  for (const Remark& remark : found) EXPECT_EQ(remark.severity, Severity::error);
  // One that contradicts: somebody turned some of the files.
  pushes[4] = {"right", true, 1.0, 50.0};
  EXPECT_TRUE(findings(pushes).empty());
}

/// A push whose flexors' EMG lies in the channel of the triceps, and its EMG in that of the biceps.
Push with_exchanged_electrodes(const char* name, bool flexion, double torque_nm) {
  Push push(name, flexion, 1.0, torque_nm);
  Eigen::MatrixXd a = push.envelopes.values();
  a.col(0).swap(a.col(3));
  // The synergists had no electrodes.
  a.middleCols(1, 2).setZero();
  push.envelopes = TimeSeries(push.envelopes.time_s(), push.envelopes.channels(), a);
  return push;
}

TEST(DynamometerSigns, ThatExchangedElectrodesExplainAsWellNameBoth) {
  const std::vector<Remark> found =
      findings({with_exchanged_electrodes("up", true, 50.0), with_exchanged_electrodes("down", false, 40.0)});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_THAT(found[0].remedy, testing::AllOf(testing::HasSubstr("BIC and TRI"), testing::HasSubstr("negate")));
  // With the synergists' EMG, exchanged electrodes do not explain a reversed torque.
  std::vector<Push> reversed;
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) reversed.push_back({name, true, 1.0, -50.0});
  EXPECT_THAT(findings(reversed)[0].remedy, testing::Not(testing::HasSubstr("TRI")));
}

/// The torque of a dynamometer on a relaxed elbow that resists with 20 N m over 1 rad from its middle, and its motion.
struct Relaxed {
  TrialSpec spec;
  TimeSeries torque, motion;

  Relaxed(double of_torque, double of_angle) {
    spec.name = "relaxed";
    spec.use = Use::passive;
    spec.external_torque = "relaxed.sto";
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(500, 0.0, 5.0);
    const Eigen::VectorXd q = (0.63 * t.array()).sin();
    torque = TimeSeries(t, {{"elbow_flexion_moment", Unit::newton_meter}}, Eigen::MatrixXd(of_torque * 20.0 * q));
    motion = TimeSeries(t, {{"elbow_flexion", Unit::radian}}, Eigen::MatrixXd(of_angle * q));
  }
};

std::vector<Remark> findings_of(const Push& push, const Relaxed& relaxed) {
  return dynamometer_signs(arm_study(), arm(),
                           {{&push.spec, &push.torque, push.envelopes, nullptr},
                            {&relaxed.spec, &relaxed.torque, TimeSeries{}, &relaxed.motion}});
}

TEST(DynamometerSigns, OfARelaxedJointThatYieldsAreAWarningOfTheAngleWhereTheEmgAgreesWithTheTorque) {
  const Push push("up", true, 1.0, 50.0);
  EXPECT_TRUE(findings_of(push, Relaxed(1.0, 1.0)).empty());
  const std::vector<Remark> found = findings_of(push, Relaxed(1.0, -1.0));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_EQ(found[0].where, "relaxed");
  // Torques of every trial reversed: the torque is named, and it alone.
  const std::vector<Remark> torque = findings_of(Push("up", true, 1.0, -50.0), Relaxed(-1.0, 1.0));
  ASSERT_EQ(torque.size(), 1U);
  EXPECT_EQ(torque[0].where, "up");
  EXPECT_THAT(torque[0].remedy, testing::Not(testing::HasSubstr("electrodes")));
}

TEST(DynamometerSigns, AreToldWhereThereIsEmg) {
  std::vector<Push> pushes{{"up", true, 1.0, -50.0}};
  const TimeSeries whole = pushes[0].envelopes;
  pushes[0].envelopes =
      TimeSeries(whole.time_s().segment(100, 300), whole.channels(), whole.values().middleRows(100, 300));
  EXPECT_EQ(findings(pushes).size(), 1U);
}

TEST(DynamometerSigns, OfAPassiveLimbOrALightTouchNobodyKnows) {
  std::vector<Push> pushes{{"up", true, 1.0, 50.0}, {"light", true, 1.0, -3.0}};
  EXPECT_TRUE(findings(pushes).empty());
  pushes[1] = {"relaxed", true, 0.03, -30.0};
  EXPECT_TRUE(findings(pushes).empty());
  pushes[1] = {"passive", true, 1.0, -30.0};
  pushes[1].spec.use = Use::passive;
  EXPECT_TRUE(findings(pushes).empty());
}

}  // namespace
}  // namespace myoid::study
