#include "myoid/body/osim/muscle_laws.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/muscle/force_length.h"
#include "myoid/muscle/force_velocity.h"

namespace myoid::body {
namespace {

TEST(MuscleLaws, AThelenMuscleKeepsItsForceLengthCurve) {
  MuscleProperties p;
  p.active_shape = 0.45;
  const muscle::HillParameters<double> hill = hill_parameters(p);
  const double l_m = 1.2 * p.optimal_fiber_length_m;
  EXPECT_NEAR(muscle::force_length(l_m, hill.optimal_fiber_length_m, hill.force_length_width_m),
              std::exp(-0.2 * 0.2 / 0.45), 1e-15);
  EXPECT_NEAR(hill.force_length_width_m / hill.optimal_fiber_length_m, 0.671, 5e-4);  // published
  EXPECT_DOUBLE_EQ(muscle::slope_ratio(hill_parameters(p, 2.0).velocity_law()), 2.0);
}

TEST(MuscleLaws, AreThoseOfTheClass) {
  MuscleProperties p;
  const auto mode = muscle::TendonMode::equilibrium;
  EXPECT_EQ(class_laws(p, mode).velocity, muscle::VelocityLaw::thelen);
  p.curves = MillardCurves{.ignore_tendon_compliance = true};
  EXPECT_EQ(class_laws(p, mode).velocity, muscle::VelocityLaw::millard);
  EXPECT_TRUE(muscle_states(p).rigid_tendon);
  p.curves = DeGrooteCurves{.fiber_damping = 0.02, .ignore_passive_fiber_force = true};
  EXPECT_EQ(class_laws(p, mode).length, muscle::LengthLaw::de_groote);
  EXPECT_EQ(class_laws(p, mode).passive, muscle::PassiveLaw::none);
  EXPECT_EQ(musculotendon_parameters(p, class_laws(p, mode)).damping, 0.02);
  // Under other laws than its own a muscle has the published numbers of these laws.
  EXPECT_EQ(musculotendon_parameters(p, muscle::millard_laws()).damping, 0.1);
}

TEST(MuscleLaws, OpenNumbersOfMillardsCurvesAreTheClasss) {
  MuscleProperties p;
  MillardCurves c{.shape = {.passive = {.strain_at_zero = 0.1, .strain_at_one = 0.5}}};
  p.curves = c;
  // OpenSim: the stiffness at F_max is 2 over the strain from zero force to F_max.
  EXPECT_DOUBLE_EQ(millard_shape(p).passive.stiffness_at_one, 2.0 / 0.4);
  c.passive_stiffness_at_one = 7.0;
  p.curves = c;
  EXPECT_EQ(millard_shape(p).passive.stiffness_at_one, 7.0);
}

TEST(MuscleLaws, TheExponentialHasTheSlopeOfMillardsCurveAtMaximalForce) {
  MuscleProperties p;
  p.curves = MillardCurves{.shape = {.passive = {.strain_at_one = 0.7}}, .passive_stiffness_at_one = 4.0};
  const auto unit = musculotendon_parameters(p, class_laws(p, muscle::TendonMode::equilibrium));
  const double k = unit.passive_shape;
  EXPECT_NEAR(k / unit.passive_strain / -std::expm1(-k), 4.0, 1e-12);
}

}  // namespace
}  // namespace myoid::body
