#include "myoid/program/steps/check_options.h"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/program/steps/id.h"
#include "myoid/program/steps/ik.h"
#include "myoid/program/steps/stage_options.h"

#include "tests/support/message_of.h"

namespace myoid::program {
namespace {

using testing::HasSubstr;

TEST(CheckOptions, RefusesAWordAndATooShortList) {
  IkOptions ik;
  ik.up = "upwards";
  EXPECT_THAT(test::message_of([&] { check_options(ik); }), HasSubstr("--up: found \"upwards\""));
  IdOptions id;
  id.held.at_m = {0.0, 0.1};
  EXPECT_THAT(test::message_of([&] { check_options(id); }), HasSubstr("--held-at: found 2"));
  id = {};
  id.cutoff_hz = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(test::message_of([&] { check_options(id); }), HasSubstr("--lowpass: "));
}

}  // namespace
}  // namespace myoid::program
