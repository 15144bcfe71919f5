#include "myoid/program/steps/check_options.h"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/program/steps/id.h"
#include "myoid/program/steps/ik.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {
namespace {

using testing::HasSubstr;

/// Returns the sentence that refuses the options; empty: they are allowed.
template <typename Options>
std::string refusal_of(const Options& options) {
  try {
    check_options(options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(CheckOptions, RefusesAWordAndATooShortList) {
  IkOptions ik;
  ik.up = "upwards";
  EXPECT_THAT(refusal_of(ik), HasSubstr("--up: found \"upwards\""));
  IdOptions id;
  id.held.at_m = {0.0, 0.1};
  EXPECT_THAT(refusal_of(id), HasSubstr("--held-at: found 2"));
  id = {};
  id.cutoff_hz = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal_of(id), HasSubstr("--lowpass: "));
}

}  // namespace
}  // namespace myoid::program
