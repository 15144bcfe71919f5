#include "myoid/muscle/hill_muscle.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/core/error.h"

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
  EXPECT_EQ(force_length(0.13 * 1024.0, 0.12 * 1024.0, 0.05 * 1024.0),
            force_length(0.13, 0.12, 0.05));
}

TEST(ForceVelocity, IsZeroAtMaximalShorteningAndOneAtRest) {
  EXPECT_EQ(force_velocity(-0.8, kTriceps.velocity_shape()), 0.0);
  EXPECT_EQ(force_velocity(-1.0, kTriceps.velocity_shape()), 0.0);
  EXPECT_EQ(force_velocity(0.0, kTriceps.velocity_shape()), 1.0);
}

TEST(ForceVelocity, HasTheValuesWorkedOutByHand) {
  // V_sh = 0.3: f_v(-0.1 vm) = 0.3*0.9/0.4, f_v(-0.3 vm) = 0.3*0.7/0.6;
  // P = 0.12, V_ml = 1.3: f_v(0.05 vm) = 0.185/0.17, f_v(0.1 vm) = 0.25/0.22, f_v(0.2 vm) =
  // 0.38/0.32.
  const auto shape = kTriceps.velocity_shape();
  const double vm = shape.max_shortening_speed_mps;
  EXPECT_NEAR(force_velocity(-0.1 * vm, shape), 0.675, 1e-14);
  EXPECT_NEAR(force_velocity(-0.3 * vm, shape), 0.35, 1e-14);
  EXPECT_NEAR(force_velocity(0.05 * vm, shape), 0.185 / 0.17, 1e-14);
  EXPECT_NEAR(force_velocity(0.1 * vm, shape), 0.25 / 0.22, 1e-14);
  EXPECT_NEAR(force_velocity(0.2 * vm, shape), 0.38 / 0.32, 1e-14);
}

TEST(ForceVelocity, TendsToThePlateauInFastLengthening) {
  EXPECT_NEAR(force_velocity(1e9, kTriceps.velocity_shape()), 1.3, 1e-9);
}

TEST(ForceVelocity, NeverDecreases) {
  double last = 0.0;
  for (double v = -0.9; v < 3.0; v += 0.01) {
    const double f = force_velocity(v, kTriceps.velocity_shape());
    EXPECT_GE(f, last);
    last = f;
  }
}

TEST(ForceVelocity, DoesNotDependOnTheUnitOfLength) {
  auto stretched = kTriceps.velocity_shape();
  stretched.max_shortening_speed_mps *= 1024.0;
  for (const double v : {-0.7, -0.1, 0.1, 2.0}) {
    EXPECT_EQ(force_velocity(1024.0 * v, stretched), force_velocity(v, kTriceps.velocity_shape()));
  }
}

TEST(ForceVelocity, TheSlopeRatioIsThatOfTheTwoOneSidedSlopes) {
  const auto shape = kTriceps.velocity_shape();
  const double h = 1e-7;
  const double right = (force_velocity(h, shape) - 1.0) / h;
  const double left = (1.0 - force_velocity(-h, shape)) / h;
  EXPECT_NEAR(slope_ratio(shape), right / left, 1e-5);  // one-sided: truncation of order h f''
  EXPECT_NEAR(slope_ratio(shape), 2.5 / (13.0 / 3.0), 1e-12);
  EXPECT_NEAR(curvature_product_from_slope_ratio(slope_ratio(shape), 0.3, 1.3), 0.12, 1e-14);
}

TEST(HillMuscle, AnalyticDerivativesAgreeWithJetsInEveryBranch) {
  using Jet = ceres::Jet<double, 7>;
  HillParameters<Jet> jets;
  jets.max_isometric_force_n = Jet(kTriceps.max_isometric_force_n, 0);
  jets.optimal_fiber_length_m = Jet(kTriceps.optimal_fiber_length_m, 1);
  jets.force_length_width_m = Jet(kTriceps.force_length_width_m, 2);
  jets.concentric_curvature = Jet(kTriceps.concentric_curvature, 3);
  jets.eccentric_curvature_product = Jet(kTriceps.eccentric_curvature_product, 4);
  jets.eccentric_plateau = Jet(kTriceps.eccentric_plateau, 5);
  jets.max_shortening_speed_mps = Jet(kTriceps.max_shortening_speed_mps, 6);
  for (const double v : {-1.0, -0.7, -0.2, -0.01, 0.01, 0.3, 2.0}) {
    for (const double l : {0.08, 0.12, 0.17}) {
      const Jet jet = hill_force(0.4, l, v, jets);
      const HillForce analytic = hill_force_derivatives(0.4, l, v, kTriceps);
      const double scale = 1e-12 * kTriceps.max_isometric_force_n / kTriceps.force_length_width_m;
      EXPECT_NEAR(analytic.force_n, jet.a, scale);
      EXPECT_NEAR(analytic.by_max_isometric_force, jet.v[0], scale);
      EXPECT_NEAR(analytic.by_optimal_fiber_length, jet.v[1], scale);
      EXPECT_NEAR(analytic.by_force_length_width, jet.v[2], scale);
      EXPECT_NEAR(analytic.by_concentric_curvature, jet.v[3], scale);
      EXPECT_NEAR(analytic.by_eccentric_curvature_product, jet.v[4], scale);
      EXPECT_NEAR(analytic.by_eccentric_plateau, jet.v[5], scale);
      EXPECT_NEAR(analytic.by_max_shortening_speed, jet.v[6], scale);
    }
  }
}

TEST(HillMuscle, DerivativesByTheStateAgreeWithCentralDifferences) {
  const double h = 6e-6;
  for (const double v : {-0.7, -0.05, 0.05, 2.0}) {
    const double l = 0.14;
    const HillForce d = hill_force_derivatives(0.4, l, v, kTriceps);
    const auto force = [](double a, double length, double speed) {
      return hill_force(a, length, speed, kTriceps);
    };
    // Truncation h^2 f'''/6 with f''' up to F_max / l_sh^3: some 1e-3 N/m.
    EXPECT_NEAR(d.by_fiber_length, (force(0.4, l + h, v) - force(0.4, l - h, v)) / (2 * h), 1e-2);
    EXPECT_NEAR(d.by_fiber_velocity, (force(0.4, l, v + h) - force(0.4, l, v - h)) / (2 * h), 1e-2);
    EXPECT_NEAR(d.by_activation, (force(0.4 + h, l, v) - force(0.4 - h, l, v)) / (2 * h), 1e-4);
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
