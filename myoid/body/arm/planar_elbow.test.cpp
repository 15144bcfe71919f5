#include "myoid/body/arm/planar_elbow.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// Moment arms of Pigeon, Yahia & Feldman (1996) [m], x = elbow flexion [rad].
double pigeon_m(const std::array<double, 6>& c, double x) {
  double cm = 0.0;
  for (std::size_t k = 6; k-- > 0;) cm = cm * x + c[k];
  return 0.01 * cm;
}

TEST(PlanarElbow, MomentArmsAreThosePublishedWithinTheErrorOfTheFit) {
  const std::array<std::array<double, 6>, 4> published = {{{1.963, -1.44, 3.031, 0.887, -1.418, 0.285},
                                                           {1.554, 0.0813, -1.689, 3.523, -1.811, 0.276},
                                                           {2.015, -0.458, 3.058, -1.081, 0.159, -0.0187},
                                                           {-2.365, -1.015, 1.92, -1.035, 0.257, -0.0262}}};
  const PlanarElbow elbow = planar_elbow();
  for (std::size_t i = 0; i < 4; ++i) {
    double sum_m2 = 0.0;
    int count = 0;
    for (double q_deg = 10.0; q_deg <= 130.0; q_deg += 5.0, ++count) {
      const double error_m =
          travel(elbow.muscles[i], q_deg * kDegree).moment_arm_m - pigeon_m(published[i], q_deg * kDegree);
      sum_m2 += error_m * error_m;
    }
    // The fits' own rms: 2.2, 2.6, 3.3 and 3.2 mm; their constants are rounded to a millimeter.
    EXPECT_LT(std::sqrt(sum_m2 / count), 0.0036) << elbow.muscles[i].name;
  }
}

TEST(PlanarElbow, MomentArmIsMinusTheSlopeOfTheLength) {
  // Central differences, h = 1e-5: truncation h^2/6 |l'''| < 1e-11, round-off 1e-16/h = 1e-11.
  const double h = 1e-5;
  for (const PlanarMuscle& muscle : planar_elbow().muscles) {
    for (double q = 0.05; q < 2.6; q += 0.13) {
      const MuscleTravel before = travel(muscle, q - h);
      const MuscleTravel after = travel(muscle, q + h);
      const MuscleTravel here = travel(muscle, q);
      EXPECT_NEAR((before.length_m - after.length_m) / (2 * h), here.moment_arm_m, 1e-10);
      EXPECT_NEAR((after.moment_arm_m - before.moment_arm_m) / (2 * h), here.moment_arm_slope_mprad, 1e-10);
    }
  }
}

TEST(PlanarElbow, LengthIsTheDistanceBetweenTheAttachments) {
  const PlanarMuscle biceps = planar_elbow().muscles[0];
  // At psi = 90 degrees: Pythagoras.
  EXPECT_NEAR(travel(biceps, 75.0 * kDegree).length_m, 0.22 + std::hypot(0.080, 0.048), 1e-15);
}

TEST(PlanarElbow, InertiaIsThatOfTheLiterature) {
  // A man of 73 kg: 0.076 kg m2 and 2.90 N m, both published to two or three digits; the rounding
  // of the fractions and which radius of gyration is the flexion axis's make 1 %.
  const PlanarElbow elbow = planar_elbow({.mass_kg = 73.0});
  EXPECT_NEAR(elbow.inertia_kgm2, 0.076, 0.001);
  EXPECT_NEAR(elbow.static_moment_kgm * kStandardGravity, 2.90, 0.02);
}

TEST(PlanarElbow, ForearmAndHandTogetherAreThePointMassesOfBoth) {
  // Independent of the parallel-axis algebra in the code: each segment as point masses at its center
  // +- its radius of gyration on the long axis.
  const double f_kg = 0.0162 * 73.0;
  const double h_kg = 0.0061 * 73.0;
  double about_elbow = 0.0;
  for (const double side : {-1.0, 1.0}) {
    about_elbow += 0.5 * f_kg * std::pow(0.2689 * (0.4574 + side * 0.265), 2);
    about_elbow += 0.5 * h_kg * std::pow(0.2689 + 0.0862 * (0.79 + side * 0.513), 2);
  }
  EXPECT_NEAR(planar_elbow().inertia_kgm2, about_elbow, 1e-15);
}

TEST(PlanarElbow, RequiredTorqueIsThatOfAPendulum) {
  const PlanarElbow elbow = planar_elbow();
  // At rest and horizontal: all the weight; with the axis vertical: none.
  EXPECT_DOUBLE_EQ(required_torque_nm(elbow, 0.5 * kPi, 0.0, 10.0, 2.0),
                   10.0 * (elbow.static_moment_kgm + 2.0 * elbow.held_at_m));
  EXPECT_EQ(required_torque_nm(elbow, 0.5 * kPi, 0.0, 0.0, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(required_torque_nm(elbow, 0.3, 4.0, 0.0), 4.0 * elbow.inertia_kgm2);
}

TEST(PlanarElbow, RefusesAnArmThatCannotBe) {
  EXPECT_THROW(static_cast<void>(planar_elbow({.mass_kg = 0.0})), InvalidInput);
  EXPECT_THROW(static_cast<void>(planar_elbow({.forearm_length_m = -1.0})), InvalidInput);
}

}  // namespace
}  // namespace myoid::body
