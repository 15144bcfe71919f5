#include "myoid/muscle/absent_parameters.h"

#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

TEST(AbsentParameters, AreThoseOfALiteratureMuscleAndGivenOnesStay) {
  const HillParameters<double> biceps = literature_parameters(literature_muscle("BIC"));
  HillParameters<double> start;
  start.max_isometric_force_n = biceps.max_isometric_force_n;
  start.optimal_fiber_length_m = biceps.optimal_fiber_length_m;
  start.tendon_slack_length_m = biceps.tendon_slack_length_m;
  complete_by_literature(start);
  for (const HillField& field : kHillFields) EXPECT_EQ(start.*field.member, biceps.*field.member) << field.name;
  HillParameters<double> given;
  given.optimal_fiber_length_m = 0.1;
  given.concentric_curvature = 0.5;
  complete_by_literature(given, 2.0);
  EXPECT_EQ(given.concentric_curvature, 0.5);
  EXPECT_EQ(given.tendon_slack_length_m, 0.0);
  EXPECT_NEAR(slope_ratio(given.velocity_law()), 2.0, 1e-12);
}

}  // namespace
}  // namespace myoid::muscle
