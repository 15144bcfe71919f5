#include "myoid/run/study_fit.h"

#include <gtest/gtest.h>

namespace myoid::run {
namespace {

TEST(TorqueOf, IsTheResultOfThatMethodAmongTheOthers) {
  StudyFit fit;
  EXPECT_EQ(torque_of(fit), nullptr);
  fit.methods.resize(2);
  fit.methods[0].method = fit::Method::paper;
  fit.methods[1].method = fit::Method::torque;
  EXPECT_EQ(torque_of(fit), &fit.methods[1]);
}

}  // namespace
}  // namespace myoid::run
