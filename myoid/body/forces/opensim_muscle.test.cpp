#include "myoid/body/forces/opensim_muscle.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::body {
namespace {

body::Muscle thelen(double pennation_rad) {
  body::Muscle m;
  m.name = "m";
  m.class_name = "Thelen2003Muscle";
  m.properties.pennation_at_optimal_rad = pennation_rad;
  return m;
}

body::Muscle millard() {
  body::Muscle m = thelen(0.2);
  m.class_name = "Millard2012EquilibriumMuscle";
  m.properties.curves = body::MillardCurves{};
  return m;
}

TEST(OpensimMuscle, IsAsStrongAsItsIsometricForceAtTheOptimum) {
  const OpensimMuscle muscle(thelen(0.0), {});
  EXPECT_NEAR(muscle.optimal_force(0.2 + 0.1, 0.0), 1000.0, 1e-9);
  EXPECT_EQ(muscle.optimal_force(0.2 + 0.1, -100.0), 0.0);  // faster than v_max: it does not push
}

TEST(OpensimMuscle, MillardsPennationOfStaticOptimizationIsOpenSimsOnlyWhenAsked) {
  // OpenSim puts the normalized fiber length where a length in meters belongs, so that
  // sin(alpha) = l0 sin(alpha0) / (l / l0).
  const OpensimMuscle exact(millard(), {});
  const OpensimMuscle compat(millard(), body::kOpenSim452);
  const double length = 0.2 + 0.1 * std::cos(0.2);
  EXPECT_NEAR(exact.optimal_force(length, 0.0), 1000.0 * std::cos(0.2), 1e-6);
  EXPECT_NEAR(compat.optimal_force(length, 0.0), 1000.0 * std::cos(std::asin(0.1 * std::sin(0.2))), 1e-6);
}

TEST(OpensimMuscle, EquilibriumBalancesTendonAndFiber) {
  for (const body::Muscle& m : {thelen(0.3), millard()}) {
    const OpensimMuscle muscle(m, {});
    for (const double length : {0.28, 0.30, 0.33}) {
      for (const double speed : {-0.2, 0.0, 0.3}) {
        const OpensimMuscle::State s = muscle.equilibrium(0.4, length, speed);
        ASSERT_TRUE(s.converged) << m.class_name << " " << length << " " << speed;
        // The search stops at 1e-8 F_max.
        EXPECT_NEAR(s.fiber_force_n * std::cos(s.pennation_rad), s.tendon_force_n, 2e-5);
        EXPECT_NEAR(s.tendon_length_m + s.fiber_length_m * std::cos(s.pennation_rad), length, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace myoid::body
