#include "myoid/program/commands/run.h"

#include <gtest/gtest.h>

namespace myoid::program {
namespace {

TEST(RunFunction, SaysThatASeedHasNoEffectUnlessSolversAreCompared) {
  study::Study study;
  study.identify.methods = {fit::Method::torque};
  Call call;
  EXPECT_EQ(seed_without_effect(study, call), "");
  call.seed = 7;
  EXPECT_NE(seed_without_effect(study, call), "");
  study.identify.compare_solvers = true;
  EXPECT_NE(seed_without_effect(study, call), "") << "a contest belongs to method paper";
  study.identify.methods.push_back(fit::Method::paper);
  EXPECT_EQ(seed_without_effect(study, call), "");
}

}  // namespace
}  // namespace myoid::program
