#include "myoid/run/resting_joints.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/lab/twin/synthetic_recording.h"
#include "myoid/lab/twin/write_recording.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/run/run_study.h"
#include "myoid/study/read_study.h"

namespace myoid::run {
namespace {

using ::testing::HasSubstr;

/// A person whose joint has a torque of its own, relaxed and at one effort.
struct Recorded {
  lab::VirtualRecording recording;
  study::Study study;
  std::vector<study::TrialInput> inputs;
};

Recorded recorded() {
  lab::Protocol protocol = lab::default_protocol(lab::Level::noisy);
  protocol.truth.beside_muscles = true;
  const auto trial = [&](const char* name, lab::TrialKind kind, const char* use) {
    lab::TrialProtocol t;
    t.name = name;
    t.kind = kind;
    t.use = use;
    t.lift.from_rad = 15.0 * kDegree;
    t.lift.to_rad = 125.0 * kDegree;
    t.lift.raise_s = 4.0;
    t.lift.lower_s = 4.0;
    protocol.trials.push_back(t);
  };
  trial("relaxed", lab::TrialKind::passive, "passive");
  trial("mvc", lab::TrialKind::mvc, "mvc");
  trial("ramp", lab::TrialKind::isometric_ramp, "calibration");
  Recorded r{lab::make_virtual_recording(protocol, 5), {}, {}};
  r.study = study::parse_study(lab::study_toml(r.recording), "study.toml");
  r.study.model.text = r.recording.model_osim;
  r.study.identify.methods = {fit::Method::torque};
  r.study.identify.cross_validate = false;
  r.study.identify.next_movements = 0;
  r.study.truth.reset();
  for (const lab::VirtualTrial& t : r.recording.trials) {
    study::TrialInput input;
    input.markers = t.markers;
    input.emg = t.emg;
    input.external_torque = t.external_torque;
    r.inputs.push_back(std::move(input));
  }
  return r;
}

TEST(RestingJoints, WhatTheJointOfAPersonDoesByItselfIsFound) {
  // Noise of the dynamometer, 0.3 N m below 5 Hz: 80 independent values for six unknowns, 0.08 N m.
  Recorded r = recorded();
  const lab::BesideMuscles truth = r.recording.truth.beside;
  const StudyResult result = analyse(in_memory(r.study, std::move(r.inputs)));
  ASSERT_EQ(result.resting.size(), 1U);
  EXPECT_EQ(result.resting[0].joint, "elbow_flexion");
  EXPECT_EQ(result.resting[0].trials, std::vector<std::string>{"relaxed"});
  ASSERT_GT(std::abs(truth.joint_torque_nm) + std::abs(truth.joint_stiffness_nm_per_rad), 0.5);
  for (const double angle_deg : {25.0, 50.0, 70.0, 90.0, 115.0}) {
    const double q = angle_deg * kDegree;
    EXPECT_NEAR(result.resting[0].torque.at(q), truth.joint_torque_nm - truth.joint_stiffness_nm_per_rad * q, 0.3)
        << angle_deg;
  }
  EXPECT_EQ(std::ranges::count(result.trials[2].remarks, RemarkCode::resting_torque, &Remark::code), 0);
  ASSERT_EQ(result.fit_input.data.trials.size(), 2U);  // the maximal contraction, and
  const fit::TrialData& ramp = result.fit_input.data.trials.back();
  EXPECT_EQ(ramp.resting_nm, result.resting[0].torque.at(ramp.angle_rad));
}

TEST(RestingJoints, MusclesThatWereAtWorkShowNoRestingJoint) {
  Recorded r = recorded();
  r.inputs[0].emg = r.inputs[2].emg;  // that of the effort
  const StudyResult result = analyse(in_memory(r.study, std::move(r.inputs)));
  EXPECT_TRUE(result.resting.empty());
  ASSERT_FALSE(result.trials[0].remarks.empty());
  EXPECT_EQ(result.trials[0].remarks.back().severity, Severity::warning);
  EXPECT_EQ(result.trials[0].remarks.back().code, RemarkCode::resting_torque);
  EXPECT_THAT(result.trials[0].remarks.back().says, HasSubstr("EMG"));
  EXPECT_EQ(result.fit_input.data.trials[0].resting_nm.size(), 0);
}

TEST(RestingJoints, WithoutAMaximalContractionRestIsAgainstTheGreatestOfTheStudy) {
  for (const bool at_work : {false, true}) {
    Recorded r = recorded();
    r.study.emg.has_mvc = false;
    r.study.trials[1].use = study::Use::validation;
    if (at_work) r.inputs[0].emg = r.inputs[2].emg;
    const StudyResult result = analyse(in_memory(r.study, std::move(r.inputs)));
    EXPECT_EQ(result.resting.empty(), at_work);
    if (!at_work) continue;
    ASSERT_FALSE(result.trials[0].remarks.empty());
    EXPECT_EQ(result.trials[0].remarks.back().severity, Severity::warning);
    EXPECT_THAT(result.trials[0].remarks.back().says, HasSubstr("greatest value"));
  }
}

TEST(RestingJoints, WithoutEmgTheStudyIsTakenAtItsWord) {
  Recorded with = recorded();
  const StudyResult known = analyse(in_memory(with.study, std::move(with.inputs)));
  Recorded r = recorded();
  r.inputs[0].emg.reset();
  r.study.trials[0].emg.reset();
  const StudyResult result = analyse(in_memory(r.study, std::move(r.inputs)));
  ASSERT_EQ(result.resting.size(), 1U);
  EXPECT_EQ(result.resting[0].torque.coefficient_nm, known.resting[0].torque.coefficient_nm);
  EXPECT_TRUE(std::ranges::any_of(result.trials[0].remarks, [](const Remark& remark) {
    return remark.code == RemarkCode::resting_torque && remark.severity == Severity::note;
  }));
}

TEST(RestingJoints, TheWeightOfTheInstrumentIsPartOfIt) {
  // A lever of 1.5 kg at 1 m: 15 N m cos(q), and an offset, beside the joint's own torque.
  Recorded plain = recorded();
  const StudyResult without = analyse(in_memory(plain.study, std::move(plain.inputs)));
  Recorded r = recorded();
  TimeSeries& torque = *r.inputs[0].external_torque;
  const Eigen::VectorXd q = without.trials[0].motion.joints.q.column("elbow_flexion");
  const TimeSeries motion(without.trials[0].motion.joints.q.time_s(), {{"q", Unit::radian}}, q);
  const Eigen::VectorXd angle = recording::resample(motion, torque.time_s()).values().col(0);
  Eigen::MatrixXd loaded = torque.values();
  loaded.col(0).array() -= 15.0 * angle.array().cos() + 2.0;
  torque = TimeSeries(torque.time_s(), torque.channels(), loaded);
  const StudyResult result = analyse(in_memory(r.study, std::move(r.inputs)));
  ASSERT_EQ(result.resting.size(), 1U);
  for (const double angle_deg : {25.0, 50.0, 70.0, 90.0, 115.0}) {
    const double at = angle_deg * kDegree;
    EXPECT_NEAR(result.resting[0].torque.at(at), without.resting[0].torque.at(at) + 15.0 * std::cos(at) + 2.0, 0.2)
        << angle_deg;
  }
}

TEST(RestingJoints, ATorqueThatNoRelaxedJointHasIsNotTaken) {
  Recorded r = recorded();
  TimeSeries& torque = *r.inputs[0].external_torque;
  torque = TimeSeries(torque.time_s(), torque.channels(), torque.values().array() + 90.0);
  const StudyResult result = analyse(in_memory(r.study, std::move(r.inputs)));
  EXPECT_TRUE(result.resting.empty());
  ASSERT_FALSE(result.trials[0].remarks.empty());
  EXPECT_EQ(result.trials[0].remarks.back().severity, Severity::warning);
  EXPECT_THAT(result.trials[0].remarks.back().says, HasSubstr(" 25 %"));
}

TEST(RestingJoints, WithoutAMeasuredTorqueNothingIsKnown) {
  Recorded r = recorded();
  r.study.trials[0].external_torque.reset();
  const StudyResult result = analyse(in_memory(r.study, std::move(r.inputs)));
  EXPECT_TRUE(result.resting.empty());
}

}  // namespace
}  // namespace myoid::run
