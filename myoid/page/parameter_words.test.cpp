#include "myoid/page/parameter_words.h"

#include <gtest/gtest.h>

namespace myoid::page {
namespace {

TEST(ParameterWords, ExplainANumberByItsNameWithoutEnding) {
  EXPECT_NE(parameter_meaning("length_activation"), "");
  EXPECT_EQ(parameter_meaning("voluntary_torque_positive"), parameter_meaning("voluntary_torque"));
  EXPECT_NE(parameter_meaning("voluntary_torque_angle"), parameter_meaning("voluntary_torque"));
  EXPECT_EQ(parameter_meaning("passive"), "");
  EXPECT_EQ(parameter_meaning("emg_delays"), "");
}

}  // namespace
}  // namespace myoid::page
