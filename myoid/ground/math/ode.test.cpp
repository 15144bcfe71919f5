#include "myoid/ground/math/ode.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

TEST(OdeOptions, UnusableOnesAreRefused) {
  EXPECT_NO_THROW(validate({}, 3));
  EXPECT_THROW(validate({.relative_tolerance = 0.0}, 3), InvalidInput);
  EXPECT_THROW(validate({.absolute_tolerance = -1.0}, 3), InvalidInput);
  EXPECT_THROW(validate({.absolute_tolerances = {1.0, 1.0}}, 3), InvalidInput);
  EXPECT_THROW(validate({.max_step_s = 0.0}, 3), InvalidInput);
  EXPECT_THROW(validate({.first_step_s = -1.0}, 3), InvalidInput);
}

TEST(OdeStatus, EveryOneIsExplained) {
  for (int k = 0; k <= static_cast<int>(OdeStatus::solver_failed); ++k)
    EXPECT_FALSE(explain(static_cast<OdeStatus>(k)).empty());
}

}  // namespace
}  // namespace myoid::inline ground::math
