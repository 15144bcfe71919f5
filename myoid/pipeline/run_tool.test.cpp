#include "myoid/pipeline/run_tool.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/model/arm4.h"
#include "myoid/model/kinematic_tree.h"
#include "myoid/model/osim_reader.h"
#include "myoid/pipeline/analysis_reports.h"
#include "myoid/pipeline/marker_placer.h"
#include "myoid/pipeline/tool_stages.h"
#include "myoid/recording/storage_reader.h"

namespace myoid::pipeline {
namespace {

/// A folder with the built-in arm, markers of an elbow swing, and set-up files.
class RunTool : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("myoid_run_tool_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    arm_ = model::parse_osim(model::arm4_osim(), "arm4.osim");
    write("arm.osim", model::arm4_osim());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  ToolResult run(const std::string& setup) const {
    write("setup.xml", "<OpenSimDocument Version=\"40000\">" + setup + "</OpenSimDocument>");
    return run_tool(folder_ / "setup.xml");
  }
  static double elbow(int frame) { return 1.2 + 0.5 * std::sin(0.1 * frame); }

  void write_markers(int frames) const {
    std::string text = fmt::format(
        "PathFileType\t4\t(X/Y/Z)\tm.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
        "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t{0}\t{1}\tm\t100\t1\t{0}\n"
        "Frame#\tTime",
        frames, arm_.markers.size());
    std::string axes = "\t";
    for (std::size_t i = 0; i < arm_.markers.size(); ++i) {
      text += "\t" + arm_.markers[i].name + "\t\t";
      axes += fmt::format("\tX{0}\tY{0}\tZ{0}", i + 1);
    }
    text += "\n" + axes + "\n\n";
    model::BodyState state = model::make_state(arm_);
    Eigen::VectorXd q = arm_.default_q();
    for (int frame = 0; frame < frames; ++frame) {
      q[arm_.coordinate_index("elbow_flexion")] = elbow(frame);
      model::compute_poses(arm_, q, state);
      text += fmt::format("{}\t{}", frame + 1, 0.01 * frame);
      for (const model::Marker& marker : arm_.markers) {
        const Vec3 p = state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM;
        text += fmt::format("\t{}\t{}\t{}", p[0], p[1], p[2]);
      }
      text += "\n";
    }
    write("m.trc", text);
  }
  /// An actuator of 1 N m on every coordinate.
  [[nodiscard]] std::string reserves() const {
    std::string text;
    for (const model::Coordinate& c : arm_.coordinates) {
      text += "<CoordinateActuator name=\"" + c.name + "_reserve\"><coordinate>" + c.name +
              "</coordinate><optimal_force>1</optimal_force></CoordinateActuator>";
    }
    return text;
  }
  void write_motion(int frames) const {
    std::string text = fmt::format(
        "Coordinates\nversion=1\nnRows={}\nnColumns=2\ninDegrees=no\nendheader\ntime\telbow_"
        "flexion\n",
        frames);
    for (int i = 0; i < frames; ++i) text += fmt::format("{}\t{}\n", 0.01 * i, elbow(i));
    write("motion.mot", text);
  }
  TimeSeries read(const std::string& name) const {
    return recording::read_storage(folder_ / name).data;
  }

  std::filesystem::path folder_;
  model::BodyModel arm_;
};

TEST_F(RunTool, InverseKinematicsLeavesTheFilesOfTheTool) {
  write_markers(20);
  const ToolResult result =
      run("<InverseKinematicsTool name=\"swing\"><model_file>arm.osim</model_file>"
          "<results_directory>out</results_directory><marker_file>m.trc</marker_file>"
          "<report_marker_locations>true</report_marker_locations>"
          "<output_motion_file>out/ik.mot</output_motion_file></InverseKinematicsTool>");
  EXPECT_EQ(result.frames, 20);
  EXPECT_EQ(result.frames_failed, 0);
  for (const char* name :
       {"out/ik.mot", "out/swing_ik_marker_errors.sto", "out/swing_ik_model_marker_locations.sto"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  const TimeSeries q = read("out/ik.mot");
  for (int i = 0; i < 20; ++i)
    EXPECT_NEAR(q.column("elbow_flexion")[i], elbow(i) / kDegree, 1e-6);  // eight decimals
}

TEST_F(RunTool, InverseDynamicsNamesItsColumnsByTheKindOfMotion) {
  write_motion(60);
  const ToolResult result =
      run("<InverseDynamicsTool name=\"id\"><model_file>arm.osim</model_file>"
          "<forces_to_exclude>Muscles</forces_to_exclude><coordinates_file>motion.mot</"
          "coordinates_file>"
          "<output_gen_force_file>id.sto</output_gen_force_file></InverseDynamicsTool>");
  ASSERT_EQ(result.files.size(), 1U);
  EXPECT_EQ(read("id.sto").sample_count(), 60);
  EXPECT_TRUE(read("id.sto").find("elbow_flexion_moment"));
}

TEST_F(RunTool, ATimeRangeBeyondTheDataIsWhatThereIsAndSaid) {
  const auto says_so = ::testing::Contains(::testing::HasSubstr("asks for -5 to 99 s"));
  write_motion(60);
  const ToolResult id =
      run("<InverseDynamicsTool name=\"id\"><model_file>arm.osim</model_file>"
          "<forces_to_exclude>ALL</forces_to_exclude><time_range>-5 99</time_range>"
          "<coordinates_file>motion.mot</coordinates_file>"
          "<output_gen_force_file>id.sto</output_gen_force_file></InverseDynamicsTool>");
  EXPECT_EQ(read("id.sto").sample_count(), 60);
  EXPECT_THAT(id.notes, says_so);
  write_markers(20);
  const ToolResult ik =
      run("<InverseKinematicsTool><model_file>.\\arm.osim</model_file><time_range>-5 99"
          "</time_range><marker_file> m.trc </marker_file><output_motion_file>sub\\ik.mot"
          "</output_motion_file></InverseKinematicsTool>");
  EXPECT_EQ(ik.frames, 20);
  EXPECT_THAT(ik.notes, says_so);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "sub/ik.mot"));
}

// Where nothing was recorded in the range, the results of an earlier run stay.
TEST_F(RunTool, ATimeRangeOutsideOfTheDataIsRefusedAndNothingIsReplaced) {
  write_motion(60);
  write_markers(20);
  const auto tool = [](const std::string& kind, const std::string& content) {
    return "<" + kind + " name=\"t\"><model_file>arm.osim</model_file>" + content + "</" + kind +
           ">";
  };
  const std::string ik =
      "<marker_file>m.trc</marker_file><output_motion_file>result"
      "</output_motion_file><time_range>50 60</time_range>";
  const std::string id =
      "<coordinates_file>motion.mot</coordinates_file><output_gen_force_file>"
      "result</output_gen_force_file><time_range>50 60</time_range>"
      "<lowpass_cutoff_frequency_for_coordinates>6"
      "</lowpass_cutoff_frequency_for_coordinates>";
  // The filter makes the motion longer at both ends, 0.6 s to 0.885 s: that is nothing recorded.
  const std::string analyze =
      "<coordinates_file>motion.mot</coordinates_file><initial_time>0.7"
      "</initial_time><final_time>0.8</final_time>"
      "<lowpass_cutoff_frequency_for_coordinates>6"
      "</lowpass_cutoff_frequency_for_coordinates><AnalysisSet><objects>"
      "<Kinematics/></objects></AnalysisSet>";
  write("result", "earlier");
  write("t_Kinematics_q.sto", "earlier");
  for (const auto& [setup, recorded] :
       {std::pair{tool("InverseKinematicsTool", ik), "50 to 60 s, but"},
        std::pair{tool("InverseDynamicsTool", id), "holds 0 to 0.59 s"},
        std::pair{tool("AnalyzeTool", analyze), "0.7 to 0.8 s, but"}}) {
    try {
      (void)run(setup);
      ADD_FAILURE() << setup;
    } catch (const ReadError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(recorded));
    }
  }
  for (const char* name : {"result", "t_Kinematics_q.sto"}) {
    std::ifstream in(folder_ / name);
    std::string text;
    in >> text;
    EXPECT_EQ(text, "earlier") << name;
  }
}

// The shoulder has no marker task: what its coordinate tasks say from a file, it does.
TEST_F(RunTool, CoordinateTasksTakeTheirTargetsFromAFile) {
  write_markers(20);
  std::string motion =
      "Coordinates\nversion=1\nnRows=20\nnColumns=2\ninDegrees=yes\nendheader\ntime\t"
      "elbow_flexion\n";
  for (int i = 0; i < 20; ++i) motion += fmt::format("{}\t{}\n", 0.01 * i, 40.0 + 0.5 * i);
  write("wish.mot", motion);
  (void)run(
      "<InverseKinematicsTool><model_file>arm.osim</model_file><marker_file>m.trc</marker_file>"
      "<coordinate_file>wish.mot</coordinate_file><IKTaskSet><objects>"
      "<IKMarkerTask name=\"" +
      arm_.markers.back().name +
      "\"><apply>true</apply><weight>1e-9</weight></IKMarkerTask>"
      "<IKCoordinateTask name=\"elbow_flexion\"><apply>true</apply><weight>1000</weight>"
      "<value_type>from_file</value_type></IKCoordinateTask></objects></IKTaskSet>"
      "<output_motion_file>ik.mot</output_motion_file></InverseKinematicsTool>");
  const TimeSeries q = read("ik.mot");
  // The marker's pull, normalized, is of size 1 in J, the task's 1000 rad^-2.
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(q.column("elbow_flexion")[i], 40.0 + 0.5 * i, 0.1);
}

TEST_F(RunTool, AnalysesShareAMotion) {
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
  EXPECT_THAT(result.notes, ::testing::Contains(::testing::HasSubstr("InducedAccelerations")));
  for (const char* name :
       {"r/a_MuscleAnalysis_Length.sto", "r/a_MuscleAnalysis_MomentArm_elbow_flexion.sto",
        "r/a_StaticOptimization_activation.sto", "r/a_StaticOptimization_force.sto",
        "r/a_StaticOptimization_controls.xml", "r/a_Kinematics_q.sto", "r/a_Outputs.sto"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  const TimeSeries activation = read("r/a_StaticOptimization_activation.sto");
  EXPECT_EQ(activation.sample_count(), 21);
  EXPECT_EQ(activation.channel_count(),
            static_cast<Eigen::Index>(arm_.muscles.size() + arm_.coordinates.size()));
  EXPECT_EQ(result.frames_failed, 0) << result.summary;
  const Eigen::VectorXd length = read("r/a_MuscleAnalysis_Length.sto").column(arm_.muscles[0].name);
  EXPECT_LT((length - read("r/a_Outputs.sto").values().col(0)).cwiseAbs().maxCoeff(), 1e-8);
}

// Static optimization's forces make the motion's accelerations: gravity and inertia of everything
// are carried by the joint to ground, the arm's weight and what accelerates it by the shoulder.
TEST_F(RunTool, JointReactionCarriesWhatForcesOfStaticOptimizationMake) {
  write_motion(40);
  std::string reserves = "<OpenSimDocument Version=\"40000\"><ForceSet><objects>";
  for (const model::Coordinate& c : arm_.coordinates) {
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
  const ToolResult result = run(tool(
      "<JointReaction name=\"jr\"><forces_file>a_so_force.sto</forces_file><joint_names>All"
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
  for (const model::Body& body : arm_.bodies) mass_kg += body.mass_kg;
  const auto momentum_center = [&](double frame) {
    Eigen::VectorXd q = arm_.default_q();
    q.setZero();
    q[arm_.coordinate_index("elbow_flexion")] = 1.2 + 0.5 * std::sin(0.1 * frame);
    model::BodyState state = model::make_state(arm_);
    model::compute_poses(arm_, q, state);
    Vec3 sum = Vec3::Zero();
    for (std::size_t b = 1; b < arm_.bodies.size(); ++b)
      sum += arm_.bodies[b].mass_kg * (state.X_GB[b] * arm_.bodies[b].p_BBcm_B);
    return sum;
  };
  for (Eigen::Index i = 5; i < 16; ++i) {
    const double frame = static_cast<double>(i) + 10.0;
    const Vec3 inertia = (momentum_center(frame + 0.1) - 2.0 * momentum_center(frame) +
                          momentum_center(frame - 0.1)) /
                         (0.001 * 0.001);
    const Vec3 expected = inertia - mass_kg * arm_.gravity_G;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const std::string column =
          arm_.joints[0].name + "_on_" + arm_.bodies[1].name + "_in_ground_f" + "xyz"[k];
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
TEST_F(RunTool, PathActuatorsShareTheLoad) {
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

TEST_F(RunTool, BodiesAreReportedByTheirCentersOfMass) {
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
  model::BodyState state = model::make_state(arm_);
  Eigen::VectorXd q = arm_.default_q();
  q[arm_.coordinate_index("elbow_flexion")] = elbow(12);
  model::compute_poses(arm_, q, state);
  const Vec3 center = state.X_GB.back() * arm_.bodies.back().p_BBcm_B;
  EXPECT_NEAR(place.column(body + "_X")[12], center.x(), 1e-8);
  EXPECT_NEAR(place.column(body + "_Y")[12], center.y(), 1e-8);
  // Speeds are the rates of the places: central differences over 20 ms of a slow swing.
  EXPECT_NEAR(speed.column(body + "_X")[12],
              (place.column(body + "_X")[13] - place.column(body + "_X")[11]) / 0.02, 0.02);
  EXPECT_NEAR(speed.column(body + "_Oz")[12],
              (place.column(body + "_Oz")[13] - place.column(body + "_Oz")[11]) / 0.02, 1.0);
}

// A muscle that is not left out pulls with its default activation at its default fiber length: the
// difference of the two runs is its moment.
TEST_F(RunTool, TheForceReporterHasWhatTheMuscleAnalysisHas) {
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
  for (const model::Muscle& muscle : arm_.muscles) {
    EXPECT_GT(forces.column(muscle.name).maxCoeff(), 0.0);
    EXPECT_EQ(forces.column(muscle.name), tendons.column(muscle.name));
  }
}

// A marker's place is that of its point, in ground and in another body.
TEST_F(RunTool, APointIsReportedWithItsVelocity) {
  write_motion(40);
  const model::Marker& marker = arm_.markers.back();
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
  model::BodyState state = model::make_state(arm_);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(arm_.coordinates.size()));
  for (int i = 0; i < 40; ++i) {
    q[arm_.coordinate_index("elbow_flexion")] = elbow(i);
    model::compute_poses(arm_, q, state);
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

TEST_F(RunTool, MusclesThatAreNotExcludedCountInInverseDynamics) {
  write_motion(60);
  const auto torque = [&](const std::string& excluded) {
    (void)run("<InverseDynamicsTool><model_file>arm.osim</model_file><forces_to_exclude>" +
              excluded +
              "</forces_to_exclude><coordinates_file>motion.mot</coordinates_file>"
              "<output_gen_force_file>id.sto</output_gen_force_file></InverseDynamicsTool>");
    return read("id.sto").column("elbow_flexion_moment");
  };
  std::string others;
  for (std::size_t m = 1; m < arm_.muscles.size(); ++m) others += arm_.muscles[m].name + " ";
  const Eigen::VectorXd difference = torque("Muscles") - torque(others);
  (void)run(
      "<AnalyzeTool name=\"a\"><model_file>arm.osim</model_file><final_time>0.59</final_time>"
      "<coordinates_file>motion.mot</coordinates_file><AnalysisSet><objects>"
      "<MuscleAnalysis name=\"MuscleAnalysis\"/></objects></AnalysisSet></AnalyzeTool>");
  const Eigen::VectorXd moment =
      read("a_MuscleAnalysis_Moment_elbow_flexion.sto").column(arm_.muscles[0].name);
  EXPECT_GT(moment.cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LT((difference - moment).cwiseAbs().maxCoeff(), 1e-7);  // eight decimals
}

// Task sets in files of their own, with Windows separators; names with blanks around them.
TEST_F(RunTool, TasksMayStandInAFileOfTheirOwn) {
  write_markers(10);
  std::filesystem::create_directories(folder_ / "tasks");
  std::string tasks = "<OpenSimDocument Version=\"20302\"><IKTaskSet><objects>";
  for (const model::Marker& marker : arm_.markers)
    tasks += "<IKMarkerTask name=\"" + marker.name + "\"><weight>5</weight></IKMarkerTask>";
  write("tasks/t.xml", tasks + "</objects></IKTaskSet></OpenSimDocument>");
  const ToolResult result =
      run("<InverseKinematicsTool><model_file> arm.osim </model_file><IKTaskSet "
          "file=\"tasks\\t.xml\"/><marker_file>\n  m.trc\t</marker_file>"
          "<output_motion_file>ik.mot</output_motion_file></InverseKinematicsTool>");
  EXPECT_EQ(result.frames, 10);
  EXPECT_NEAR(read("ik.mot").column("elbow_flexion")[5], elbow(5) / kDegree, 1e-6);
}

TEST_F(RunTool, MarkersFarFromTheModelsAreSaidSo) {
  write_markers(10);
  std::string text;
  {
    std::ifstream in(folder_ / "m.trc");
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  // The values stay, the header says millimeters.
  text.replace(text.find("\tm\t100"), 7, "\tmm\t100");
  write("m.trc", text);
  const ToolResult result =
      run("<InverseKinematicsTool><model_file>arm.osim</model_file><marker_file>m.trc"
          "</marker_file><output_motion_file>ik.mot</output_motion_file></InverseKinematicsTool>");
  EXPECT_THAT(result.notes, ::testing::Contains(::testing::HasSubstr("times as far apart")));
}

TEST_F(RunTool, ScalingByHandMakesALargerModelOfTheGivenMass) {
  const ToolResult result =
      run("<ScaleTool "
          "name=\"someone\"><mass>10</mass><GenericModelMaker><model_file>arm.osim</model_file>"
          "</GenericModelMaker><ModelScaler><scaling_order>manualScale</"
          "scaling_order><ScaleSet><objects>"
          "<Scale><scales>1.1 1.1 1.1</scales><segment>" +
          arm_.bodies.back().name +
          "</segment></Scale></objects></ScaleSet><preserve_mass_distribution>true</"
          "preserve_mass_distribution>"
          "<output_model_file>scaled.osim</output_model_file><output_scale_file>factors.xml</"
          "output_scale_file>"
          "</ModelScaler><MarkerPlacer><apply>false</apply></MarkerPlacer></ScaleTool>");
  const model::BodyModel scaled = model::read_osim(folder_ / "scaled.osim");
  double mass = 0.0;
  for (const model::Body& body : scaled.bodies) mass += body.mass_kg;
  EXPECT_NEAR(mass, 10.0, 1e-12);
  EXPECT_EQ(scaled.name, "someone");
  EXPECT_LT((scaled.bodies.back().p_BBcm_B - 1.1 * arm_.bodies.back().p_BBcm_B).norm(), 1e-15);
  EXPECT_EQ(result.files.size(), 2U);
}

TEST_F(RunTool, AStaticPoseAtTheEndOfARangeIsSaidSo) {
  write_markers(5);  // the elbow at 69 degrees and more
  const auto placed_with_range = [&](const std::string& range) {
    std::string text = model::arm4_osim();
    const auto at = text.find("<range>", text.find("Coordinate name=\"elbow_flexion\"")) + 7;
    text.replace(at, text.find('<', at) - at, range);
    write("arm.osim", text);
    std::string tasks;
    for (const model::Marker& marker : arm_.markers)
      tasks += "<IKMarkerTask name=\"" + marker.name + "\"><weight>1</weight></IKMarkerTask>";
    return run("<ScaleTool name=\"s\"><GenericModelMaker><model_file>arm.osim</model_file>"
               "</GenericModelMaker><ModelScaler><apply>false</apply></ModelScaler><MarkerPlacer>"
               "<IKTaskSet><objects>" +
               tasks +
               "</objects></IKTaskSet><marker_file>m.trc"
               "</marker_file><output_model_file>placed.osim</output_model_file></MarkerPlacer>"
               "</ScaleTool>")
        .notes;
  };
  const auto said =
      ::testing::Contains(::testing::HasSubstr("'elbow_flexion' at its limit of 57.3 degrees"));
  EXPECT_THAT(placed_with_range("0 1"), said);
  std::filesystem::remove(folder_ / "placed.osim");
  EXPECT_THAT(placed_with_range("0 2"), ::testing::Not(said));
}

TEST(FramesIn, AreThoseOfTheRangeOrAll) {
  recording::MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(11, 0.0, 1.0);
  markers.positions_m.resize(11, 0);
  using Frames = std::pair<Eigen::Index, Eigen::Index>;
  EXPECT_EQ(frames_in(markers, {0.2, 0.5}), Frames(2, 5));
  EXPECT_EQ(frames_in(markers, {-1.0, -1.0}), Frames(0, 10)) << "before all of them";
  EXPECT_EQ(frames_in(markers, {0.3, 7.0}), Frames(3, 10));
}

TEST_F(RunTool, AStaticPoseStaysOffTheEndOfARangeWhereOpenSimsSearchHasABarrier) {
  write_markers(5);  // the elbow at 69 degrees and more
  std::string text = model::arm4_osim();
  const auto change = [&](const std::string& coordinate, const char* tag, const std::string& to) {
    const std::string open = std::string("<") + tag + ">";
    const auto at =
        text.find(open, text.find("Coordinate name=\"" + coordinate + "\"")) + open.size();
    text.replace(at, text.find('<', at) - at, to);
  };
  change("elbow_flexion", "range", "0 1");
  const auto lock_others = [&](const std::string& value) {
    for (const model::Coordinate& c : arm_.coordinates)
      if (c.name != "elbow_flexion") change(c.name, "locked", value);
  };
  std::string tasks;
  for (const model::Marker& marker : arm_.markers)
    tasks += "<IKMarkerTask name=\"" + marker.name + "\"><weight>1</weight></IKMarkerTask>";
  const auto elbow_at = [&] {
    write("arm.osim", text);
    std::filesystem::remove(folder_ / "pose.mot");
    (void)run(
        "<ScaleTool name=\"s\"><GenericModelMaker><model_file>arm.osim</model_file>"
        "</GenericModelMaker><ModelScaler><apply>false</apply></ModelScaler><MarkerPlacer>"
        "<IKTaskSet><objects>" +
        tasks +
        "</objects></IKTaskSet><marker_file>m.trc</marker_file>"
        "<output_motion_file>pose.mot</output_motion_file></MarkerPlacer></ScaleTool>");
    const TimeSeries pose = read("pose.mot");
    for (const Channel& channel : pose.channels())
      if (channel.name.ends_with("elbow_flexion/value")) return pose.column(channel.name)[0];
    return -1.0;
  };
  // Without constraints OpenSim searches without a barrier; a locked coordinate is a constraint.
  lock_others("false");
  EXPECT_EQ(elbow_at(), 1.0);
  lock_others("true");
  const double inside = elbow_at();
  EXPECT_LT(inside, 1.0 - 1e-6);
  EXPECT_GT(inside, 0.9);
}

TEST_F(RunTool, AStaticPoseSaysWhatNoMarkerDetermines) {
  write_markers(5);
  // Only the markers that the elbow does not move count.
  std::string tasks, forearm;
  const auto elbow = static_cast<std::size_t>(arm_.coordinate_index("elbow_flexion"));
  const int child = arm_.joints[static_cast<std::size_t>(arm_.coordinates[elbow].joint)].child;
  for (const model::Marker& marker : arm_.markers) {
    if (marker.body == child) {
      forearm = marker.name;
    } else {
      tasks += "<IKMarkerTask name=\"" + marker.name + "\"><weight>1</weight></IKMarkerTask>";
    }
  }
  const ToolResult result =
      run("<ScaleTool name=\"s\"><GenericModelMaker><model_file>arm.osim</model_file>"
          "</GenericModelMaker><ModelScaler><apply>false</apply></ModelScaler><MarkerPlacer>"
          "<IKTaskSet><objects>" +
          tasks +
          "</objects></IKTaskSet><marker_file>m.trc</marker_file><output_model_file>placed.osim"
          "</output_model_file></MarkerPlacer></ScaleTool>");
  EXPECT_THAT(result.notes,
              ::testing::Contains(::testing::AllOf(::testing::HasSubstr("determines"),
                                                   ::testing::HasSubstr("elbow_flexion"),
                                                   ::testing::HasSubstr(forearm))));
}

TEST_F(RunTool, ASetUpWithoutItsFilesIsRefusedBeforeAnythingIsWritten) {
  EXPECT_THROW((void)run("<InverseKinematicsTool name=\"x\"><model_file>none.osim</model_file>"
                         "<marker_file>m.trc</marker_file></InverseKinematicsTool>"),
               InvalidInput);
  EXPECT_THROW((void)run("<AnalyzeTool name=\"x\"><model_file>arm.osim</model_file></AnalyzeTool>"),
               InvalidInput);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 2);  // the model and the set-up
}

TEST(Analyses, AreKnownByTheirClass) {
  EXPECT_TRUE(is_known_analysis("MuscleAnalysis"));
  EXPECT_FALSE(is_known_analysis("InducedAccelerations"));
}

}  // namespace
}  // namespace myoid::pipeline
