#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/opensim/analysis_reports.h"
#include "myoid/opensim/tool_stages.h"

#include "tests/support/tool_folder.h"

namespace myoid::opensim {
namespace {

using ToolAnalyses = test::ToolFolder;

TEST_F(ToolAnalyses, AnalysesShareAMotion) {
  write_motion(40);
  write("reserves.xml", "<OpenSimDocument Version=\"40000\"><ForceSet><objects>" + reserves() +
                            "</objects></ForceSet></OpenSimDocument>");
  const ToolResult result =
      run("<AnalyzeTool "
          "name=\"a\"><model_file>arm.osim</model_file><results_directory>r</results_directory>"
          "<force_set_files>reserves.xml</force_set_files><initial_time>0.1</initial_time>"
          "<final_time>0.3</final_time><coordinates_file>motion.mot</coordinates_file>"
          "<solve_for_equilibrium_for_auxiliary_states>true</"
          "solve_for_equilibrium_for_auxiliary_states>"
          "<AnalysisSet><objects><MuscleAnalysis name=\"MuscleAnalysis\"/>"
          "<StaticOptimization name=\"StaticOptimization\"/><Kinematics name=\"Kinematics\"/>"
          "<OutputReporter name=\"o\"><output_paths>/forceset/" +
          arm_.muscles[0].name +
          "/path|length</output_paths></OutputReporter><InducedAccelerations name=\"ia\"/>"
          "</objects></AnalysisSet></AnalyzeTool>");
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("InducedAccelerations")));
  for (const char* name : {"r/a_MuscleAnalysis_Length.sto", "r/a_MuscleAnalysis_MomentArm_elbow_flexion.sto",
                           "r/a_StaticOptimization_activation.sto", "r/a_StaticOptimization_force.sto",
                           "r/a_StaticOptimization_controls.xml", "r/a_Kinematics_q.sto", "r/a_Outputs.sto"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  const TimeSeries activation = read("r/a_StaticOptimization_activation.sto");
  EXPECT_EQ(activation.sample_count(), 21);
  EXPECT_EQ(activation.channel_count(), static_cast<Eigen::Index>(arm_.muscles.size() + arm_.coordinates.size()));
  EXPECT_EQ(result.frames_failed, 0) << result.summary;
  const Eigen::VectorXd length = read("r/a_MuscleAnalysis_Length.sto").column(arm_.muscles[0].name);
  EXPECT_LT((length - read("r/a_Outputs.sto").values().col(0)).cwiseAbs().maxCoeff(), 1e-8);
}

// Static optimization's forces make the motion's accelerations: gravity and inertia of everything
// are carried by the joint to ground, the arm's weight and what accelerates it by the shoulder.
TEST_F(ToolAnalyses, JointReactionCarriesWhatForcesOfStaticOptimizationMake) {
  write_motion(40);
  std::string reserves = "<OpenSimDocument Version=\"40000\"><ForceSet><objects>";
  for (const body::Coordinate& c : arm_.coordinates) {
    reserves += "<CoordinateActuator name=\"" + c.name + "_reserve\"><coordinate>" + c.name +
                "</coordinate><optimal_force>1</optimal_force></CoordinateActuator>";
  }
  write("reserves.xml", reserves + "</objects></ForceSet></OpenSimDocument>");
  const auto tool = [](const std::string& analysis) {
    return "<AnalyzeTool name=\"a\"><model_file>arm.osim</model_file><force_set_files>reserves.xml"
           "</force_set_files><initial_time>0.1</initial_time><final_time>0.3</final_time>"
           "<coordinates_file>motion.mot</coordinates_file><AnalysisSet><objects>" +
           analysis + "</objects></AnalysisSet></AnalyzeTool>";
  };
  (void)run(tool("<StaticOptimization name=\"so\"/><Kinematics name=\"k\"/>"));
  const ToolResult result =
      run(tool("<JointReaction name=\"jr\"><forces_file>a_so_force.sto</forces_file><joint_names>All"
               "</joint_names><apply_on_bodies>child</apply_on_bodies><express_in_frame>ground"
               "</express_in_frame></JointReaction>"
               "<JointReaction name=\"up\"><forces_file>a_so_force.sto</forces_file><joint_names>shoulder"
               "</joint_names><apply_on_bodies>parent</apply_on_bodies><express_in_frame>child"
               "</express_in_frame></JointReaction>"));
  const TimeSeries loads = read("a_jr_ReactionLoads.sto");
  ASSERT_EQ(loads.sample_count(), 21);
  EXPECT_EQ(loads.channel_count(), static_cast<Eigen::Index>(9 * arm_.joints.size()));
  // The centers of mass of arm and forearm by second differences of the motion.
  double mass_kg = 0.0;
  for (const body::Body& body : arm_.bodies) mass_kg += body.mass_kg;
  const auto momentum_center = [&](double frame) {
    Eigen::VectorXd q = arm_.default_q();
    q.setZero();
    q[arm_.coordinate_index("elbow_flexion")] = 1.2 + 0.5 * std::sin(0.1 * frame);
    body::BodyState state = body::make_state(arm_);
    body::compute_poses(arm_, q, state);
    Vec3 sum = Vec3::Zero();
    for (std::size_t b = 1; b < arm_.bodies.size(); ++b)
      sum += arm_.bodies[b].mass_kg * (state.X_GB[b] * arm_.bodies[b].p_BBcm_B);
    return sum;
  };
  for (Eigen::Index i = 5; i < 16; ++i) {
    const double frame = static_cast<double>(i) + 10.0;
    const Vec3 inertia =
        (momentum_center(frame + 0.1) - 2.0 * momentum_center(frame) + momentum_center(frame - 0.1)) / (0.001 * 0.001);
    const Vec3 expected = inertia - mass_kg * arm_.gravity_G;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const std::string column = arm_.joints[0].name + "_on_" + arm_.bodies[1].name + "_in_ground_f" + "xyz"[k];
      // The spline through 40 samples misses the sine's second derivative by 1e-4 of 5 rad/s^2 at
      // these places; 1 kg m of it.
      EXPECT_NEAR(loads.column(column)[i], expected[k], 2e-3) << column;
    }
  }
  const TimeSeries up = read("a_up_ReactionLoads.sto");
  const Vec3 on_child(loads.column("shoulder_on_upper_arm_in_ground_fx")[7],
                      loads.column("shoulder_on_upper_arm_in_ground_fy")[7],
                      loads.column("shoulder_on_upper_arm_in_ground_fz")[7]);
  EXPECT_NEAR(up.values().row(7).head(3).norm(), on_child.norm(), 1e-6);
  EXPECT_LT(up.values().row(7).segment(6, 3).norm(), 1e-8);  // both frames of a ball are together
}

// A path actuator has a column like the muscles, and its force is its control times its strength.
TEST_F(ToolAnalyses, PathActuatorsShareTheLoad) {
  write_motion(40);
  std::string forces =
      "<OpenSimDocument Version=\"40000\"><ForceSet><objects><PathActuator name=\"cable\">"
      "<optimal_force>300</optimal_force><min_control>0</min_control><max_control>1</max_control>"
      "<GeometryPath><PathPointSet><objects><PathPoint name=\"a\"><socket_parent_frame>/ground"
      "</socket_parent_frame><location>0.05 0.1 0</location></PathPoint><PathPoint name=\"b\">"
      "<socket_parent_frame>/bodyset/forearm_hand</socket_parent_frame><location>0.02 -0.1 0"
      "</location></PathPoint></objects></PathPointSet></GeometryPath></PathActuator>";
  write("more.xml", forces + reserves() + "</objects></ForceSet></OpenSimDocument>");
  const ToolResult result =
      run("<AnalyzeTool name=\"a\"><model_file>arm.osim</model_file><force_set_files>more.xml"
          "</force_set_files><initial_time>0.1</initial_time><final_time>0.3</final_time>"
          "<coordinates_file>motion.mot</coordinates_file><AnalysisSet><objects>"
          "<StaticOptimization name=\"StaticOptimization\"/></objects></AnalysisSet>"
          "</AnalyzeTool>");
  EXPECT_EQ(result.frames_failed, 0) << result.summary;
  const Eigen::VectorXd control = read("a_StaticOptimization_activation.sto").column("cable");
  const Eigen::VectorXd force = read("a_StaticOptimization_force.sto").column("cable");
  EXPECT_GT(control.maxCoeff(), 1e-4);
  EXPECT_LT((force - 300.0 * control).cwiseAbs().maxCoeff(), 1e-5);  // eight decimals
}

TEST_F(ToolAnalyses, BodiesAreReportedByTheirCentersOfMass) {
  write_motion(40);
  (void)run(
      "<AnalyzeTool name=\"a\"><model_file>arm.osim</model_file><results_directory>r"
      "</results_directory><initial_time>0</initial_time><final_time>0.3</final_time>"
      "<coordinates_file>motion.mot</coordinates_file><AnalysisSet><objects>"
      "<BodyKinematics name=\"BodyKinematics\"><bodies>all</bodies></BodyKinematics>"
      "</objects></AnalysisSet></AnalyzeTool>");
  const TimeSeries place = read("r/a_BodyKinematics_pos_global.sto");
  const TimeSeries speed = read("r/a_BodyKinematics_vel_global.sto");
  const std::string body = arm_.bodies.back().name;
  ASSERT_TRUE(place.find(body + "_Oz") && place.find("center_of_mass_X"));
  body::BodyState state = body::make_state(arm_);
  Eigen::VectorXd q = arm_.default_q();
  q[arm_.coordinate_index("elbow_flexion")] = elbow(12);
  body::compute_poses(arm_, q, state);
  const Vec3 center = state.X_GB.back() * arm_.bodies.back().p_BBcm_B;
  EXPECT_NEAR(place.column(body + "_X")[12], center.x(), 1e-8);
  EXPECT_NEAR(place.column(body + "_Y")[12], center.y(), 1e-8);
  // Speeds are the rates of the places: central differences over 20 ms of a slow swing.
  EXPECT_NEAR(speed.column(body + "_X")[12], (place.column(body + "_X")[13] - place.column(body + "_X")[11]) / 0.02,
              0.02);
  EXPECT_NEAR(speed.column(body + "_Oz")[12], (place.column(body + "_Oz")[13] - place.column(body + "_Oz")[11]) / 0.02,
              1.0);
}

// A muscle that is not left out pulls with its default activation at its default fiber length: the
// difference of the two runs is its moment.
TEST_F(ToolAnalyses, TheForceReporterHasWhatTheMuscleAnalysisHas) {
  write_motion(40);
  const ToolResult result =
      run("<AnalyzeTool name=\"a\"><model_file>arm.osim</model_file><initial_time>0</initial_time>"
          "<final_time>0.2</final_time><coordinates_file>motion.mot</coordinates_file>"
          "<solve_for_equilibrium_for_auxiliary_states>true"
          "</solve_for_equilibrium_for_auxiliary_states><AnalysisSet><objects>"
          "<ForceReporter name=\"f\"/><MuscleAnalysis name=\"m\"/></objects></AnalysisSet>"
          "</AnalyzeTool>");
  EXPECT_EQ(result.frames_failed, 0);
  const TimeSeries forces = read("a_f_forces.sto"), tendons = read("a_m_TendonForce.sto");
  ASSERT_EQ(forces.sample_count(), 21);
  ASSERT_EQ(forces.channel_count(), static_cast<Eigen::Index>(arm_.muscles.size()));
  for (const body::Muscle& muscle : arm_.muscles) {
    EXPECT_GT(forces.column(muscle.name).maxCoeff(), 0.0);
    EXPECT_EQ(forces.column(muscle.name), tendons.column(muscle.name));
  }
}

// A marker's place is that of its point, in ground and in another body.
TEST_F(ToolAnalyses, APointIsReportedWithItsVelocity) {
  write_motion(40);
  const body::Marker& marker = arm_.markers.back();
  const std::string body = arm_.bodies[static_cast<std::size_t>(marker.body)].name;
  const auto analysis = [&](const std::string& name, const std::string& relative) {
    return fmt::format(
        "<PointKinematics name=\"{}\"><body_name>{}</body_name><relative_to_body_name>{}"
        "</relative_to_body_name><point_name>p</point_name><point>{} {} {}</point>"
        "</PointKinematics>",
        name, body, relative, marker.p_BM[0], marker.p_BM[1], marker.p_BM[2]);
  };
  (void)run(
      "<AnalyzeTool name=\"a\"><model_file>arm.osim</model_file><initial_time>0</initial_time>"
      "<final_time>0.39</final_time><coordinates_file>motion.mot</coordinates_file>"
      "<AnalysisSet><objects>" +
      analysis("k", "ground") + analysis("own", body) + "</objects></AnalysisSet></AnalyzeTool>");
  const TimeSeries place = read("a_k_p_pos.sto"), speed = read("a_k_p_vel.sto");
  ASSERT_EQ(place.sample_count(), 40);
  body::BodyState state = body::make_state(arm_);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(arm_.coordinates.size()));
  for (int i = 0; i < 40; ++i) {
    q[arm_.coordinate_index("elbow_flexion")] = elbow(i);
    body::compute_poses(arm_, q, state);
    const Vec3 p = state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM;
    EXPECT_LT((place.values().row(i).transpose() - p).norm(), 2e-8);  // eight decimals
    if (i < 10 || i > 29) continue;
    // Differences over 0.02 s of a motion of 10 rad/s: 1e-4 of 1.5 m/s times (0.1)^2/6.
    const Eigen::RowVector3d rate = (place.values().row(i + 1) - place.values().row(i - 1)) / 0.02;
    EXPECT_LT((speed.values().row(i) - rate).norm(), 0.02);
  }
  const TimeSeries own = read("a_own_p_pos.sto");
  EXPECT_LT((own.values().rowwise() - marker.p_BM.transpose()).cwiseAbs().maxCoeff(), 2e-8);
}

TEST(Analyses, AreKnownByTheirClass) {
  EXPECT_TRUE(is_known_analysis("MuscleAnalysis"));
  EXPECT_FALSE(is_known_analysis("InducedAccelerations"));
}

/// A set-up with these analyses along motion.mot.
std::string analyses_of(const std::string& analyses) {
  return "<AnalyzeTool name=\"a\"><model_file>arm.osim</model_file><initial_time>0</initial_time>"
         "<final_time>0.3</final_time><coordinates_file>motion.mot</coordinates_file><AnalysisSet><objects>" +
         analyses + "</objects></AnalysisSet></AnalyzeTool>";
}

TEST_F(ToolAnalyses, AnUnknownAnalysisDoesNotStopTheOthers) {
  write_motion(40);
  const ToolResult result = run(analyses_of("<MyPlugin name=\"p\"/><Kinematics name=\"k\"/><MuscleAnalisis/>"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a_k_q.sto"));
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("MyPlugin")));
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("did you mean MuscleAnalysis")));
  // Nothing to run is an error, also for analyses of OpenSim itself.
  EXPECT_THROW((void)run(analyses_of("<MyPlugin/>")), ReadError);
  EXPECT_THROW((void)run(analyses_of("<StatesReporter/>")), ReadError);
}

// OpenSim assembles every row: a lock and a prescribed function hold, whatever the file says.
TEST_F(ToolAnalyses, LocksAndPrescribedFunctionsHold) {
  std::string text = body::arm4_osim();
  const auto in_coordinate = [&](const std::string& name, const std::string& what) {
    const auto at = text.find('>', text.find("Coordinate name=\"" + name + "\"")) + 1;
    text.insert(at, what);
  };
  const std::string locked = arm_.coordinates[0].name;
  in_coordinate(locked, "<locked>true</locked>");
  in_coordinate("elbow_flexion",
                "<prescribed>true</prescribed><prescribed_function><LinearFunction><coefficients>0.5 1"
                "</coefficients></LinearFunction></prescribed_function>");
  write("arm.osim", text);
  std::string motion = "motion\nnRows=30\nnColumns=3\ninDegrees=no\nendheader\ntime\t" + locked + "\telbow_flexion\n";
  for (int i = 0; i < 30; ++i) motion += fmt::format("{}\t{}\t{}\n", 0.01 * i, 0.2 + 0.01 * i, 2.0);
  write("motion.mot", motion);
  const ToolResult result = run(analyses_of("<Kinematics name=\"k\"><in_degrees>false</in_degrees></Kinematics>"));
  const TimeSeries q = read("a_k_q.sto");
  const double lock = arm_.coordinates[0].default_value;
  for (Eigen::Index i = 0; i < q.sample_count(); ++i) {
    EXPECT_NEAR(q.column(locked)[i], lock, 1e-7);
    EXPECT_NEAR(q.column("elbow_flexion")[i], 1.0 + 0.5 * q.time_s()[i], 1e-7);
  }
  EXPECT_THAT(sentences(result.remarks),
              ::testing::Contains(::testing::AllOf(::testing::HasSubstr("'" + locked + "' is locked"),
                                                   ::testing::HasSubstr("the model's values count"))));
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("'elbow_flexion' is prescribed")));
}

}  // namespace
}  // namespace myoid::opensim
