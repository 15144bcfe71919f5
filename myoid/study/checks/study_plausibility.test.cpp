#include "myoid/study/checks/study_plausibility.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

#include "tests/support/vertical_slider.h"

namespace myoid::study {
namespace {

TimeSeries emg(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  Eigen::MatrixXd values(2000, 1);
  for (double& v : values.reshaped()) v = 1e-9 * static_cast<double>(engine() % 100000);
  return {Eigen::VectorXd::LinSpaced(2000, 0.0, 1.999), {{"BIC", Unit::volt}}, values};
}

TimeSeries elbow_motion(double to_deg) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(200, 0.0, 1.99);
  return {
      time, {{"elbow_flexion", Unit::radian}}, Eigen::MatrixXd(kDegree * to_deg * (2.0 * time.array()).sin().abs())};
}

struct TwoTrials {
  Study study;
  body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  std::vector<TrialInput> inputs = std::vector<TrialInput>(2);

  TwoTrials() {
    study.model.builtin = "arm4";
    // The motions of these tests have the elbow's angle alone.
    for (body::Coordinate& c : model.coordinates) c.locked = c.name != "elbow_flexion";
    study.trials.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
      study.trials[i].name = i == 0 ? "first" : "second";
      inputs[i].motion = elbow_motion(70.0 + 10.0 * static_cast<double>(i));
      inputs[i].emg = emg(1 + i);
    }
  }
};

TEST(RequirePlausible, LetsGoodTrialsPassUntouched) {
  TwoTrials two;
  require_plausible(two.study, two.model, two.inputs);
  EXPECT_TRUE(two.inputs[0].remarks.empty());
  EXPECT_TRUE(two.inputs[1].remarks.empty());
}

TEST(RequirePlausible, RefusesOneEmgInTwoTrialsAndNamesBoth) {
  TwoTrials two;
  two.inputs[1].emg = two.inputs[0].emg;
  try {
    require_plausible(two.study, two.model, two.inputs);
    FAIL() << "not refused";
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("'first'"), std::string::npos) << text;
    EXPECT_NE(text.find("(trial 'second')"), std::string::npos) << text;
  }
}

TEST(StudyPlausibility, RadiansThatAreCalledDegreesAreDoubtedOverAllTrials) {
  const auto doubts = [](double first_deg, double second_deg) {
    TwoTrials two;
    StudyPlausibility plausibility(two.study, two.model);
    for (std::size_t i = 0; i < 2; ++i) {
      two.inputs[i].motion = elbow_motion(i == 0 ? first_deg : second_deg);
      plausibility.look_at(two.study.trials[i], two.inputs[i]);
    }
    return std::ranges::count(plausibility.findings(), RemarkCode::unit_doubtful, &Remark::code);
  };
  EXPECT_EQ(doubts(70.0, 80.0), 0);
  EXPECT_EQ(doubts(70.0 * kDegree, 80.0 * kDegree), 1);
  EXPECT_EQ(doubts(1.0, 80.0), 0);  // a trial that is held near 0
  EXPECT_EQ(doubts(0.1, 0.1), 0);   // a joint that is held
}

TEST(StudyPlausibility, ATorqueThatStaysFarBelowTheMusclesIsOfAnotherUnit) {
  const auto doubts = [](double peak_nm) {
    TwoTrials two;
    StudyPlausibility plausibility(two.study, two.model);
    for (std::size_t i = 0; i < 2; ++i) {
      two.study.trials[i].external_torque = "push.csv";
      const Eigen::VectorXd& time = two.inputs[i].motion->time_s();
      two.inputs[i].external_torque = TimeSeries(time, {{"elbow_flexion_moment", Unit::newton_meter}},
                                                 Eigen::MatrixXd(peak_nm * (2.0 * time.array()).sin()));
      plausibility.look_at(two.study.trials[i], two.inputs[i]);
    }
    return std::ranges::count(plausibility.findings(), RemarkCode::unit_doubtful, &Remark::code);
  };
  EXPECT_EQ(doubts(40.0), 0);
  EXPECT_EQ(doubts(2.0), 0);   // a light touch
  EXPECT_EQ(doubts(0.04), 1);  // N m called N mm
  EXPECT_EQ(doubts(0.0), 0);   // a dynamometer that was off
}

TEST(StudyPlausibility, WhatSeveralTrialsHaveAlikeIsSaidOnce) {
  TwoTrials two;
  StudyPlausibility plausibility(two.study, two.model);
  for (std::size_t i = 0; i < 2; ++i) {
    two.study.trials[i].held_mass_kg = 60.0;
    plausibility.look_at(two.study.trials[i], two.inputs[i]);
  }
  const std::vector<Remark> found = plausibility.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].where, "first");
  EXPECT_EQ(found[0].likewise, std::vector<std::string>{"second"});
}

TEST(RequirePlausible, RefusesAMuscleThatMovesNoneOfTheCoordinates) {
  TwoTrials two;
  two.study.muscles = {{.name = "BIC", .osim = {"BIC"}, .emg = "BIC"}};
  require_plausible(two.study, two.model, two.inputs);
  two.study.model.coordinate = "shoulder_flexion";
  try {
    require_plausible(two.study, two.model, two.inputs);
    FAIL() << "not refused";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("shoulder_flexion"), std::string::npos) << error.what();
  }
}

TEST(RequirePlausible, VoltsThatAreCalledActivationsAreWarnedOf) {
  for (const bool volts : {true, false}) {
    TwoTrials two;
    two.study.emg.kind = EmgKind::activation;
    two.study.muscles = {{.name = "BIC", .osim = {"BIC"}, .emg = "BIC"}};
    for (std::size_t i = 0; i < 2; ++i)
      two.inputs[i].emg = TimeSeries(two.inputs[i].emg->time_s(), two.inputs[i].emg->channels(),
                                     (volts ? 1.0 : 1e4) * two.inputs[i].emg->values());
    require_plausible(two.study, two.model, two.inputs);
    ASSERT_EQ(two.inputs[0].remarks.size(), volts ? 1U : 0U);
    if (!volts) continue;
    EXPECT_EQ(two.inputs[0].remarks[0].code, RemarkCode::flat_activations);
  }
}

TEST(RequirePlausible, ActivationsThatAreAlikeMayBeComputedAndAreWarnedOf) {
  TwoTrials two;
  two.study.emg.kind = EmgKind::activation;
  two.inputs[1].emg = two.inputs[0].emg;
  require_plausible(two.study, two.model, two.inputs);
  EXPECT_EQ(two.inputs[1].remarks.size(), 1U);
}

TEST(RequirePlausible, AWarningGoesToItsTrial) {
  TwoTrials two;
  two.study.trials[1].held_mass_kg = 60.0;
  require_plausible(two.study, two.model, two.inputs);
  EXPECT_TRUE(two.inputs[0].remarks.empty());
  ASSERT_EQ(two.inputs[1].remarks.size(), 1U);
  EXPECT_EQ(two.inputs[1].remarks[0].severity, Severity::warning);
}

TEST(RequirePlausible, RefusesEmgThatLastsTwiceAsLongAsTheMotion) {
  TwoTrials two;
  for (TrialInput& input : two.inputs) {
    const TimeSeries m = *input.motion;
    const TimeSeries e = *input.emg;
    input.emg = TimeSeries(10.0 * e.time_s(), e.channels(), e.values());
    input.motion = TimeSeries(10.0 * m.time_s().head(101), m.channels(), m.values().topRows(101));
  }
  for (TrialSpec& trial : two.study.trials) {
    trial.motion = "m.mot";
    trial.emg = "e.sto";
  }
  EXPECT_THROW(require_plausible(two.study, two.model, two.inputs), InvalidInput);
}

/// A person of 70 kg with one limb that hangs from 0.3 m above its origin and is 0.9 m long; it
/// stands on the ground by a vertical slider.
body::BodyModel stander() {
  body::BodyModel model;
  model.bodies = {{.name = "ground"},
                  {.name = "pelvis", .mass_kg = 60.0},
                  {.name = "shank", .mass_kg = 9.0},
                  {.name = "foot", .mass_kg = 1.0}};
  body::Joint knee{.name = "knee", .class_name = "PinJoint", .parent = 1, .child = 2};
  knee.X_PF.p = Vec3(0.0, 0.3, 0.0);
  knee.coordinates = {1};
  knee.rotation[0] = {Vec3::UnitZ(), 1, body::Linear{1.0, 0.0}};
  knee.rotation[1].axis = Vec3::UnitX();
  knee.rotation[2].axis = Vec3::UnitY();
  body::Joint ankle{.name = "ankle", .class_name = "WeldJoint", .parent = 2, .child = 3};
  ankle.X_PF.p = Vec3(0.0, -0.9, 0.0);
  model.joints = {test::vertical_slider(), knee, ankle};
  model.coordinates = {{.name = "height", .joint = 0, .motion = body::MotionType::translational},
                       {.name = "knee_angle", .joint = 1}};
  return body::finalize(std::move(model));
}

TEST(StudyPlausibility, AStandingPersonWithoutAnyMeasuredForceIsSaid) {
  Study study;
  study.model.file = "person.osim";
  study.model.coordinate = "knee_angle";
  const body::BodyModel model = stander();
  const auto said = [&](const TrialInput& input, Use use, double knee_rad) {
    TrialSpec trial;
    trial.name = "squat";
    trial.use = use;
    if (input.external_torque) trial.external_torque = "push.sto";
    TrialInput with = input;
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
    with.motion = TimeSeries(t, {{"knee_angle", Unit::radian}}, Eigen::MatrixXd::Constant(100, 1, knee_rad));
    StudyPlausibility plausibility(study, model);
    plausibility.look_at(trial, with);
    const auto found = plausibility.findings();
    return std::any_of(found.begin(), found.end(), [](const Remark& f) {
      return f.says.find("external_loads or force_plates") != std::string::npos;
    });
  };
  EXPECT_TRUE(said({}, Use::calibration, 0.0));
  EXPECT_FALSE(said({}, Use::static_pose, 0.0));
  // With the limb up it stands on nothing that the knee moves.
  EXPECT_FALSE(said({}, Use::calibration, 3.0));
  TrialInput measured;
  measured.loads.emplace();
  EXPECT_FALSE(said(measured, Use::calibration, 0.0));
  TrialInput held;
  held.external_torque = TimeSeries(Eigen::VectorXd::LinSpaced(100, 0.0, 1.0),
                                    {{"knee_angle_moment", Unit::newton_meter}}, Eigen::MatrixXd::Ones(100, 1));
  EXPECT_FALSE(said(held, Use::calibration, 0.0));
}

TEST(StudyPlausibility, ForcesOfTheWrongSignAreAnErrorAndOfAnotherUnitAWarning) {
  Study study;
  study.model.file = "person.osim";
  study.model.coordinate = "knee_angle";
  const body::BodyModel model = stander();
  const auto found = [&](double force_n) {
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
    TrialInput input;
    input.motion = TimeSeries(t, {{"knee_angle", Unit::radian}}, Eigen::MatrixXd::Zero(100, 1));
    input.loads.emplace().forces.push_back({.name = "plate",
                                            .body = 3,
                                            .force = body::LoadColumns{.constant = Vec3(0.0, force_n, 0.0)},
                                            .point = body::LoadColumns{},
                                            .torque = {}});
    TrialSpec trial;
    trial.name = "squat";
    trial.external_loads = "folder/grf.xml";
    StudyPlausibility plausibility(study, model);
    plausibility.look_at(trial, input);
    std::vector<Remark> all = plausibility.findings();
    std::erase_if(all, [](const Remark& r) { return r.code == RemarkCode::coordinate_absent; });
    return all;
  };
  EXPECT_TRUE(found(680.0).empty());
  ASSERT_EQ(found(-680.0).size(), 1U);
  EXPECT_EQ(found(-680.0)[0].severity, Severity::error);
  EXPECT_EQ(found(-680.0)[0].code, RemarkCode::body_unsupported);
  EXPECT_EQ(found(-680.0)[0].says.find("grf.xml: "), 0U) << found(-680.0)[0].says;
  ASSERT_EQ(found(69.0).size(), 1U);
  EXPECT_EQ(found(69.0)[0].severity, Severity::warning);
}

TEST(StudyPlausibility, AWrongRateIsToldInPlaceOfForcesThatActElsewhereByIt) {
  Study study;
  study.model.file = "person.osim";
  study.model.coordinate = "knee_angle";
  body::BodyModel model = stander();
  for (body::Coordinate& c : model.coordinates) c.locked = c.name != "knee_angle";
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
  const auto always = [&](const Vec3& value) {
    return body::LoadColumns::interpolate(math::SplineKnots(t, 1), value.transpose().replicate(100, 1));
  };
  TrialInput input;
  input.motion = TimeSeries(t, {{"knee_angle", Unit::radian}}, Eigen::MatrixXd::Zero(100, 1));
  input.loads.emplace().forces.push_back({.name = "plate",
                                          .body = 3,
                                          .force = always(Vec3(0.0, 680.0, 0.0)),
                                          .point = always(Vec3(5.0, 0.0, 0.0)),
                                          .torque = {}});
  TrialSpec trial;
  trial.name = "squat";
  trial.external_loads = "grf.xml";
  for (const RemarkCode code : {RemarkCode::load_misplaced, RemarkCode::emg_length}) {
    StudyPlausibility plausibility(study, model);
    plausibility.look_at(trial, input);
    const std::vector<Remark> found = plausibility.findings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, code) << found[0].says;
    // Before the trial was cut to its loads, its EMG lasted half as long as the motion.
    input.lengths = {
        {.trial = "squat", .emg_s = 2.39, .motion_s = 4.74, .motion_rate_hz = 50.0, .emg_rate_hz = 2000.0}};
  }
}

}  // namespace
}  // namespace myoid::study
