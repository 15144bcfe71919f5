#include "myoid/body/simulation/forward_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/planar_elbow.h"
#include "myoid/body/simulation/arm_model.h"
#include "myoid/body/simulation/skeleton.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

using muscle::TendonMode;

constexpr TendonMode kModes[] = {TendonMode::rigid, TendonMode::equilibrium, TendonMode::mass};

/// Rests until `start_s`, accelerates evenly to the speed within 50 ms, and slows down equally from `end_s` on.
Device isokinetic(double start_s, double end_s, double speed) {
  constexpr double kRise_s = 0.05;
  return {.acceleration =
              [=](double t) {
                if (t >= start_s && t < start_s + kRise_s) return speed / kRise_s;
                return t >= end_s && t < end_s + kRise_s ? -speed / kRise_s : 0.0;
              },
          .jumps_s = {start_s, start_s + kRise_s, end_s, end_s + kRise_s}};
}

ArmSetup in_mode(TendonMode mode) {
  ArmSetup setup;
  setup.model.mode = mode;
  return setup;
}

/// Flexors and extensor in turn, once a second, over a little co-contraction.
SimulationInput bursting(double seconds) {
  std::vector<Burst> flex;
  std::vector<Burst> extend;
  for (int k = 0; k < static_cast<int>(seconds); ++k) {
    flex.push_back({0.2 + k, 0.25, 0.3});
    extend.push_back({0.6 + k, 0.25, 0.2});
  }
  const Signal flexor = bursts(flex, 0.02);
  return {.excitation = {flexor, flexor, flexor, bursts(extend, 0.02)}};
}

SimulationInput held(double excitation, std::size_t muscles) {
  return {.excitation = std::vector<Signal>(muscles, constant(excitation)), .device = {locked()}};
}

/// Records a measured figure for --gtest_output=json:FILE.
void say(const std::string& what, TendonMode mode, double value) {
  constexpr const char* kNames[] = {"rigid", "equilibrium", "mass"};
  ::testing::Test::RecordProperty(what + "_" + kNames[static_cast<int>(mode)], fmt::format("{:.3g}", value));
}

double last(const TimeSeries& series, std::string_view name) {
  return series.values()(series.sample_count() - 1, series.index(name));
}

TEST(ForwardSimulation, AnArmWithoutMusclesSwingsAsAPendulumDoes) {
  SimulationModel arm = make_arm_model({.held_mass_kg = 1.0});
  arm.muscles.clear();
  arm.joints[0] = {};
  const body::PlanarElbow elbow = body::planar_elbow();
  const double inertia = elbow.inertia_kgm2 + elbow.held_at_m * elbow.held_at_m;
  const double moment = elbow.static_moment_kgm + elbow.held_at_m;
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
  const Simulation s =
      simulate(arm, {}, {.q = {q0}}, {.end_s = 5.25 * period_s, .output_times_s = {5.0 * period_s, 5.25 * period_s}});
  ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
  // Local errors of 1e-8, added up over five periods of about a hundred steps.
  EXPECT_NEAR(s.motion.values()(0, 0), q0, 1e-6);
  EXPECT_NEAR(s.motion.values()(1, 0), 0.0, 1e-6);
}

TEST(ForwardSimulation, TheTorqueThatTheMotionRequiresIsThatOfTheMuscles) {
  const body::PlanarElbow elbow = body::planar_elbow();
  for (const TendonMode mode : kModes) {
    ArmSetup setup = in_mode(mode);
    setup.held_mass_kg = 1.5;
    SimulationModel arm = make_arm_model(setup);
    arm.joints[0] = {};
    const Simulation s = simulate(arm, bursting(2.0), {.q = {1.0}}, {.end_s = 2.0});
    ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
    double worst = 0.0;
    for (Eigen::Index k = 0; k < s.motion.sample_count(); ++k) {
      const double required =
          body::required_torque_nm(elbow, s.motion.values()(k, 0), s.motion.values()(k, 2), kStandardGravity, 1.5);
      // Algebra: round-off of torques up to 100 N m, a hundred operations.
      EXPECT_NEAR(required, s.torque.values()(k, 0), 1e-11);
      worst = std::max(worst, std::abs(required - s.torque.values()(k, 0)));
    }
    say("torque_gap_nm", mode, worst);
  }
}

// Every element alone, and all together: work in equals work out.
TEST(ForwardSimulation, EnergyClosesInEveryTendonMode) {
  for (const TendonMode mode : kModes) {
    ArmSetup setup = in_mode(mode);
    setup.held_mass_kg = 0.5;
    setup.model.curves = MuscleCurves::thelen;  // with passive forces
    const SimulationModel arm = make_arm_model(setup);
    SimulationInput in = bursting(10.0);
    in.external = {Signal{{0.0, 3.0, 3.0, 6.0}, {0.0, 1.0, -1.0, 0.5}}};
    const Simulation s = simulate(arm, in, {.q = {1.0}}, {.end_s = 10.0, .output_rate_hz = 1.0, .energy = true});
    ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
    const EnergyBalance balance = energy_balance(s);
    EXPECT_GT(balance.turned_over_j, 10.0);  // energy was exchanged
    EXPECT_LT(balance.worst, 1e-6) << balance.where;
    say("energy_gap", mode, balance.worst);
    EXPECT_GT(std::abs(last(s.energy, "external_work")), 0.1);
  }
}

TEST(ForwardSimulation, EnergyClosesAgainstADevice) {
  for (const TendonMode mode : kModes) {
    const SimulationModel arm = make_arm_model(in_mode(mode));
    SimulationInput in = held(0.3, 4);
    in.device = {isokinetic(0.5, 1.5, 1.0)};
    const Simulation s = simulate(arm, in, {.q = {0.5}}, {.end_s = 2.0, .output_rate_hz = 10.0, .energy = true});
    ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
    EXPECT_LT(energy_balance(s).worst, 1e-6) << energy_balance(s).where;
    // 1 rad/s for a second, the rise and the slowing down of 50 ms as much as one of them in full.
    EXPECT_NEAR(last(s.motion, "elbow_flexion"), 0.5 + 1.0, 1e-9);
    EXPECT_NEAR(last(s.motion, "elbow_flexion_speed"), 0.0, 1e-9);
    // The device's torque to hold a posture.
    EXPECT_NEAR(last(s.torque, "device"),
                -last(s.torque, "muscles") - last(s.torque, "gravity") - last(s.torque, "joint"), 1e-12);
  }
}

TEST(ForwardSimulation, TheTendonModesAgreeInSlowMovement) {
  SimulationInput in;
  for (int i = 0; i < 4; ++i) in.excitation.push_back({{0.0, 5.0, 10.0}, {0.02, 0.08, 0.02}});
  in.device = {isokinetic(0.5, 9.0, 0.15)};
  Eigen::VectorXd torque[3];
  for (const TendonMode mode : kModes) {
    const Simulation s = simulate(make_arm_model(in_mode(mode)), in, {.q = {0.5}}, {.end_s = 10.0});
    ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
    torque[static_cast<int>(mode)] = s.torque.column("muscles");
  }
  const double greatest = torque[0].cwiseAbs().maxCoeff();
  EXPECT_GT(greatest, 2.0);
  EXPECT_LT((torque[1] - torque[0]).cwiseAbs().maxCoeff(), 0.01 * greatest);
  EXPECT_LT((torque[2] - torque[0]).cwiseAbs().maxCoeff(), 0.01 * greatest);
  for (const TendonMode mode : kModes) {
    say("share_of_torque", mode, (torque[static_cast<int>(mode)] - torque[0]).cwiseAbs().maxCoeff() / greatest);
  }
  // A muscle of 0.1 kg hardly matters at 0.15 rad/s: its inertial force is below 1e-3 N, except
  // for the jolts of 3 rad/s^2 when the device starts and stops.
  EXPECT_LT((torque[2] - torque[1]).cwiseAbs().maxCoeff(), 0.002 * greatest);
}

/// One muscle across a hinge that is held: the long head of the biceps.
SimulationModel biceps(TendonMode mode) {
  SimulationModel arm = make_arm_model();
  arm.muscles.resize(1);
  ModelMuscle& m = arm.muscles[0];
  m.laws = muscle::thelen_laws(mode);
  m.laws.tendon = muscle::TendonLaw::linear;
  muscle::HillParameters<double>& hill = m.parameters.hill;
  hill.max_isometric_force_n = 624.3;
  hill.optimal_fiber_length_m = 0.1157;
  hill.tendon_slack_length_m = 0.2723;
  m.parameters.tendon_strain = 0.033;
  m.parameters.muscle_mass_kg = muscle::muscle_mass_kg(624.3, 0.1157);
  return arm;
}

// Passively stretched, so that nothing but B_m damps: M x'' + B x' + (k_t + k_pe) x = 0.
TEST(ForwardSimulation, AMuscleWithMassRingsAtTheFrequencyOfItsTendon) {
  SimulationModel arm = biceps(TendonMode::mass);
  arm.muscles[0].parameters.damping = 0.02;
  std::vector<body::PathPoint>& points = arm.body.muscles[0].path.points;
  points[0].p_BP += 0.08 * (points[0].p_BP - points[1].p_BP).normalized();
  Skeleton skeleton(arm);
  const double q = 1.0;
  const double qdot = 0.0;
  skeleton.set(&q, &qdot);
  const muscle::MusculotendonInput<double> in{0.0, skeleton.length_m(0), 0.0};
  auto fiber = muscle::equilibrium_state(skeleton.unit(0), in);
  const auto o = muscle::musculotendon_output(skeleton.unit(0), in, fiber);
  ASSERT_GT(o.tendon_force_n, 15.0);
  const double mass = arm.muscles[0].parameters.muscle_mass_kg;
  EXPECT_NEAR(std::sqrt(o.tendon_stiffness_npm / mass), 670.0, 10.0);  // science: 670 rad/s
  const double stiffness = o.tendon_stiffness_npm + o.fiber_stiffness_npm;
  const double decay = 0.5 * skeleton.unit(0).damping_nspm() / mass;
  const double omega = std::sqrt(stiffness / mass - decay * decay);

  fiber.fiber_length_m += 1e-6;  // 0.07 N: small against 19 N, the tendon stays taut
  const double period_s = 2.0 * kPi / omega;
  const Simulation s = simulate(arm, held(0.0, 1), {.q = {1.0}, .fiber = {fiber}},
                                {.end_s = 4.0 * period_s,
                                 .output_times_s = {2.0 * period_s, 4.0 * period_s},
                                 .ode = {.relative_tolerance = 1e-11, .absolute_tolerance = 1e-13}});
  ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
  const double rest = fiber.fiber_length_m - 1e-6;
  // After whole periods the displacement is that of the start times exp(-decay t); the passive
  // curve's bend over a micrometer changes it by 1e-4.
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double t = s.motion.time_s()[k];
    EXPECT_NEAR(s.fiber_length.values()(k, 0) - rest, 1e-6 * std::exp(-decay * t), 2e-9);
  }
}

TEST(ForwardSimulation, AHeldMuscleComesToRestWithTendonAndFiberPullingAlike) {
  for (const TendonMode mode : kModes) {
    for (const double u : {0.1, 0.6}) {
      const Simulation s =
          simulate(biceps(mode), {.excitation = {step(0.1, u, 0.05)}, .device = {locked()}}, {.q = {1.0}},
                   {.end_s = 10.0,
                    .output_times_s = {0.0, 10.0},
                    .ode = {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-15}});
      ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
      const double pull = last(s.tendon_force, "BIC");
      EXPECT_GT(pull, 15.0);
      EXPECT_NEAR(pull, last(s.fiber_force, "BIC"), 1e-9 * pull);
      say("force_gap", mode, std::abs(pull / last(s.fiber_force, "BIC") - 1.0));
      EXPECT_NEAR(last(s.fiber_velocity, "BIC"), 0.0, 1e-10);
    }
  }
}

TEST(ForwardSimulation, ATighterToleranceMovesTheResultInProportion) {
  for (const TendonMode mode : kModes) {
    const SimulationModel arm = make_arm_model(in_mode(mode));
    const auto angles = [&](double tolerance) {
      const Simulation s = simulate(arm, bursting(3.0), {.q = {1.0}},
                                    {.end_s = 3.0,
                                     .output_rate_hz = 100.0,
                                     .ode = {.relative_tolerance = tolerance, .absolute_tolerance = 0.01 * tolerance}});
      EXPECT_EQ(s.status, math::OdeStatus::done) << s.message;
      return Eigen::VectorXd(s.motion.column("elbow_flexion"));
    };
    const Eigen::VectorXd exact = angles(1e-11);
    const auto error = [&](double tolerance) { return (angles(tolerance) - exact).cwiseAbs().maxCoeff(); };
    // A method of order p, whose error per step h^(p+1) is held to the tolerance, errs by h^p = tolerance^(p/(p+1)) in
    // the end: 5/6 for backward differentiation of order 5, 4/5 of order 4, where it mostly is. The explicit method
    // goes on with order 5 and estimates its error by order 4: the power is one. The slope of a line through five
    // tolerances, as errors of single tolerances scatter by a factor of two.
    double power = 0.0;
    for (int k = -2; k <= 2; ++k) power -= 0.1 * k * std::log2(error(1e-5 * std::exp2(-2.5 * (k + 2)))) / 2.5;
    EXPECT_GT(power, mode == TendonMode::rigid ? 0.85 : 0.7);
    EXPECT_LT(power, mode == TendonMode::rigid ? 1.25 : 0.95);
    say("power_of_tolerance", mode, power);
    EXPECT_LT(error(1e-7), 1e-4);
    say("error_rad_at_1e-7", mode, error(1e-7));
  }
}

TEST(ForwardSimulation, WhatIsRecordedDoesNotChangeTheMotion) {
  const SimulationModel arm = make_arm_model(in_mode(TendonMode::equilibrium));
  const Simulation often = simulate(arm, bursting(1.0), {.q = {1.0}}, {.end_s = 1.0});
  const Simulation seldom = simulate(arm, bursting(1.0), {.q = {1.0}}, {.end_s = 1.0, .output_rate_hz = 3.0});
  EXPECT_EQ(seldom.motion.sample_count(), 4);
  EXPECT_EQ(last(often.motion, "elbow_flexion"), last(seldom.motion, "elbow_flexion"));
}

// With the envelope as activation, a step of excitation is a step of force: no effect may precede it.
TEST(ForwardSimulation, AJumpOfTheActivationActsFromItsTimeOn) {
  ArmSetup setup{.horizontal = true};
  setup.model.activation = muscle::ActivationLaw::envelope;
  SimulationModel arm = make_arm_model(setup);
  arm.joints[0] = {};
  SimulationInput in{.excitation = std::vector<Signal>(4, constant(0.0))};
  in.excitation[1] = step(0.3, 0.5);
  const Simulation s = simulate(arm, in, {.q = {1.2}}, {.end_s = 0.31});
  EXPECT_EQ(s.motion.values()(299, 0), 1.2);
  const double torque = s.torque.values()(305, 0);
  EXPECT_GT(torque, 1.0);
  // Half the acceleration times time squared, 8 ms on; the force falls by some percent with speed.
  EXPECT_NEAR(s.motion.values()(308, 0) - 1.2, 0.5 * torque / body::planar_elbow().inertia_kgm2 * 64e-6, 5e-4);
  EXPECT_GT(s.motion.values()(308, 0), 1.2005);
}

// 0.1 + 0.2 is not 0.3: jumps that differ by round-off count as one.
TEST(ForwardSimulation, JumpsAHairApartDoNoHarm) {
  for (const TendonMode mode : kModes) {
    SimulationInput in;
    in.excitation = {step(0.3, 0.2), step(0.1 + 0.2, 0.2), step(0.3, 0.1), step(0.1, 0.05)};
    in.device = {isokinetic(0.1 + 0.2, 0.5, 0.5)};
    const Simulation s =
        simulate(make_arm_model(in_mode(mode)), in, {.q = {1.0}}, {.end_s = 0.6, .output_rate_hz = 100.0});
    EXPECT_EQ(s.status, math::OdeStatus::done) << s.message;
    EXPECT_EQ(s.motion.sample_count(), 61);
  }
}

TEST(ForwardSimulation, ANumericalFailureIsSaidAndWhatWasReachedKept) {
  const Simulation s = simulate(make_arm_model(in_mode(TendonMode::equilibrium)), bursting(1.0), {.q = {1.0}},
                                {.end_s = 1.0, .ode = {.max_steps = 200}});
  EXPECT_EQ(s.status, math::OdeStatus::too_many_steps);
  EXPECT_FALSE(s.message.empty());
  EXPECT_LT(s.reached_s, 1.0);
  EXPECT_GT(s.motion.sample_count(), 0);
  EXPECT_LT(s.motion.sample_count(), 1000);
}

TEST(ForwardSimulation, RefusesWhatCannotBeSimulated) {
  const SimulationModel arm = make_arm_model();
  SimulationInput in = bursting(1.0);
  in.excitation[2].value[0] = 1.2;
  EXPECT_THROW((void)simulate(arm, in, {.q = {1.0}}, {.end_s = 1.0}), InvalidInput);
  in.excitation.pop_back();
  EXPECT_THROW((void)simulate(arm, in, {.q = {1.0}}, {.end_s = 1.0}), InvalidInput);
  const SimulationInput good = bursting(1.0);
  EXPECT_THROW((void)simulate(arm, good, {.q = {1.0}}, {.end_s = -1.0}), InvalidInput);
  EXPECT_THROW((void)simulate(arm, good, {}, {.end_s = 1.0}), InvalidInput);
  EXPECT_THROW((void)simulate(arm, good, {.q = {1.0}}, {.output_rate_hz = 0.0}), InvalidInput);
  EXPECT_THROW((void)simulate(arm, good, {.q = {1.0}}, {.output_times_s = {0.5, 0.4}}), InvalidInput);
  EXPECT_THROW((void)energy_balance(simulate(arm, good, {.q = {1.0}}, {.end_s = 0.1})), InvalidInput);
}

TEST(ForwardSimulation, EndsOnRequest) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW((void)simulate(make_arm_model(), bursting(1.0), {.q = {1.0}},
                              {.progress = {.report = {}, .stop = stop.get_token()}}),
               Interrupted);
}

}  // namespace
}  // namespace myoid::body
