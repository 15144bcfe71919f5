#include "myoid/pipeline/study_plausibility.h"

#include <random>

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"
#include "myoid/model/arm4.h"
#include "myoid/model/osim_reader.h"

namespace myoid::pipeline {
namespace {

TimeSeries emg(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  Eigen::MatrixXd values(2000, 1);
  for (double& v : values.reshaped()) v = 1e-9 * static_cast<double>(engine() % 100000);
  return {Eigen::VectorXd::LinSpaced(2000, 0.0, 1.999), {{"BIC", Unit::volt}}, values};
}

TimeSeries motion(double to_deg) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(200, 0.0, 1.99);
  return {time,
          {{"elbow_flexion", Unit::radian}},
          Eigen::MatrixXd(kDegree * to_deg * (2.0 * time.array()).sin().abs())};
}

struct TwoTrials {
  Study study;
  model::BodyModel model = model::parse_osim(model::arm4_osim(), "arm4.osim");
  std::vector<TrialInput> inputs = std::vector<TrialInput>(2);

  TwoTrials() {
    study.model.builtin = "arm4";
    study.trials.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
      study.trials[i].name = i == 0 ? "first" : "second";
      inputs[i].motion = motion(70.0 + 10.0 * static_cast<double>(i));
      inputs[i].emg = emg(1 + i);
    }
  }
};

TEST(RequirePlausible, LetsGoodTrialsPassUntouched) {
  TwoTrials two;
  require_plausible(two.study, two.model, two.inputs);
  EXPECT_TRUE(two.inputs[0].warnings.empty());
  EXPECT_TRUE(two.inputs[1].warnings.empty());
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

TEST(StudyPlausibility, WhatSeveralTrialsHaveAlikeIsSaidOnce) {
  TwoTrials two;
  StudyPlausibility plausibility(two.study, two.model);
  for (std::size_t i = 0; i < 2; ++i) {
    two.study.trials[i].held_mass_kg = 60.0;
    plausibility.look_at(two.study.trials[i], two.inputs[i]);
  }
  const std::vector<Finding> found = plausibility.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].where, "first");
  EXPECT_NE(found[0].message.find("(likewise in second)"), std::string::npos) << found[0].message;
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
    ASSERT_EQ(two.inputs[0].warnings.size(), volts ? 1U : 0U);
    if (!volts) continue;
    EXPECT_NE(two.inputs[0].warnings[0].find("is this EMG in volts?"), std::string::npos)
        << two.inputs[0].warnings[0];
  }
}

TEST(RequirePlausible, ActivationsThatAreAlikeMayBeComputedAndAreWarnedOf) {
  TwoTrials two;
  two.study.emg.kind = EmgKind::activation;
  two.inputs[1].emg = two.inputs[0].emg;
  require_plausible(two.study, two.model, two.inputs);
  EXPECT_EQ(two.inputs[1].warnings.size(), 1U);
}

TEST(RequirePlausible, AWarningGoesToItsTrial) {
  TwoTrials two;
  two.study.trials[1].held_mass_kg = 60.0;
  require_plausible(two.study, two.model, two.inputs);
  EXPECT_TRUE(two.inputs[0].warnings.empty());
  ASSERT_EQ(two.inputs[1].warnings.size(), 1U);
  EXPECT_EQ(two.inputs[1].notes, two.inputs[1].warnings);
}

}  // namespace
}  // namespace myoid::pipeline
