#include "myoid/opensim/run_tool.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/tool_folder.h"

namespace myoid::opensim {
namespace {

using RunTool = test::ToolFolder;

TEST_F(RunTool, InverseKinematicsLeavesTheFilesOfTheTool) {
  write_markers(20);
  const ToolResult result =
      run("<InverseKinematicsTool name=\"swing\"><model_file>arm.osim</model_file>"
          "<results_directory>out</results_directory><marker_file>m.trc</marker_file>"
          "<report_marker_locations>true</report_marker_locations>"
          "<output_motion_file>out/ik.mot</output_motion_file></InverseKinematicsTool>");
  EXPECT_EQ(result.frames, 20);
  EXPECT_EQ(result.frames_failed, 0);
  for (const char* name : {"out/ik.mot", "out/swing_ik_marker_errors.sto", "out/swing_ik_model_marker_locations.sto"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  const TimeSeries q = read("out/ik.mot");
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(q.column("elbow_flexion")[i], elbow(i) / kDegree, 1e-6);  // eight decimals
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
  EXPECT_THAT(sentences(id.remarks), says_so);
  write_markers(20);
  const ToolResult ik =
      run("<InverseKinematicsTool><model_file>.\\arm.osim</model_file><time_range>-5 99"
          "</time_range><marker_file> m.trc </marker_file><output_motion_file>sub\\ik.mot"
          "</output_motion_file></InverseKinematicsTool>");
  EXPECT_EQ(ik.frames, 20);
  EXPECT_THAT(sentences(ik.remarks), says_so);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "sub/ik.mot"));
}

// Where nothing was recorded in the range, the results of an earlier run stay.
TEST_F(RunTool, ATimeRangeOutsideOfTheDataIsRefusedAndNothingIsWritten) {
  write_motion(60);
  write_markers(20);
  const auto tool = [](const std::string& kind, const std::string& content) {
    return "<" + kind + " name=\"t\"><model_file>arm.osim</model_file>" + content + "</" + kind + ">";
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
  for (const auto& [setup, recorded] : {std::pair{tool("InverseKinematicsTool", ik), "50 to 60 s, but"},
                                        std::pair{tool("InverseDynamicsTool", id), "holds 0 to 0.59 s"},
                                        std::pair{tool("AnalyzeTool", analyze), "0.7 to 0.8 s, but"}}) {
    try {
      (void)run(setup);
      ADD_FAILURE() << setup;
    } catch (const ReadError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(recorded));
    }
  }
  for (const char* name : {"result", "t_Kinematics_q.sto"})
    EXPECT_FALSE(std::filesystem::exists(folder_ / name)) << name;
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

TEST_F(RunTool, MusclesThatAreNotExcludedCountInInverseDynamics) {
  write_motion(60);
  const auto torque = [&](const std::string& excluded) {
    (void)run("<InverseDynamicsTool><model_file>arm.osim</model_file><forces_to_exclude>" + excluded +
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
  const Eigen::VectorXd moment = read("a_MuscleAnalysis_Moment_elbow_flexion.sto").column(arm_.muscles[0].name);
  EXPECT_GT(moment.cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LT((difference - moment).cwiseAbs().maxCoeff(), 1e-7);  // eight decimals
}

// Task sets in files of their own, with Windows separators; names with blanks around them.
TEST_F(RunTool, TasksMayStandInAFileOfTheirOwn) {
  write_markers(10);
  std::filesystem::create_directories(folder_ / "tasks");
  std::string tasks = "<OpenSimDocument Version=\"20302\"><IKTaskSet><objects>";
  for (const body::Marker& marker : arm_.markers)
    tasks += "<IKMarkerTask name=\"" + marker.name + "\"><weight>5</weight></IKMarkerTask>";
  write("tasks/t.xml", tasks + "</objects></IKTaskSet></OpenSimDocument>");
  const ToolResult result =
      run("<InverseKinematicsTool><model_file> arm.osim </model_file><IKTaskSet "
          "file=\"tasks\\t.xml\"/><marker_file>\n  m.trc\t</marker_file>"
          "<output_motion_file>ik.mot</output_motion_file></InverseKinematicsTool>");
  EXPECT_EQ(result.frames, 10);
  EXPECT_NEAR(read("ik.mot").column("elbow_flexion")[5], elbow(5) / kDegree, 1e-6);
}

TEST_F(RunTool, ASetUpWithoutItsFilesIsRefusedBeforeAnythingIsWritten) {
  EXPECT_THROW((void)run("<InverseKinematicsTool name=\"x\"><model_file>none.osim</model_file>"
                         "<marker_file>m.trc</marker_file></InverseKinematicsTool>"),
               InvalidInput);
  EXPECT_THROW((void)run("<AnalyzeTool name=\"x\"><model_file>arm.osim</model_file></AnalyzeTool>"), InvalidInput);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) files += entry.is_regular_file();
  EXPECT_EQ(files, 2);  // the model and the set-up
}

}  // namespace
}  // namespace myoid::opensim
