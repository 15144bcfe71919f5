#include "myoid/muscle/hill_muscle.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

constexpr HillParameters<double> kTriceps{.max_isometric_force_n = 2047.1,
                                          .optimal_fiber_length_m = 0.1217,
                                          .force_length_width_m = 0.055,
                                          .concentric_curvature = 0.3,
                                          .eccentric_curvature_product = 0.12,
                                          .eccentric_plateau = 1.3,
                                          .max_shortening_speed_mps = 0.8,
                                          .tendon_slack_length_m = 0.113};

TEST(ForceLength, IsOneAtTheOptimumAndHalfAtHalfTheFullWidth) {
  EXPECT_EQ(force_length(0.12, 0.12, 0.05), 1.0);
  EXPECT_NEAR(force_length(0.12 + 0.05 * std::sqrt(std::log(2.0)), 0.12, 0.05), 0.5, 1e-15);
}

TEST(ForceLength, DoesNotDependOnTheUnitOfLength) {
  EXPECT_EQ(force_length(0.13 * 1024.0, 0.12 * 1024.0, 0.05 * 1024.0), force_length(0.13, 0.12, 0.05));
}

TEST(HillMuscle, IsThePapersEquationWorkedOutByHand) {
  // At l0 + l_sh: exp(-1); at -0.1 v_max: 0.3 * 0.9 / 0.4; at 0.1 v_max: 0.25 / 0.22.
  const double l = 0.1217 + 0.055;
  EXPECT_NEAR(hill_force(0.4, l, -0.08, kTriceps), 0.4 * std::exp(-1.0) * 0.675 * 2047.1, 1e-10);
  EXPECT_NEAR(hill_force(0.4, l, 0.08, kTriceps), 0.4 * std::exp(-1.0) * (0.25 / 0.22) * 2047.1, 1e-10);
  EXPECT_EQ(hill_force(0.4, l, -0.8, kTriceps), 0.0);
}

TEST(HillMuscle, DoesNotDependOnTheUnitOfLength) {
  auto stretched = kTriceps;
  for (double* length :
       {&stretched.optimal_fiber_length_m, &stretched.force_length_width_m, &stretched.max_shortening_speed_mps})
    *length *= 1024.0;
  for (const double v : {-0.7, -0.1, 0.1, 2.0}) {
    EXPECT_EQ(hill_force(0.4, 1024.0 * 0.13, 1024.0 * v, stretched), hill_force(0.4, 0.13, v, kTriceps));
  }
}

TEST(HillMuscle, IsProportionalToActivationAndMaximalForce) {
  auto doubled = kTriceps;
  doubled.max_isometric_force_n *= 2.0;
  EXPECT_EQ(hill_force(0.25, 0.13, 0.1, doubled), hill_force(0.5, 0.13, 0.1, kTriceps));
}

TEST(Validate, NamesTheFieldThatIsWrong) {
  auto wrong = kTriceps;
  wrong.force_length_width_m = -0.01;
  try {
    validate(wrong);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("force_length_width"), std::string::npos);
  }
  EXPECT_NO_THROW(validate(kTriceps));
}

}  // namespace
}  // namespace myoid::muscle
