#include "myoid/body/simulation/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "myoid/body/simulation/arm_model.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/body/simulation/model_parameters.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

using muscle::TendonMode;

constexpr TendonMode kTendonModes[] = {TendonMode::rigid, TendonMode::equilibrium, TendonMode::mass};

/// Every effect takes part: passive forces, pennation, shifted optimum, a load, gravity.
SimulationModel whole_arm(TendonMode mode) {
  ArmSetup setup{.held_mass_kg = 0.5};
  setup.model.mode = mode;
  setup.model.curves = MuscleCurves::thelen;
  SimulationModel arm = make_arm_model(setup);
  for (ModelMuscle& m : arm.muscles) {
    m.laws.velocity = muscle::VelocityLaw::hill;
    m.parameters.damping = 0.1;
    m.parameters.pennation_at_optimal_rad = 0.15;
    m.parameters.optimal_length_shift = 0.15;
  }
  return arm;
}

SimulationInput there_and_back() {
  const Burst flex[] = {{0.05, 0.15, 0.2}};
  const Burst extend[] = {{0.25, 0.15, 0.3}};
  const Signal flexor = bursts(flex, 0.05);
  return {.excitation = {flexor, flexor, flexor, bursts(extend, 0.05)}};
}

SimulationOptions within(double tolerance) {
  return {.end_s = 0.3,
          .output_times_s = {0.12, 0.2, 0.3},
          .ode = {.relative_tolerance = tolerance, .absolute_tolerance = 0.01 * tolerance}};
}

// Central differences of the simulation itself, by every parameter of one flexor, of joint, arm and
// start, and by the extensor's strength.
TEST(Sensitivities, AgreeWithDifferences) {
  for (const TendonMode mode : kTendonModes) {
    const SimulationModel arm = whole_arm(mode);
    std::vector<std::string> names;
    for (const std::string& name : sensitivity_names(arm)) {
      const bool other = name == "TRI.max_isometric_force" || name == "BRD.tendon_slack_length";
      const bool moves = name.starts_with("BIC.") || name.starts_with("elbow_flexion.") ||
                         name.starts_with("forearm_hand.") || name.starts_with("gravity_");
      if (other || moves) names.push_back(name);
    }
    const SimulationInput input = there_and_back();
    const Sensitivities s = simulate_sensitivities(arm, input, {.q = {1.3}, .qdot = {0.2}}, within(1e-9), names);
    ASSERT_EQ(s.status, math::OdeStatus::done) << s.message;
    for (std::size_t p = 0; p < names.size(); ++p) {
      const auto shifted = [&](double by) {
        SimulationModel other = arm;
        SimulationStart start{.q = {1.3}, .qdot = {0.2}};
        if (names[p] == "elbow_flexion.start") {
          start.q[0] += by;
        } else if (names[p] == "elbow_flexion.start_speed") {
          start.qdot[0] += by;
        } else {
          *model_parameter(other, names[p]).value += by;
        }
        return simulate(other, input, start, within(1e-11));
      };
      SimulationModel copy = arm;
      const bool of_start = names[p].find(".start") != std::string::npos;
      const double value = of_start ? 1.0 : *model_parameter(copy, names[p]).value;
      const double unit = value != 0.0 ? std::abs(value) : 0.1;
      const double h = 3e-4 * unit;
      const Simulation up = shifted(h);
      const Simulation down = shifted(-h);
      const auto c = static_cast<Eigen::Index>(p);
      for (Eigen::Index row = 0; row < 3; ++row) {
        // What changes if the parameter changes by itself, `size` at most, is wrong by 1e-5 of
        // that: the difference has a truncation of (3e-4)^2 times the third derivative and errors
        // of 1e-9 over 6e-4, the sensitivity what its tolerance allows.
        const auto expect = [&](double ours, const TimeSeries& a, const TimeSeries& b, Eigen::Index column, double size,
                                const char* what) {
          const double difference = (a.values()(row, column) - b.values()(row, column)) / (2.0 * h);
          EXPECT_NEAR(ours, difference, 1e-5 * size / unit + 1e-4 * std::abs(difference))
              << what << " by " << names[p] << ", mode " << static_cast<int>(mode) << ", t " << s.time_s[row];
        };
        expect(s["elbow_flexion"](row, c), up.motion, down.motion, 0, 1.0, "angle");
        expect(s["elbow_flexion_speed"](row, c), up.motion, down.motion, 1, 10.0, "speed");
        expect(s["elbow_flexion_acceleration"](row, c), up.motion, down.motion, 2, 100.0, "acceleration");
        expect(s["elbow_flexion_muscles"](row, c), up.torque, down.torque, 0, 10.0, "torque");
        expect(s["BIC_tendon_force"](row, c), up.tendon_force, down.tendon_force, 0, 100.0, "force");
        expect(s["BIC_fiber_length"](row, c), up.fiber_length, down.fiber_length, 0, 0.1, "fiber");
        expect(s["BIC_activation"](row, c), up.activation, down.activation, 0, 1.0, "activation");
      }
    }
    // The sensitivities are not all zero.
    const Eigen::Index strength = 0;  // of BIC, 1060 N
    ASSERT_EQ(names[0], "BIC.max_isometric_force");
    EXPECT_GT(std::abs(s["elbow_flexion"](2, strength)) * 1059.0, 0.05);
  }
}

// In a held posture the torque of rigid muscles is proportional to their strengths: sum F dT/dF = T.
TEST(Sensitivities, OfAHeldTorqueToTheStrengthsAddUpToTheTorque) {
  const SimulationModel arm = make_arm_model();
  SimulationInput input{.excitation = std::vector<Signal>(4, constant(0.2)), .device = {locked()}};
  const std::vector<std::string> names = {"BIC.max_isometric_force", "BRA.max_isometric_force",
                                          "BRD.max_isometric_force", "TRI.max_isometric_force"};
  const SimulationOptions options{.end_s = 0.1, .output_times_s = {0.1}};
  const Sensitivities s = simulate_sensitivities(arm, input, {.q = {1.3}}, options, names);
  const Simulation held = simulate(arm, input, {.q = {1.3}}, options);
  SimulationModel copy = arm;
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    sum += s["elbow_flexion_muscles"](0, static_cast<Eigen::Index>(k)) * *model_parameter(copy, names[k]).value;
  // Round-off of differences of a step of 1e-4.
  EXPECT_NEAR(sum, held.torque.values()(0, 0), 1e-10 * std::abs(sum));
  EXPECT_NEAR(s["elbow_flexion_device"](0, 0), -s["elbow_flexion_muscles"](0, 0), 1e-13);
  EXPECT_EQ(s["elbow_flexion"].cwiseAbs().maxCoeff(), 0.0);
}

// The use of sensitivities: a movement's parameters are found again from it.
TEST(Sensitivities, LeadBackToTheParametersOfAMovement) {
  const std::vector<std::string> names = {"BIC.max_isometric_force", "BIC.optimal_fiber_length",
                                          "TRI.max_isometric_force", "forearm_hand.inertia_zz"};
  for (const TendonMode mode : kTendonModes) {
    const SimulationModel truth = whole_arm(mode);
    SimulationOptions options = within(1e-10);
    options.output_times_s = {0.05, 0.1, 0.15, 0.2, 0.25, 0.3};
    const SimulationInput input = there_and_back();
    const Simulation measured = simulate(truth, input, {.q = {1.3}}, options);
    SimulationModel guess = truth;
    const double off[] = {0.9, 1.03, 1.1, 1.05};
    for (std::size_t k = 0; k < names.size(); ++k) *model_parameter(guess, names[k]).value *= off[k];
    for (int iteration = 0; iteration < 5; ++iteration) {
      const Simulation s = simulate(guess, input, {.q = {1.3}}, options);
      const Sensitivities d = simulate_sensitivities(guess, input, {.q = {1.3}}, options, names);
      Eigen::MatrixXd jacobian(18, 4);
      Eigen::VectorXd residual(18);
      jacobian << d["elbow_flexion"], 0.1 * d["elbow_flexion_speed"], 0.01 * d["elbow_flexion_muscles"];
      residual << s.motion.values().col(0) - measured.motion.values().col(0),
          0.1 * (s.motion.values().col(1) - measured.motion.values().col(1)),
          0.01 * (s.torque.column("muscles") - measured.torque.column("muscles"));
      Eigen::VectorXd size(4);
      for (Eigen::Index k = 0; k < 4; ++k) size[k] = *model_parameter(guess, names[static_cast<std::size_t>(k)]).value;
      const Eigen::MatrixXd scaled = jacobian * size.asDiagonal();
      const Eigen::VectorXd step = scaled.colPivHouseholderQr().solve(-residual);
      for (Eigen::Index k = 0; k < 4; ++k)
        *model_parameter(guess, names[static_cast<std::size_t>(k)]).value += size[k] * step[k];
    }
    // Five steps of Gauss and Newton from 10 % off: quadratic, down to the integration's errors.
    for (const std::string& name : names) {
      SimulationModel copy = truth;
      const double wanted = *model_parameter(copy, name).value;
      EXPECT_NEAR(*model_parameter(guess, name).value, wanted, 1e-5 * wanted)
          << name << ", mode " << static_cast<int>(mode);
    }
  }
}

TEST(Sensitivities, RefuseWhatHasNone) {
  const std::vector<std::string> unknown = {"BIC.colour"};
  EXPECT_THROW((void)simulate_sensitivities(make_arm_model(), there_and_back(), {.q = {1.0}}, within(1e-8), unknown),
               InvalidInput);
}

}  // namespace
}  // namespace myoid::body
