#include "myoid/muscle/literature.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

TEST(Literature, LumpedMusclesAreTheSumsOfTheirHeads) {
  // The heads as published: F_max [N], l0 [m], l_ts [m].
  const double biceps_n = 624.30 + 435.56;
  EXPECT_NEAR(literature_muscle("BIC").max_isometric_force_n, biceps_n, 0.005);
  EXPECT_NEAR(literature_muscle("BIC").optimal_fiber_length_m, (624.30 * 0.1157 + 435.56 * 0.1321) / biceps_n, 5e-5);
  EXPECT_NEAR(literature_muscle("BIC").tendon_slack_length_m, (624.30 * 0.2723 + 435.56 * 0.1923) / biceps_n, 5e-5);
  const double triceps_n = 798.52 + 624.30 + 624.30;
  EXPECT_NEAR(literature_muscle("TRI").max_isometric_force_n, triceps_n, 0.005);
  EXPECT_NEAR(literature_muscle("TRI").optimal_fiber_length_m, (798.52 * 0.1340 + 2 * 624.30 * 0.1138) / triceps_n,
              5e-5);
  EXPECT_NEAR(literature_muscle("TRI").tendon_slack_length_m,
              (798.52 * 0.1430 + 624.30 * (0.0980 + 0.0908)) / triceps_n, 5e-5);
}

TEST(Literature, ParametersLieWithinThePhysicalBounds) {
  for (const LiteratureMuscle& muscle : kElbowMuscles) {
    const HillParameters<double> p = literature_parameters(muscle);
    EXPECT_NO_THROW(validate(p));
    for (const HillField& field : kHillFields) {
      EXPECT_GE(p.*(field.member), field.bounds.lower) << muscle.name << ' ' << field.name;
      EXPECT_LE(p.*(field.member), field.bounds.upper) << muscle.name << ' ' << field.name;
    }
    EXPECT_DOUBLE_EQ(slope_ratio(p.velocity_law()), 1.5);
  }
}

TEST(Literature, AnUnknownMuscleIsRefusedWithTheKnownOnes) {
  EXPECT_THROW(static_cast<void>(literature_muscle("XYZ")), InvalidInput);
}

}  // namespace
}  // namespace myoid::muscle
