#include "myoid/study/checks/given_check.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/elbow_study.h"

namespace myoid::study {
namespace {

using fit::TrialData;

const TrialFiles kFiles{
    .activations = "a.sto", .lengths = "l.sto", .velocities = "v.sto", .moment_arms = {"r.sto"}, .torques = "id.sto"};

/// One trial of four muscles, spoiled.
struct Spoiled {
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 10.0});
  TrialFiles files = kFiles;

  TrialData& trial() { return study.data.trials[0]; }
  std::vector<std::string> check() { return check_given_trial(study.data, trial(), files); }
  /// Message of the error; empty: none.
  std::string error() {
    try {
      (void)check();
    } catch (const InvalidInput& failure) {
      return failure.what();
    }
    return {};
  }
};

void expect_in(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

TEST(GivenCheck, OfGoodDataNothingIsSaid) {
  Spoiled good;
  const std::vector<std::string> remarks = good.check();
  EXPECT_TRUE(remarks.empty()) << (remarks.empty() ? "" : remarks[0]);
}

TEST(GivenCheck, LengthsInMillimetersOrOfFibersAreNamed) {
  Spoiled mm;
  mm.trial().length_m *= 1000.0;
  expect_in(mm.error(), {"l.sto", "BIC", "mm", "0.01 to 1 m"});
  Spoiled cm;
  cm.trial().length_m *= 100.0;
  expect_in(cm.error(), {"l.sto", "cm"});
  Spoiled fibers;
  for (Eigen::Index k = 0; k < 4; ++k)
    fibers.trial().length_m.col(k).array() -=
        fibers.study.data.muscles[static_cast<std::size_t>(k)].start.tendon_slack_length_m;
  expect_in(fibers.error(), {"l.sto", "tendon_slack_length", "fiber lengths"});
}

TEST(GivenCheck, LengthsOfWholeMusclesWithoutATendonAreRefused) {
  const auto without_tendon = [](double times_optimal) {
    Spoiled s;
    for (Eigen::Index k = 0; k < 4; ++k) {
      muscle::HillParameters<double>& start = s.study.data.muscles[static_cast<std::size_t>(k)].start;
      const Eigen::VectorXd l = s.trial().length_m.col(k);
      // A small swing about the length asked for: no length is negative.
      s.trial().length_m.col(k) = 0.1 * (l.array() - l.mean()) + times_optimal * start.optimal_fiber_length_m;
      s.trial().velocity_mps.col(k) *= 0.1;
      start.tendon_slack_length_m = 0.0;
    }
    return s;
  };
  EXPECT_EQ(without_tendon(1.0).error(), "");
  EXPECT_EQ(without_tendon(1.6).error(), "");
  expect_in(without_tendon(2.5).error(), {"l.sto", "whole muscles", "tendon_slack_length"});
  expect_in(without_tendon(0.3).error(), {"l.sto", "optimal"});
  Spoiled named = without_tendon(1.4);
  named.files.lengths = "x_MuscleAnalysis_Length.sto";
  const std::vector<std::string> remarks = named.check();
  ASSERT_FALSE(remarks.empty());
  expect_in(remarks[0], {"whole muscles", "tendon_slack_length"});
}

TEST(GivenCheck, SwappedLengthsAndVelocitiesAreNamed) {
  Spoiled swapped;
  std::swap(swapped.trial().length_m, swapped.trial().velocity_mps);
  expect_in(swapped.error(), {"l.sto", "velocities"});
}

TEST(GivenCheck, ExchangedLengthsAndMomentArmsAreNamed) {
  Spoiled swapped;
  std::swap(swapped.trial().length_m, swapped.trial().moment_arm_m);
  swapped.trial().length_m = swapped.trial().length_m.cwiseAbs();
  expect_in(swapped.error(), {"r.sto", "BIC", "lengths and moment arms exchanged?"});
  // Fibers without a tendon may be shorter than a moment arm, as those of the soleus are.
  Spoiled fibers;
  for (Eigen::Index k = 0; k < 4; ++k) {
    auto& start = fibers.study.data.muscles[static_cast<std::size_t>(k)].start;
    fibers.trial().length_m.col(k).setConstant(start.optimal_fiber_length_m);
    fibers.trial().moment_arm_m.col(k).setConstant(1.2 * start.optimal_fiber_length_m);
    start.tendon_slack_length_m = 0.0;
  }
  fibers.files.velocities.clear();
  fibers.files.torques.clear();
  EXPECT_EQ(fibers.error(), "");
  const std::vector<std::string> remarks = fibers.check();
  ASSERT_FALSE(remarks.empty());
  expect_in(remarks[0], {"r.sto", "exchanged?", "Fibers"});
}

TEST(GivenCheck, ActivationsInPercentOrRawAreNamed) {
  Spoiled percent, raw, beyond, volts;
  const auto scale = [](Spoiled& s, double factor, double offset) {
    const TimeSeries& a = s.trial().activation;
    s.trial().activation =
        TimeSeries(a.time_s(), a.channels(), ((factor * a.values()).array() + offset).matrix().eval());
  };
  scale(percent, 100.0, 0.0);
  expect_in(percent.error(), {"a.sto", "percent", "100"});
  Spoiled tenfold;
  scale(tenfold, 10.0 / tenfold.trial().activation.values().maxCoeff(), 0.0);
  expect_in(tenfold.error(), {"a.sto", "largest value of a maximal contraction"});
  EXPECT_EQ(tenfold.error().find("percent"), std::string::npos) << tenfold.error();
  scale(raw, 1.0, -0.3);
  expect_in(raw.error(), {"a.sto", "raw EMG"});
  const double highest = beyond.trial().activation.values().maxCoeff();
  scale(beyond, 1.4 / highest, 0.0);
  EXPECT_FALSE(beyond.check().empty());
  scale(volts, 1e-3, 0.0);
  const auto remarks = volts.check();
  ASSERT_FALSE(remarks.empty());
  expect_in(remarks[0], {"volts"});
}

TEST(GivenCheck, APeakAboveTheGreatestHalfSecondIsNothingToSay) {
  Spoiled peaked;
  const TimeSeries& a = peaked.trial().activation;
  Eigen::MatrixXd values = a.values() / a.values().maxCoeff();
  const auto brief = static_cast<Eigen::Index>(0.05 * a.mean_rate_hz());
  values.block(values.rows() / 2, 0, brief, 1).setConstant(1.6);
  peaked.trial().activation = TimeSeries(a.time_s(), a.channels(), values);
  EXPECT_TRUE(peaked.check().empty());
}

TEST(GivenCheck, VelocitiesThatAreNotTheRateOfTheLengthsAreNamed) {
  Spoiled flipped, mm, other;
  flipped.trial().velocity_mps *= -1.0;
  expect_in(flipped.error(), {"v.sto", "opposite", "sign"});
  mm.trial().velocity_mps *= 1000.0;
  expect_in(mm.error(), {"v.sto", "1000 times"});
  other.trial().velocity_mps = other.trial().velocity_mps.colwise().reverse().eval();
  const auto remarks = other.check();
  ASSERT_FALSE(remarks.empty());
  expect_in(remarks[0], {"v.sto", "same trial"});
}

TEST(GivenCheck, NoiseOfTheLengthsIsNoError) {
  // 1 mm of white noise at 100 Hz: its rate, 140 mm/s, is as large as the movement's.
  Spoiled noisy;
  test::StudyNoise noise(5);
  for (double& l : noisy.trial().length_m.reshaped()) l += 1e-3 * noise.normal();
  EXPECT_EQ(noisy.error(), "");
}

TEST(GivenCheck, MomentArmsOfAWrongUnitSignOrMuscleAreNamed) {
  Spoiled mm, flipped, torque, one;
  mm.trial().moment_arm_m *= 1000.0;
  expect_in(mm.error(), {"r.sto", "mm", "0.2 m"});
  flipped.trial().moment_arm_m *= -1.0;
  expect_in(flipped.error(), {"r.sto", "id.sto", "sign"});
  torque.trial().torque_nm *= -1.0;
  expect_in(torque.error(), {"id.sto", "sign"});
  one.trial().moment_arm_m.col(0) *= -1.0;
  const auto remarks = one.check();
  ASSERT_FALSE(remarks.empty());
  expect_in(remarks[0], {"r.sto", "is the sign of BIC wrong?"});
}

TEST(GivenCheck, TorqueInNewtonMillimetersIsNamed) {
  Spoiled mm;
  mm.trial().torque_nm *= 1000.0;
  expect_in(mm.error(), {"id.sto", "N mm", "Divide by 1000"});
  // A person of twice the strength that the search starts with is one.
  Spoiled strong;
  strong.trial().torque_nm *= 2.0;
  EXPECT_EQ(strong.error(), "");
}

TEST(GivenCheck, MomentArmsOfTwoJointsInTheWrongOrderAreNamed) {
  // A second joint that the muscles turn otherwise.
  Spoiled two;
  TrialData& trial = two.trial();
  Eigen::MatrixXd arm = trial.moment_arm_m;
  arm.col(0) *= -0.8;
  arm.col(1) *= 0.3;
  arm.col(3) *= -1.2;
  const Eigen::VectorXd torque = arm.cwiseProduct(trial.force_n).rowwise().sum();
  trial.more_joints.push_back({.joint = "b",
                               .torque_nm = torque,
                               .moment_arm_m = arm,
                               .angle_rad = {},
                               .velocity_radps = {},
                               .acceleration_radps2 = {}});
  two.files.moment_arms = {"rA.sto", "rB.sto"};
  EXPECT_EQ(two.error(), "");
  EXPECT_TRUE(two.check().empty());
  std::swap(trial.moment_arm_m, trial.more_joints[0].moment_arm_m);
  std::string said = two.error();
  if (said.empty()) {
    for (const std::string& remark : two.check()) said += remark;
  }
  expect_in(said, {"rA.sto", "the order of the coordinates"});
}

TEST(GivenCheck, TorqueWhileAllEmgIsQuietIsNamed) {
  const auto resting = [](double offset_nm, Eigen::Index rows) {
    Spoiled s;
    const TimeSeries& a = s.trial().activation;
    Eigen::MatrixXd values = a.values();
    values.topRows(rows).setConstant(0.005);
    s.trial().activation = TimeSeries(a.time_s(), a.channels(), values);
    s.trial().torque_nm.head(rows).setZero();
    s.trial().torque_nm.array() += offset_nm;
    return s;
  };
  const double peak_nm = Spoiled{}.trial().torque_nm.cwiseAbs().maxCoeff();
  EXPECT_TRUE(resting(0.02 * peak_nm, 400).check().empty());
  EXPECT_TRUE(resting(0.2 * peak_nm, 40).check().empty());  // too short to tell
  Spoiled raw = resting(0.2 * peak_nm, 400);
  const std::vector<std::string> remarks = raw.check();
  ASSERT_EQ(remarks.size(), 1U);
  expect_in(remarks[0], {"id.sto", "while all EMG is below 0.02", "gravity", "joint_torque_offset"});
  raw.files.resting_torque_is_free = true;
  EXPECT_TRUE(raw.check().empty());
}

}  // namespace
}  // namespace myoid::study
