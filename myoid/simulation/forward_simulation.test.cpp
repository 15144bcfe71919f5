#include "myoid/simulation/forward_simulation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"

namespace myoid::simulation {
namespace {

using muscle::TendonMode;

constexpr TendonMode kModes[] = {TendonMode::rigid, TendonMode::equilibrium, TendonMode::mass};

/// Flexors and extensor in turn, once a second, over a little co-contraction.
ArmInput bursting(double seconds) {
  std::vector<Burst> flex;
  std::vector<Burst> extend;
  for (int k = 0; k < static_cast<int>(seconds); ++k) {
    flex.push_back({0.2 + k, 0.25, 0.3});
    extend.push_back({0.6 + k, 0.25, 0.2});
  }
  const Signal flexor = bursts(flex, 0.02);
  return {{flexor, flexor, flexor, bursts(extend, 0.02)}};
}

double last(const TimeSeries& series, const char* name) {
  return series.column(name)[series.sample_count() - 1];
}

TEST(ForwardSimulation, AnArmWithoutMusclesSwingsAsAPendulumDoes) {
  Arm<double> arm = make_arm({.held_mass_kg = 1.0});
  arm.muscles.clear();
  arm.joint = {};
  const double inertia = arm.inertia_kgm2 + arm.held_at_m * arm.held_at_m;
  const double moment = arm.static_moment_kgm + arm.held_at_m;
  // Period of a pendulum that swings out to q0: 2 pi sqrt(I / (m g c)) / agm(1, cos(q0 / 2)).
  const double q0 = 1.2;
  double a = 1.0;
  double g = std::cos(0.5 * q0);
  for (int k = 0; k < 8; ++k) {
    const double mean = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = mean;
  }
  const double period_s = 2.0 * kPi * std::sqrt(inertia / (moment * kStandardGravity)) / a;
  const Simulation s = simulate(arm, {}, {.angle_rad = q0},
                                {.end_s = 5.0 * period_s, .output_times_s = {5.0 * period_s}});
  ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
  // Where it turns, the angle is as good as the local error, 1e-8, added up over five periods of
  // about a hundred steps.
  EXPECT_NEAR(s.motion.values()(0, 0), q0, 1e-6);
}

TEST(ForwardSimulation, TheTorqueThatTheMotionRequiresIsThatOfTheMuscles) {
  const model::PlanarElbow elbow = model::planar_elbow();
  for (const TendonMode mode : kModes) {
    ArmSetup setup{.held_mass_kg = 1.5};
    setup.joint = {};
    const Arm<double> arm = with_tendon_mode(make_arm(setup), mode);
    const Simulation s = simulate(arm, bursting(2.0), {.angle_rad = 1.0}, {.end_s = 2.0});
    ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
    for (Eigen::Index k = 0; k < s.motion.sample_count(); ++k) {
      const double required = model::required_torque_nm(
          elbow, s.motion.values()(k, 0), s.motion.values()(k, 2), kStandardGravity, 1.5);
      // Algebra: round-off of torques up to 100 N m, a hundred operations.
      EXPECT_NEAR(required, s.torque.values()(k, 0), 1e-11);
    }
  }
}

// Every element by itself, and all together: what goes in comes out again.
TEST(ForwardSimulation, EnergyCloses) {
  for (const TendonMode mode : kModes) {
    const Arm<double> arm = with_tendon_mode(make_arm({.held_mass_kg = 0.5}), mode);
    SimulationOptions options{.end_s = 10.0, .output_rate_hz = 10.0, .energy = true};
    const Simulation s = simulate(arm, bursting(10.0), {.angle_rad = 1.0}, options);
    ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
    const auto gained = [&](const std::string& name) {
      const Eigen::VectorXd e = s.energy.column(name);
      return e[e.size() - 1] - e[0];
    };
    double muscles = 0.0;
    double turned_over = 0.0;
    for (const ArmMuscle<double>& m : arm.muscles) {
      const auto work = [&](const char* what) { return last(s.energy, (m.name + what).c_str()); };
      const double scale = std::abs(work("_active_work")) + std::abs(work("_viscous_work"));
      EXPECT_NEAR(work("_musculotendon_work"),
                  work("_active_work") + work("_viscous_work") -
                      gained(m.name + "_passive_energy") - gained(m.name + "_tendon_energy") -
                      gained(m.name + "_kinetic_energy"),
                  1e-6 * scale)
          << m.name;
      EXPECT_NEAR(work("_tendon_work"), -gained(m.name + "_tendon_energy"), 1e-6 * scale) << m.name;
      EXPECT_NEAR(work("_kinetic_work"), -gained(m.name + "_kinetic_energy"), 1e-6 * scale)
          << m.name;
      muscles += work("_musculotendon_work");
      turned_over += scale;
    }
    EXPECT_GT(turned_over, 10.0);  // that something happened
    EXPECT_NEAR(last(s.energy, "gravity_work"), -gained("gravity_energy"), 1e-6 * turned_over);
    EXPECT_NEAR(last(s.energy, "joint_elastic_work"), -gained("joint_elastic_energy"),
                1e-6 * turned_over);
    EXPECT_NEAR(gained("forearm_kinetic_energy"),
                muscles + last(s.energy, "gravity_work") + last(s.energy, "joint_elastic_work") +
                    last(s.energy, "joint_viscous_work") + last(s.energy, "external_work"),
                1e-6 * turned_over);
  }
}

TEST(ForwardSimulation, RefusesExcitationsThatAreNone) {
  const Arm<double> arm = make_arm();
  ArmInput in = bursting(1.0);
  in.excitation[2].value[0] = 1.2;
  EXPECT_THROW((void)simulate(arm, in, {}, {.end_s = 1.0}), InvalidInput);
  in.excitation.pop_back();
  EXPECT_THROW((void)simulate(arm, in, {}, {.end_s = 1.0}), InvalidInput);
  EXPECT_THROW((void)simulate(arm, bursting(1.0), {}, {.end_s = -1.0}), InvalidInput);
}

}  // namespace
}  // namespace myoid::simulation
