// A muscle that crosses two joints, identified from the torques of both.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/forces/sharing_input.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/hill_muscle.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/results/result_files.h"
#include "myoid/results/stage_files.h"
#include "myoid/run/run_study.h"
#include "myoid/study/read_study.h"
#include "myoid/study/study_model.h"

#include "tests/support/temporary_folder.h"

namespace myoid::run {
namespace {

std::string joint(const char* name, const char* parent, const char* child, const char* at) {
  return fmt::format(
      R"(<PinJoint name="{0}"><socket_parent_frame>{0}_at</socket_parent_frame>
      <socket_child_frame>/bodyset/{2}</socket_child_frame>
      <coordinates><Coordinate name="{0}_angle"><range>-3 3</range></Coordinate></coordinates>
      <frames><PhysicalOffsetFrame name="{0}_at"><socket_parent>{1}</socket_parent>
      <translation>{3}</translation></PhysicalOffsetFrame></frames></PinJoint>)",
      name, parent, child, at);
}

std::string body(const char* name, double mass_kg) {
  return fmt::format(
      R"(<Body name="{}"><mass>{}</mass><mass_center>0 -0.2 0</mass_center>
      <inertia>0.1 0.01 0.1 0 0 0</inertia></Body>)",
      name, mass_kg);
}

struct Point {
  const char* body;
  const char* at;
};

std::string muscle(const char* name, double force_n, double fiber_m, double slack_m, const std::vector<Point>& points) {
  std::string path;
  for (std::size_t i = 0; i < points.size(); ++i) {
    path += fmt::format(
        R"(<PathPoint name="p{}"><socket_parent_frame>{}</socket_parent_frame>
        <location>{}</location></PathPoint>)",
        i, points[i].body, points[i].at);
  }
  return fmt::format(
      R"(<Thelen2003Muscle name="{}"><GeometryPath name="geometrypath"><PathPointSet><objects>{}
      </objects></PathPointSet></GeometryPath><max_isometric_force>{}</max_isometric_force>
      <optimal_fiber_length>{}</optimal_fiber_length><tendon_slack_length>{}</tendon_slack_length>
      <pennation_angle_at_optimal>0.2</pennation_angle_at_optimal></Thelen2003Muscle>)",
      name, path, force_n, fiber_m, slack_m);
}

/// Thigh and shank in a plane; HAM crosses hip and knee, GLU the hip, QUA the knee.
std::string leg_osim() {
  return R"(<?xml version="1.0"?><OpenSimDocument Version="40000"><Model name="leg">
    <gravity>0 -9.80665 0</gravity><BodySet><objects>)" +
         body("thigh", 8.0) + body("shank", 4.0) + "</objects></BodySet><JointSet><objects>" +
         joint("hip", "/ground", "thigh", "0 0 0") + joint("knee", "/bodyset/thigh", "shank", "0 -0.4 0") +
         "</objects></JointSet><ForceSet><objects>" +
         muscle("HAM", 1200.0, 0.11, 0.33, {{"/ground", "-0.06 -0.02 0"}, {"/bodyset/shank", "-0.03 -0.04 0"}}) +
         muscle("GLU", 900.0, 0.14, 0.02, {{"/ground", "-0.07 0.05 0"}, {"/bodyset/thigh", "-0.03 -0.12 0"}}) +
         muscle("QUA", 2500.0, 0.10, 0.23,
                {{"/bodyset/thigh", "0.03 -0.08 0"},
                 {"/bodyset/thigh", "0.05 -0.37 0"},
                 {"/bodyset/shank", "0.04 -0.06 0"}}) +
         "</objects></ForceSet></Model></OpenSimDocument>";
}

constexpr double kLength_s = 12.0;

TimeSeries leg_motion(double phase) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1201, 0.0, kLength_s);
  Eigen::MatrixXd q(t.size(), 2);
  q.col(0) = 0.5 + 0.45 * (2.1 * t.array() + phase).sin();
  q.col(1) = -0.7 + 0.55 * (1.3 * t.array() + 2.0 * phase).sin();
  return {t, {{"hip_angle", Unit::radian}, {"knee_angle", Unit::radian}}, q};
}

TimeSeries activation(double phase) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1201, 0.0, kLength_s);
  Eigen::MatrixXd a(t.size(), 3);
  for (int m = 0; m < 3; ++m) a.col(m) = 0.35 + 0.3 * ((0.9 + 0.37 * m) * t.array() + phase * (m + 1)).sin();
  return {t, {{"HAM", Unit::dimensionless}, {"GLU", Unit::dimensionless}, {"QUA", Unit::dimensionless}}, a};
}

study::Study leg_study(const std::string& coordinates) {
  study::Study study = study::parse_study(fmt::format(R"(
[model]
file = "leg.osim"
coordinate = {}
[motion]
smoothing = "none"
[emg]
kind = "activation"
delay_s = 0.0
[identify]
muscle_law = "paper"
tendon = "rigid"
method = "torque"
gain = false
[[muscle]]
name = "HAM"
emg = "HAM"
fixed = ["max_shortening_speed"]
[[muscle]]
name = "GLU"
emg = "GLU"
fixed = ["max_shortening_speed"]
[[muscle]]
name = "QUA"
emg = "QUA"
fixed = ["max_shortening_speed"]
[[trial]]
name = "one"
motion = "one.mot"
emg = "one.sto"
[[trial]]
name = "two"
motion = "two.mot"
emg = "two.sto"
)",
                                                      coordinates),
                                          "leg.toml");
  study.model.text = leg_osim();
  study.phases.search = false;
  return study;
}

muscle::HillParameters<double> truth_of(const fit::MuscleSetup& setup) {
  muscle::HillParameters<double> p = setup.start;
  p.max_isometric_force_n *= setup.name == "QUA" ? 0.8 : 1.25;
  p.optimal_fiber_length_m *= setup.name == "GLU" ? 0.96 : 1.04;
  p.force_length_width_m *= 1.1;
  return p;
}

/// What surrounds the leg exerts whatever the muscles do not.
std::vector<study::TrialInput> exact_inputs(const study::Study& study) {
  const body::BodyModel leg = study::load_model(study);
  const std::vector<fit::MuscleSetup> setups = study::muscle_setups(study, leg);
  std::vector<study::TrialInput> inputs;
  for (const double phase : {0.3, 1.9}) {
    study::TrialInput input;
    input.motion = leg_motion(phase);
    input.emg = activation(phase);
    const body::JointMotion moved = body::joint_motion(leg, *input.motion, {}).motion;
    const body::MuscleKinematics muscles = body::muscle_kinematics(leg, moved);
    const TimeSeries needed = body::inverse_dynamics(leg, moved);
    Eigen::MatrixXd outside(moved.sample_count(), 2);
    const std::vector<std::string> coordinates{"hip_angle", "knee_angle"};
    for (Eigen::Index j = 0; j < 2; ++j) {
      const std::string& name = coordinates[static_cast<std::size_t>(j)];
      outside.col(j) = needed.column(name + "_moment");
      for (Eigen::Index m = 0; m < 3; ++m) {
        const auto& setup = setups[static_cast<std::size_t>(m)];
        const muscle::HillParameters<double> p = truth_of(setup);
        for (Eigen::Index i = 0; i < outside.rows(); ++i) {
          outside(i, j) -=
              muscles.moment_arm.at(name).values()(i, m) *
              muscle::hill_force(input.emg->values()(i, m), muscles.length.values()(i, m) - p.tendon_slack_length_m,
                                 muscles.velocity.values()(i, m), p);
        }
      }
    }
    std::vector<Channel> columns;
    for (const std::string& name : study::study_coordinates(study.model))
      columns.push_back({name + "_moment", Unit::newton_meter});
    input.external_torque =
        TimeSeries(moved.q.time_s(), columns, outside.leftCols(static_cast<Eigen::Index>(columns.size())));
    inputs.push_back(std::move(input));
  }
  return inputs;
}

TEST(SeveralJoints, BothTorquesGiveTheMusclesOfBothJoints) {
  const study::Study study = leg_study(R"(["hip_angle", "knee_angle"])");
  const StudyResult result = analyse(in_memory(study, exact_inputs(study)));
  ASSERT_EQ(result.fit.methods.size(), 1U);
  int compared = 0;
  for (const auto& e : result.fit.methods[0].estimates) {
    if (e.parameter != "max_isometric_force" && e.parameter != "optimal_fiber_length" &&
        e.parameter != "force_length_width")
      continue;
    for (const auto& setup : result.fit_input.data.muscles) {
      if (setup.name != e.muscle) continue;
      const double truth = truth_of(setup).*muscle::hill_field(e.parameter).member;
      EXPECT_NEAR(e.estimate, truth, 1e-5 * truth) << e.muscle << " " << e.parameter;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 9);
  // Each trial left out is predicted at each joint.
  ASSERT_EQ(result.folds.size(), 4U);
  EXPECT_EQ(result.folds[1].joint, "knee_angle");
  for (const auto& fold : result.folds) EXPECT_GT(fold.identified.r2(), 0.999) << fold.joint;
  // Shared forces balance both joints.
  const TrialResult& trial = result.trials[0];
  EXPECT_EQ(trial.forces.shared.reserve.channel_count(), 2);
  EXPECT_EQ(result.fit.informed.at(0).reserve_nm.cols(), 2);
}

TEST(SeveralJoints, TheHipAloneDoesNotTellTheKneesMuscle) {
  const study::Study study = leg_study(R"("hip_angle")");
  const StudyResult result = analyse(in_memory(study, exact_inputs(study)));
  for (const auto& e : result.fit.methods.at(0).estimates) {
    if (e.muscle != "QUA") continue;
    EXPECT_NE(e.verdict, fit::Verdict::identified) << e.parameter;
  }
}

TEST(SeveralJoints, FilesHaveAReserveForEachJoint) {
  const test::TemporaryFolder folder;
  const study::Study study = leg_study(R"(["hip_angle", "knee_angle"])");
  results::write_results(analyse(in_memory(study, exact_inputs(study))), {}, folder / "out");
  const TimeSeries forces = recording::read_storage(folder / "out/one/EmgInformed_force.sto").data;
  EXPECT_TRUE(forces.find("hip_angle_reserve"));
  EXPECT_TRUE(forces.find("knee_angle_reserve"));
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// `so` is sharing_input, share and write_shared_forces; the motion is the run's own.
TEST(SeveralJoints, RunAndSoWriteTheSameStaticOptimizationFiles) {
  const test::TemporaryFolder folder;
  study::Study study = leg_study(R"(["knee_angle", "hip_angle"])");
  study.identify.cross_validate = false;
  study.identify.next_movements = 0;
  std::vector<study::TrialInput> inputs = exact_inputs(study);
  for (study::TrialInput& input : inputs) input.external_torque.reset();
  const StudyResult result = analyse(in_memory(study, std::move(inputs)));
  results::write_results(result, {}, folder / "run");
  const TrialMotion& motion = result.trials[0].motion;
  const body::SharingInput shared = body::sharing_input(
      *motion.model, motion.joints, body::muscle_kinematics(*motion.model, motion.joints), {"hip_angle", "knee_angle"});
  results::write_shared_forces(body::share(shared, {}), folder / "so");
  for (const char* name :
       {"StaticOptimization_force.sto", "StaticOptimization_activation.sto", "StaticOptimization_status.csv"}) {
    const std::string of_so = bytes_of(folder / "so" / name);
    EXPECT_GT(of_so.size(), 1000U) << name;
    EXPECT_EQ(bytes_of(folder / "run/one" / name), of_so) << name;
  }
}

TEST(SeveralJoints, ADynamometerDoesNotMeasureBothTorquesOfAMaximalContraction) {
  const auto fitted = [](const char* coordinates, bool load_cell) {
    study::Study study = leg_study(coordinates);
    study.identify.methods.clear();
    std::vector<study::TrialInput> inputs = exact_inputs(study);
    study.trials[0].use = study::Use::mvc;
    (load_cell ? study.trials[0].load_cell : study.trials[0].external_torque) = "measured.sto";
    const StudyResult result = analyse(in_memory(study, std::move(inputs)));
    return std::ranges::any_of(result.fit_input.data.trials, &fit::TrialData::reference);
  };
  EXPECT_TRUE(fitted(R"("hip_angle")", false));
  EXPECT_FALSE(fitted(R"(["hip_angle", "knee_angle"])", false));
  EXPECT_TRUE(fitted(R"(["hip_angle", "knee_angle"])", true));
}

TEST(SeveralJoints, PennationAndPassiveForceComeFromAnOpenSimModel) {
  study::Study study = leg_study(R"(["hip_angle", "knee_angle"])");
  const body::BodyModel leg = study::load_model(study);
  EXPECT_EQ(study::muscle_setups(study, leg)[0].extras.pennation_angle_rad, 0.0);
  study.identify.muscle_law = study::MuscleLaw::automatic;
  study.identify.elastic_tendon = true;
  const fit::MuscleExtras extras = study::muscle_setups(study, leg)[0].extras;
  EXPECT_DOUBLE_EQ(extras.pennation_angle_rad, 0.2);
  EXPECT_DOUBLE_EQ(extras.passive_force, 1.0);
  EXPECT_DOUBLE_EQ(extras.passive_strain, 0.6);
  EXPECT_GT(extras.tendon_strain, 0.02);
  study.model = {.builtin = "arm4", .coordinate = "elbow_flexion"};
  EXPECT_FALSE(study::takes_model_law(study));
}

}  // namespace
}  // namespace myoid::run
