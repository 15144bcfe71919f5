#include "myoid/results/simulation_files.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/body/simulation/arm_model.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

body::Simulation slow_movement(double seconds, double rate_hz) {
  body::ArmSetup setup;
  setup.model.mode = muscle::TendonMode::equilibrium;
  body::SimulationInput input;
  for (int i = 0; i < 4; ++i) input.excitation.push_back({{0.0, 0.5 * seconds, seconds}, {0.03, 0.05, 0.03}});
  return body::simulate(body::make_arm_model(setup), input, {.q = {0.8}},
                        {.end_s = seconds, .output_rate_hz = rate_hz, .energy = true});
}

// Through files, as a user would: only the angles are given, all else is derived from them.
TEST(SimulationFiles, InverseDynamicsOfTheMotionFileIsTheTorque) {
  const test::TemporaryFolder folder;
  const body::BodyModel body = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const body::Simulation s = slow_movement(1.0, 1000.0);
  write_simulation(s, body, {{"shoulder_flexion", 0.0}}, {.options_json = "{}"}, folder.path());
  const recording::Storage file = recording::read_storage(folder.path() / "motion.mot");
  EXPECT_TRUE(file.in_degrees);
  const TimeSeries q = recording::to_si(file, [](const std::string&) { return true; });
  const TimeSeries torque = body::inverse_dynamics(body, body::joint_motion(body, q).motion);
  const Eigen::VectorXd id = torque.column("elbow_flexion_moment");
  const recording::Storage written = recording::read_storage(folder.path() / "torques.sto");
  const Eigen::VectorXd truth = written.data.column("elbow_flexion_moment");
  ASSERT_EQ(id.size(), truth.size());
  // Second differences at 1 kHz of angles good to 1e-9 rad: 0.07 kg m^2 * 4e-9 * 1e6 = 3e-4 N m;
  // the ends, where the spline knows nothing, apart.
  for (Eigen::Index k = 50; k < id.size() - 50; ++k) EXPECT_NEAR(id[k], truth[k], 1e-3) << k;
  const Eigen::VectorXd parts =
      written.data.column("elbow_flexion_moment_muscles") + written.data.column("elbow_flexion_moment_joint") +
      written.data.column("elbow_flexion_moment_external") + written.data.column("elbow_flexion_moment_device");
  EXPECT_LT((truth - parts).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SimulationFiles, EveryFileIsThereAndSaysWhatItHolds) {
  const test::TemporaryFolder folder;
  const body::BodyModel body = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const body::Simulation s = slow_movement(0.2, 100.0);
  write_simulation(s, body, {}, {.command = "myoid simulate", .options_json = "{}"}, folder.path());
  for (const char* file :
       {"motion.mot", "speeds.sto", "accelerations.sto", "excitation.sto", "activation.sto", "forces.sto",
        "fiber_forces.sto", "MuscleAnalysis_Length.sto", "MuscleAnalysis_MuscleTendonVelocity.sto",
        "MuscleAnalysis_FiberLength.sto", "MuscleAnalysis_FiberVelocity.sto", "MuscleAnalysis_TendonLength.sto",
        "MuscleAnalysis_MomentArm_elbow_flexion.sto", "torques.sto", "states.sto", "energy.sto"}) {
    EXPECT_EQ(recording::read_storage(folder.path() / file).data.sample_count(), 21) << file;
  }
  const auto json = nlohmann::json::parse(simulation_json(s, {.options_json = "{}"}));
  EXPECT_EQ(json["finished"], true);
  EXPECT_LT(json["energy"]["worst_relative_gap"], 1e-6);
  const recording::Storage states = recording::read_storage(folder.path() / "states.sto");
  EXPECT_EQ(states.data.column("BIC/fiber_length")[20], s.fiber_length.column("BIC")[20]);
  EXPECT_EQ(states.data.column("elbow_flexion/value")[20], s.motion.values()(20, 0));
}

TEST(PaperFigures, AreTheCurvesAndAMovementThereAndBack) {
  const std::vector<page::Figure> figures = paper_figures();
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].id, "figure2");
  EXPECT_EQ(figures[0].panels.size(), 2u);
  const page::Figure& movement = figures[1];
  ASSERT_EQ(movement.panels.size(), 8u);
  const std::vector<double>& angle = movement.panels[2].series[0].y;
  const double highest = *std::max_element(angle.begin(), angle.end());
  EXPECT_GT(highest, angle.front() + 30.0);  // degrees of flexion, within the elbow's range
  EXPECT_LT(highest, 140.0);
  EXPECT_LT(*std::min_element(angle.begin() + static_cast<long>(angle.size()) / 3, angle.end()), highest - 30.0);
}

TEST(SensitivityFiles, HaveAColumnPerParameterAndAFilePerQuantity) {
  const test::TemporaryFolder folder;
  body::SimulationInput input;
  const body::SimulationModel arm = body::make_arm_model();
  input.excitation.assign(arm.muscles.size(), body::constant(0.1));
  const std::vector<std::string> names = {"BIC.max_isometric_force", "forearm_hand.mass", "elbow_flexion.start"};
  const body::Sensitivities s =
      body::simulate_sensitivities(arm, input, {.q = {1.0}}, {.end_s = 0.1, .output_rate_hz = 100.0}, names);
  write_sensitivities(s, {.options_json = "{}"}, folder.path());
  for (const char* file : {"elbow_flexion_speed", "elbow_flexion_acceleration", "elbow_flexion_muscles",
                           "elbow_flexion_device", "BIC_activation", "TRI_fiber_length", "BRD_tendon_force"}) {
    const recording::Storage read =
        recording::read_storage(folder.path() / "sensitivities" / (std::string(file) + ".sto"));
    EXPECT_EQ(read.data.sample_count(), 11) << file;
    EXPECT_EQ(read.data.channel_count(), 3) << file;
  }
  const recording::Storage angle = recording::read_storage(folder.path() / "sensitivities/elbow_flexion.sto");
  EXPECT_EQ(angle.data.column("elbow_flexion.start")[0], 1.0);
  EXPECT_EQ(angle.data.column("forearm_hand.mass")[10], s["elbow_flexion"](10, 1));
}

}  // namespace
}  // namespace myoid::results
