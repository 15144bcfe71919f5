#include "myoid/body/simulation/muscle_force_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

struct BuiltInArm {
  body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  body::MuscleKinematics muscles;
  BuiltInArm() {
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(21, 0.0, 0.5);
    const auto n = static_cast<Eigen::Index>(model.coordinates.size());
    std::vector<Channel> channels;
    Eigen::MatrixXd q(t.size(), n);
    for (Eigen::Index c = 0; c < n; ++c) {
      channels.push_back({model.coordinates[static_cast<std::size_t>(c)].name, Unit::radian});
      q.col(c) = 0.9 + 0.5 * (3.0 * t.array()).sin();
    }
    muscles = body::muscle_kinematics(model, body::joint_motion(model, {t, channels, q}).motion);
  }
};

TEST(MuscleForceLaw, TheSlopeIsTheDerivativeOfTheForce) {
  const BuiltInArm arm;
  for (const bool elastic : {false, true}) {
    for (const bool passive : {false, true}) {
      const auto law = muscle_force_law(arm.model, arm.muscles, {elastic, passive});
      for (Eigen::Index m = 0; m < arm.muscles.length.channel_count(); ++m) {
        for (const double a : {0.1, 0.4, 0.9}) {
          const double h = 1e-5;
          const double quotient = (law(7, m, a + h).force_n - law(7, m, a - h).force_n) / (2.0 * h);
          const double f_max = arm.model.muscles[static_cast<std::size_t>(m)].properties.max_isometric_force_n;
          // h^2 times a third derivative of a few F_max.
          EXPECT_NEAR(law(7, m, a).slope_n, quotient, 1e-7 * f_max) << m << " " << a;
        }
      }
    }
  }
}

// Independent of any equilibrium solver: with Thelen's tendon, the force gives the tendon's length
// and this the fiber's; the fiber's active force must equal the pull.
TEST(MuscleForceLaw, FiberAndElasticTendonPullAlike) {
  const BuiltInArm arm;
  const auto law = muscle_force_law(arm.model, arm.muscles, {.elastic_tendon = true});
  for (Eigen::Index m = 0; m < arm.muscles.length.channel_count(); ++m) {
    const body::MuscleProperties& p = arm.model.muscles[static_cast<std::size_t>(m)].properties;
    ASSERT_TRUE(arm.model.muscles[static_cast<std::size_t>(m)].class_name.starts_with("Thelen"));
    const double a = 0.6, speed = arm.muscles.velocity.values()(5, m);
    const double force = law(5, m, a).force_n / p.max_isometric_force_n;
    const double e0 = p.max_tendon_strain;
    const double toe = 99.0 * e0 * std::exp(3.0) / (166.0 * std::exp(3.0) - 67.0);
    const double stiff = 0.67 / (e0 - toe);
    const double strain =
        force > 0.33 ? toe + (force - 0.33) / stiff : toe / 3.0 * std::log1p(force / 0.33 * std::expm1(3.0));
    const double along = arm.muscles.length.values()(5, m) - p.tendon_slack_length_m * (1.0 + strain);
    const double height = p.optimal_fiber_length_m * std::sin(p.pennation_at_optimal_rad);
    const double fiber = std::hypot(along, height), cosine = along / fiber;
    const double l = fiber / p.optimal_fiber_length_m - 1.0;
    // Thelen's greatest velocity grows with the activation.
    const double v = speed * cosine / (p.optimal_fiber_length_m * p.max_contraction_velocity) / (0.25 + 0.75 * a);
    const double k = p.concentric_shape;
    const double top = p.eccentric_plateau;
    // Thelen's hyperbola.
    const double fv = v <= 0.0
                          ? (1.0 + v) / (1.0 - v / k)
                          : (1.0 + v * top * (2.0 + 2.0 / k) / (top - 1.0)) / (1.0 + v * (2.0 + 2.0 / k) / (top - 1.0));
    const double pull = a * std::exp(-l * l / p.active_shape) * fv * cosine;
    EXPECT_NEAR(pull, force, 1e-9) << m;
  }
}

TEST(MuscleForceLaw, AStiffTendonIsARigidOne) {
  BuiltInArm arm;
  for (body::Muscle& muscle : arm.model.muscles) muscle.properties.max_tendon_strain = 1e-6;
  const auto elastic = muscle_force_law(arm.model, arm.muscles, {.elastic_tendon = true});
  const auto rigid = muscle_force_law(arm.model, arm.muscles, {});
  for (Eigen::Index m = 0; m < arm.muscles.length.channel_count(); ++m) {
    const double expected = rigid(3, m, 0.5).force_n;
    // A strain of 1e-6 of the tendon moves the fiber by a few 1e-6 of its length.
    EXPECT_NEAR(elastic(3, m, 0.5).force_n, expected, 2e-5 * expected + 1e-3);
  }
}

TEST(MuscleForceLaw, ThePassiveForceIsThereWithoutActivation) {
  const BuiltInArm arm;
  const auto active = muscle_force_law(arm.model, arm.muscles, {});
  const auto both = muscle_force_law(arm.model, arm.muscles, {.passive_force = true});
  for (Eigen::Index m = 0; m < arm.muscles.length.channel_count(); ++m) {
    EXPECT_EQ(active(3, m, 0.0).force_n, 0.0);
    EXPECT_GE(both(3, m, 0.5).force_n, 0.0);
  }
}

}  // namespace
}  // namespace myoid::body
