#include "myoid/run/effort_prior.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::run {
namespace {

TEST(ExpectAnyEffort, WithTheCommonPartHasTheMomentsOfAUniformLogarithmOfTheShareTimesTheLiteratures) {
  fit::MuscleSetup muscle;
  muscle.priors["max_isometric_force"] = {.mean = 900.0, .sd = 0.25, .logarithmic = true};
  std::vector<fit::MuscleSetup> muscles{muscle, {}};
  expect_any_effort(muscles);
  // 200 000 draws: mean and spread to 0.003.
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(std::log(0.05), 0.0);
  std::normal_distribution<double> strength(std::log(900.0), 0.25);
  double sum = 0.0, squares = 0.0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = strength(engine) + uniform(engine);
    sum += x;
    squares += x * x;
  }
  const double mean = sum / kDraws;
  const Prior& prior = muscles[0].priors.at("max_isometric_force");
  EXPECT_NEAR(std::log(prior.mean), mean, 0.01);
  EXPECT_NEAR(std::hypot(prior.sd, any_effort().common_sd), std::sqrt(squares / kDraws - mean * mean), 0.01);
  EXPECT_TRUE(prior.logarithmic);
  EXPECT_TRUE(muscles[1].priors.empty());
}

TEST(MeaningOfStrength, FollowsTheRecordedEfforts) {
  using testing::HasSubstr;
  study::Study study;
  study.beliefs.effort = 0.04;
  EXPECT_THAT(meaning_of_strength(study, true), HasSubstr("by 4 %"));
  study.emg.mvc_effort = 0.9;
  study.emg.mvc_effort_sd = 0.05;
  EXPECT_THAT(meaning_of_strength(study, true), HasSubstr("90 +- 5 %"));
  EXPECT_EQ(unseen_effort(study), 0.0);
  study.emg.has_mvc = false;
  EXPECT_THAT(meaning_of_strength(study, false), HasSubstr("rests on the literature"));
  study.identify.gain = false;  // the share is held at 1
  EXPECT_THAT(meaning_of_strength(study, false), HasSubstr("not the muscle's maximum"));
}

TEST(ExpectAnyEffort, SpreadInNewtonsIsTakenAsARatio) {
  fit::MuscleSetup in_newtons, in_logarithms;
  in_newtons.priors["max_isometric_force"] = {.mean = 900.0, .sd = 180.0};
  in_logarithms.priors["max_isometric_force"] = {.mean = 900.0, .sd = 0.2, .logarithmic = true};
  std::vector<fit::MuscleSetup> muscles{in_newtons, in_logarithms};
  expect_any_effort(muscles);
  EXPECT_NEAR(muscles[0].priors["max_isometric_force"].sd, muscles[1].priors["max_isometric_force"].sd, 1e-12);
}

}  // namespace
}  // namespace myoid::run
