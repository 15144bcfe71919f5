#include "myoid/lab/virtual_person/performance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/held_mass.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::lab {
namespace {

TrialProtocol swing() {
  TrialProtocol trial;
  trial.name = "swing";
  trial.kind = TrialKind::flexion;
  trial.held_mass_kg = 1.5;
  trial.cycles.duration_s = 6.0;
  return trial;
}

TrueArm arm_of_seed(std::uint64_t seed) {
  math::Random random(seed);
  return draw_true_arm({}, VirtualSubject{}, random);
}

TEST(Performance, FatigueRestsAsItsDifferentialEquationSays) {
  Tiredness<4> tired;
  tired.rates = muscle::published_fatigue_rates("elbow_rest");
  tired.work({0.6, 0.3, 0.1, 0.9}, 40.0);
  Tiredness<4> stepped = tired;
  tired.rest(60.0);
  // The reference takes the small steps of the library all the way. After two seconds nothing is active but e^-20.
  stepped.work({}, 60.0);
  for (std::size_t m = 0; m < 4; ++m) {
    EXPECT_NEAR(tired.state[m].fatigued, stepped.state[m].fatigued, 1e-8);
    EXPECT_NEAR(tired.strength()[m], 1.0 - tired.state[m].fatigued, 1e-15);
    EXPECT_GT(tired.state[m].fatigued, 0.0);
  }
}

TEST(Performance, WithoutRatesNobodyTires) {
  Tiredness<7> tireless;
  tireless.work({1, 1, 1, 1, 1, 1, 1}, 100.0);
  tireless.rest(10.0);
  for (const double share : tireless.strength()) EXPECT_EQ(share, 1.0);
}

TEST(Performance, TheElectrodeSeesTheActivationADelayBefore) {
  const VirtualArm arm{VirtualSubject{}};
  Tiredness<4> tireless;
  const ExactPerformance performance(arm, arm.literature, make_script(swing(), {}, 4), 0.05, tireless);
  for (const double t : {0.5, 1.7, 3.1}) {
    const PerMuscle seen = performance.drive(t);
    const PerMuscle done = performance.at(t + 0.05).activation;
    for (std::size_t m = 0; m < 4; ++m) EXPECT_EQ(seen[m], done[m]);
  }
}

TEST(Performance, WhatIsBesideTheMusclesHasItsPartInTheEquationOfMotion) {
  const VirtualArm arm{VirtualSubject{}};
  const HillSet& muscles = arm.literature;
  BesideMuscles beside;
  beside.length_activation = 0.15;
  beside.joint_torque_nm = 0.7;
  beside.joint_stiffness_nm_per_rad = 1.1;
  beside.joint_viscosity_nms_per_rad = 0.2;
  Tiredness<4> tireless;
  const ExactPerformance performance(arm, muscles, make_script(swing(), {}, 4), 0.05, tireless, beside);
  for (const double t : {0.5, 1.7, 3.1}) {
    const Instant now = performance.at(t);
    const MuscleGeometry geometry = arm.geometry(now.q);
    // a f_l f_v F_max r of every muscle, its optimum moved by its own activation, and the joint's.
    double torque_nm = 0.7 - 1.1 * now.q.value - 0.2 * now.q.first;
    for (std::size_t i = 0; i < 4; ++i) {
      muscle::HillParameters<double> p = muscles[i];
      p.optimal_fiber_length_m *= 1.0 + 0.15 * (1.0 - now.activation[i]);
      torque_nm += geometry.moment_arm_m[i] * muscle::hill_force(now.activation[i],
                                                                 geometry.length_m[i] - p.tendon_slack_length_m,
                                                                 geometry.velocity_mps[i], p);
    }
    // Activations are turned in until they change by 1e-10, of some 100 N m at the most.
    EXPECT_NEAR(torque_nm,
                required_torque_nm(arm.elbow, now.q.value, now.q.second, performance.script().protocol.plane,
                                   performance.script().protocol.held_mass_kg),
                1e-7);
  }
}

TEST(Performance, ASimulatedPersonFollowsTheMotionAboutAndIsNeverTheSameAsPlanned) {
  const TrueArm arm = arm_of_seed(5);
  Tiredness<7> tireless;
  const TrialScript script = make_script(swing(), {}, 4);
  const SimulatedPerformance performance(arm, script, 0.05, tireless, 9);
  ASSERT_EQ(performance.failure(), "");
  double worst_rad = 0.0;
  for (double t = 0.0; t < script.duration_s; t += 0.01)
    worst_rad = std::max(worst_rad, std::abs(performance.motion(t).value - script.motion(t).value));
  EXPECT_LT(worst_rad, 15.0 * kDegree);
  EXPECT_GT(worst_rad, 0.5 * kDegree);
}

TEST(Performance, TheMotionThatCameOutIsThatOfTheAdaptiveIntegrator) {
  const TrueArm arm = arm_of_seed(5);
  Tiredness<7> tireless;
  const SimulatedPerformance performance(arm, make_script(swing(), {}, 4), 0.05, tireless, 9);
  ASSERT_EQ(performance.failure(), "");

  // The same muscles, joint and excitations through the integrator of forward_simulation.h, with
  // the laws themselves instead of tables. The open loop: nobody corrects what differs.
  std::vector<body::ArmMuscle> muscles;
  for (const TrueHead& head : arm.heads)
    muscles.push_back({head.path, head.parameters.hill, head.parameters.pennation_at_optimal_rad});
  body::BodyModel body = body::parse_osim(body::arm_osim({.elbow_only = true}, "person", muscles), "person.osim");
  body::Body& forearm = body.bodies[static_cast<std::size_t>(*body.find_body("forearm_hand"))];
  const double center_m = arm.static_moment_kgm / forearm.mass_kg;
  forearm.p_BBcm_B = Vec3(0.0, -center_m, 0.0);
  forearm.I_BBcm_B(2, 2) = arm.inertia_kgm2 - forearm.mass_kg * center_m * center_m;
  body = body::with_held_mass(std::move(body), "forearm_hand", Vec3(0.0, -arm.held_at_m, 0.0), 1.5);
  body::SimulationModel other = body::make_simulation_model(std::move(body), {});
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    other.muscles[i].parameters = arm.heads[i].parameters;
    other.muscles[i].laws = arm.laws;
    other.muscles[i].activation = arm.activation;
    other.millard[i] = arm.millard;
  }
  other.joints[0] = arm.joint;
  body::SimulationInput input;
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    body::Signal signal;
    for (const SimulatedPerformance::Sample& sample : performance.samples()) {
      signal.time_s.push_back(sample.time_s);
      signal.value.push_back(sample.excitation[i]);
    }
    input.excitation.push_back(std::move(signal));
  }
  const double first_s = performance.samples()[0].time_s;
  const body::Simulation simulated =
      body::simulate(other, input, {.time_s = first_s, .q = {performance.samples()[0].arm.q.value}},
                     {.end_s = first_s + 2.5, .output_rate_hz = 100.0, .ode = {.relative_tolerance = 1e-6}});
  ASSERT_EQ(simulated.status, math::OdeStatus::done) << simulated.message;
  double moved_rad = 0.0;
  for (Eigen::Index k = 0; k < simulated.motion.sample_count(); ++k) {
    const double t = simulated.motion.time_s()(k);
    const double q = performance.motion(t).value;
    // A few steps' lag of activation at 1 ms, and a free forearm that integrates it twice.
    EXPECT_NEAR(simulated.motion.values()(k, 0), q, 0.5 * kDegree) << t;
    moved_rad = std::max(moved_rad, std::abs(q - performance.samples()[0].arm.q.value));
  }
  EXPECT_GT(moved_rad, 10.0 * kDegree);
}

TEST(Performance, WhoeverIsTooWeakFails) {
  const TrueArm arm = arm_of_seed(5);
  TrialProtocol heavy = swing();
  heavy.held_mass_kg = 60.0;
  const TrialScript script = make_script(heavy, {}, 4);
  EXPECT_GT(foreseen_activation(arm, script), 0.95);
  Tiredness<7> tireless;
  const SimulatedPerformance performance(arm, script, 0.05, tireless, 9);
  EXPECT_NE(performance.failure(), "");
}

}  // namespace
}  // namespace myoid::lab
