#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/opensim/opensim_setup.h"

#include "tests/support/tool_folder.h"

namespace myoid::opensim {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// Set-ups as MATLAB and Python write them on another computer: no model, absolute paths of
/// Windows. study/model.osim, study/ik.mot ... and the set-ups in study/setups, which MATLAB wrote
/// for C:\Users\jane\study; native ones beside them, with names that hold here.
class ForeignSetups : public test::ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    write_motion(60);
    write_markers(20);
    fs::create_directories(folder_ / "setups");
    write("setups/loads.mot",
          "loads\nversion=1\nnRows=2\nnColumns=7\ninDegrees=no\nendheader\n"
          "time\tf_vx\tf_vy\tf_vz\tf_px\tf_py\tf_pz\n0\t1\t2\t3\t0\t0\t0\n1\t2\t3\t4\t0\t0.1\t0\n");
    write("setups/reserves.xml", "<OpenSimDocument Version=\"40000\"><ForceSet><objects>" + reserves() +
                                     "</objects></ForceSet></OpenSimDocument>");
    for (const bool foreign : {true, false}) {
      write(foreign ? "setups/loads.xml" : "setups/native_loads.xml",
            "<OpenSimDocument Version=\"40000\"><ExternalLoads><objects><ExternalForce name=\"f\">"
            "<applied_to_body>" +
                arm_.bodies.back().name +
                "</applied_to_body><force_expressed_in_body>ground</force_expressed_in_body>"
                "<point_expressed_in_body>ground</point_expressed_in_body><force_identifier>f_v"
                "</force_identifier><point_identifier>f_p</point_identifier></ExternalForce>"
                "</objects><datafile>" +
                (foreign ? "C:\\Users\\jane\\study\\setups\\loads.mot" : "loads.mot") +
                "</datafile></ExternalLoads></OpenSimDocument>");
    }
  }
  /// A set-up of the tool; @NAME@ stands for a file, @OUT@ for the results' folder.
  [[nodiscard]] ToolResult run_as(bool foreign, std::string setup, const SetupFiles& files) const {
    const auto replace = [&](const std::string& what, const std::string& by) {
      for (auto at = setup.find(what); at != std::string::npos; at = setup.find(what, at))
        setup.replace(at, what.size(), by);
    };
    replace("@MODEL@", foreign ? "" : "../arm.osim");
    for (const char* name : {"motion.mot", "m.trc"})
      replace(std::string("@") + name + "@",
              foreign ? std::string("C:\\Users\\jane\\study\\") + name : std::string("../") + name);
    replace("@loads@", foreign ? "C:\\Users/jane\\study\\setups\\loads.xml" : "native_loads.xml");
    replace("@reserves@", foreign ? "\\\\server\\jane\\setups\\reserves.xml" : "reserves.xml");
    replace("@OUT@", foreign ? "C:\\Users\\jane\\study\\Results" : "out");
    const std::string name = foreign ? "setups/foreign.xml" : "setups/native.xml";
    write(name, "<OpenSimDocument Version=\"40000\">" + setup + "</OpenSimDocument>");
    return run_tool(folder_ / name, {.files = files});
  }
  [[nodiscard]] std::string text_of(const fs::path& path) const {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Runs both; every result of the native set-up lies beside the foreign one, byte for byte.
  void expect_same_results(const std::string& setup, std::size_t count) const {
    const ToolResult native = run_as(false, setup, {});
    const ToolResult foreign = run_as(true, setup, {.model = folder_ / "arm.osim"});
    ASSERT_EQ(native.files.size(), count);
    ASSERT_EQ(foreign.files.size(), count);
    for (const fs::path& file : native.files) {
      const fs::path beside = folder_ / "setups" / file.filename();
      ASSERT_TRUE(fs::exists(beside)) << beside;
      EXPECT_EQ(text_of(beside), text_of(file)) << file;
    }
    EXPECT_THAT(sentences(foreign.remarks), Contains(HasSubstr("is not on this computer")));
    EXPECT_THAT(sentences(native.remarks), ::testing::Not(Contains(HasSubstr("is not on this computer"))));
  }
};

TEST_F(ForeignSetups, InverseKinematics) {
  expect_same_results(
      "<InverseKinematicsTool name=\"t\"><model_file>@MODEL@</model_file><results_directory>@OUT@"
      "</results_directory><marker_file>@m.trc@</marker_file><output_motion_file>@OUT@\\ik.mot"
      "</output_motion_file></InverseKinematicsTool>",
      2);
}

TEST_F(ForeignSetups, InverseDynamics) {
  expect_same_results(
      "<InverseDynamicsTool name=\"t\"><results_directory>@OUT@</results_directory><model_file>"
      "@MODEL@</model_file><forces_to_exclude>Muscles</forces_to_exclude><external_loads_file>"
      "@loads@</external_loads_file><coordinates_file>@motion.mot@</coordinates_file>"
      "<output_gen_force_file>id.sto</output_gen_force_file></InverseDynamicsTool>",
      1);
}

TEST_F(ForeignSetups, StaticOptimizationAndMuscleAnalysis) {
  expect_same_results(
      "<AnalyzeTool name=\"t\"><model_file>@MODEL@</model_file><force_set_files>@reserves@"
      "</force_set_files><results_directory>@OUT@</results_directory><final_time>0.2</final_time>"
      "<external_loads_file>@loads@</external_loads_file><coordinates_file>@motion.mot@"
      "</coordinates_file><AnalysisSet><objects><StaticOptimization name=\"StaticOptimization\"/>"
      "<MuscleAnalysis name=\"MuscleAnalysis\"><moment_arm_coordinate_list>elbow_flexion"
      "</moment_arm_coordinate_list></MuscleAnalysis></objects></AnalysisSet></AnalyzeTool>",
      3 + 18 + 2);
}

TEST_F(ForeignSetups, Scale) {
  expect_same_results(
      "<ScaleTool name=\"t\"><mass>10</mass><GenericModelMaker><model_file>@MODEL@</model_file>"
      "<marker_set_file>Unassigned</marker_set_file></GenericModelMaker><ModelScaler>"
      "<scaling_order>manualScale</scaling_order><marker_file>@m.trc@</marker_file>"
      "<output_model_file>@OUT@\\scaled.osim</output_model_file></ModelScaler><MarkerPlacer>"
      "<marker_file>@m.trc@</marker_file><output_motion_file>@OUT@\\pose.mot</output_motion_file>"
      "</MarkerPlacer></ScaleTool>",
      2);
}

TEST_F(ForeignSetups, FilesOfTheCommandLineStandInForTheSetUps) {
  fs::create_directories(folder_ / "elsewhere");
  fs::rename(folder_ / "motion.mot", folder_ / "elsewhere/other.mot");
  const std::string setup =
      "<InverseDynamicsTool name=\"t\"><model_file>Unassigned</model_file><forces_to_exclude>"
      "Muscles</forces_to_exclude><coordinates_file>@motion.mot@</coordinates_file>"
      "<output_gen_force_file>sub\\id</output_gen_force_file></InverseDynamicsTool>";
  const ToolResult result = run_as(true, setup,
                                   {.model = folder_ / "arm.osim",
                                    .motion = folder_ / "elsewhere/other.mot",
                                    .external_loads = folder_ / "setups/native_loads.xml",
                                    .out = folder_ / "results"});
  // As in OpenSim: a folder in the name does not count, the extension is .sto.
  EXPECT_EQ(result.files, std::vector{folder_ / "results/id.sto"});
  EXPECT_THAT(sentences(result.remarks), Contains(HasSubstr("only the name of the file counts")));
  EXPECT_EQ(read("results/id.sto").sample_count(), 60);
  EXPECT_THROW((void)run_as(true, "<InverseKinematicsTool/>", {.external_loads = folder_ / "setups/native_loads.xml"}),
               InvalidInput);
}

TEST_F(ForeignSetups, AnAbsentFileNamesTheElementThatAskedForIt) {
  const auto message = [&](const std::string& setup) -> std::string {
    try {
      (void)run_as(true, setup, {.model = folder_ / "arm.osim"});
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string absent = message(
      "<AnalyzeTool name=\"t\"><model_file/>\n<coordinates_file>C:\\jane\\none.mot"
      "</coordinates_file><AnalysisSet><objects><Kinematics/></objects></AnalysisSet>"
      "</AnalyzeTool>");
  EXPECT_THAT(absent, HasSubstr("foreign.xml:2: <coordinates_file> names 'C:\\jane\\none.mot'"));
  EXPECT_THAT(message("<AnalyzeTool name=\"t\"><coordinates_file>@motion.mot@</coordinates_file>"
                      "<AnalysisSet><objects><Kinematcs/></objects></AnalysisSet></AnalyzeTool>"),
              HasSubstr("did you mean Kinematics?"));
}

TEST_F(ForeignSetups, DegreesLabelledRadiansAreRefused) {
  std::string motion = text_of(folder_ / "motion.mot");
  motion = motion.substr(0, motion.find("endheader") + 10) + "time\telbow_flexion\n";
  for (int i = 0; i < 60; ++i) motion += fmt::format("{}\t{}\n", 0.01 * i, elbow(i) / kDegree);
  write("motion.mot", motion);
  EXPECT_THROW((void)run("<InverseDynamicsTool><model_file>arm.osim</model_file><coordinates_file>motion.mot"
                         "</coordinates_file></InverseDynamicsTool>"),
               ReadError);
}

TEST_F(ForeignSetups, TasksOfMarkersThatAreNamedOtherwiseAreNamed) {
  std::string tasks;
  for (const body::Marker& marker : arm_.markers) tasks += "<IKMarkerTask name=\"" + marker.name + "\"/>";
  std::string recorded = text_of(folder_ / "m.trc");
  const std::string& renamed = arm_.markers[0].name;
  recorded.replace(recorded.find("\t" + renamed + "\t") + 1, renamed.size(), "subject:" + renamed);
  write("m.trc", recorded);
  const ToolResult result = run("<InverseKinematicsTool><model_file>arm.osim</model_file><IKTaskSet><objects>" + tasks +
                                "</objects></IKTaskSet><marker_file>m.trc</marker_file><output_motion_file>ik.mot"
                                "</output_motion_file></InverseKinematicsTool>");
  EXPECT_THAT(sentences(result.remarks), Contains(HasSubstr("is it 'subject:" + renamed + "' there?")));
}

TEST_F(ForeignSetups, AResultNeverReplacesTheModelThatIsScaled) {
  const std::string setup =
      "<ScaleTool name=\"t\"><GenericModelMaker><model_file>arm.osim</model_file>"
      "</GenericModelMaker><ModelScaler><scaling_order>manualScale</scaling_order><ScaleSet>"
      "<objects><Scale><scales>1.1 1.1 1.1</scales><segment>" +
      arm_.bodies.back().name +
      "</segment></Scale></objects></ScaleSet><output_model_file>arm.osim</output_model_file>"
      "</ModelScaler><MarkerPlacer><apply>false</apply></MarkerPlacer></ScaleTool>";
  EXPECT_THROW((void)run(setup), InvalidInput);
  EXPECT_EQ(text_of(folder_ / "arm.osim"), body::arm4_osim());
  (void)run_tool(folder_ / "setup.xml", {.files = {.out = folder_ / "scaled"}});
  const body::BodyModel scaled = body::read_osim(folder_ / "scaled/arm.osim");
  EXPECT_LT((scaled.bodies.back().p_BBcm_B - 1.1 * arm_.bodies.back().p_BBcm_B).norm(), 1e-15);
  EXPECT_EQ(text_of(folder_ / "arm.osim"), body::arm4_osim());
}

/// An inverse kinematics whose motion goes to this file.
std::string ik_to(const std::string& motion) {
  return "<InverseKinematicsTool name=\"t\"><model_file>arm.osim</model_file><marker_file>m.trc</marker_file>"
         "<report_errors>false</report_errors><output_motion_file>" +
         motion + "</output_motion_file></InverseKinematicsTool>";
}

TEST_F(ForeignSetups, AResultReplacesOnlyAResult) {
  write_markers(2);
  (void)run(ik_to("ik.mot"));
  EXPECT_EQ(run(ik_to("ik.mot")).replaced, 1) << "the list of the folder names it";
  // OpenSim's own result has the same title; a force table and a text have another.
  write_motion(3);
  EXPECT_EQ(run(ik_to("motion.mot")).replaced, 1);
  for (const std::string text : {"ground_forces\nversion=1\nendheader\ntime\tfx\n0\t1\n", "precious"}) {
    write("thesis.docx", text);
    EXPECT_THROW((void)run(ik_to("thesis.docx")), InvalidInput);
    EXPECT_EQ(text_of(folder_ / "thesis.docx"), text);
  }
}

TEST_F(ForeignSetups, AModelReplacesAModelOfTheSameNameAlone) {
  const std::string setup =
      "<ScaleTool name=\"t\"><GenericModelMaker><model_file>arm.osim</model_file>"
      "</GenericModelMaker><ModelScaler><scaling_order>manualScale</scaling_order><output_model_file>scaled.osim"
      "</output_model_file></ModelScaler><MarkerPlacer><apply>false</apply></MarkerPlacer></ScaleTool>";
  std::string theirs = body::arm4_osim();
  write("scaled.osim", theirs);
  EXPECT_THROW((void)run(setup), InvalidInput);
  EXPECT_EQ(text_of(folder_ / "scaled.osim"), theirs);
  const std::string name = body::parse_osim(theirs, "arm.osim").name;
  theirs.replace(theirs.find("\"" + name + "\"") + 1, name.size(), "t");
  write("scaled.osim", theirs);
  EXPECT_EQ(run(setup).replaced, 1);
}

TEST_F(ForeignSetups, AResultOutsideTheFolderOfTheSetupIsAskedFor) {
  write_markers(2);
  std::filesystem::create_directories(folder_ / "inner");
  for (const char* file : {"arm.osim", "m.trc"}) std::filesystem::copy_file(folder_ / file, folder_ / "inner" / file);
  for (const std::string& motion : {std::string("../ik.mot"), (folder_ / "ik.mot").string()}) {
    write("inner/setup.xml", "<OpenSimDocument Version=\"40000\">" + ik_to(motion) + "</OpenSimDocument>");
    EXPECT_THROW((void)run_tool(folder_ / "inner/setup.xml"), InvalidInput) << motion;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "ik.mot"));
    (void)run_tool(folder_ / "inner/setup.xml", {.files = {.out = folder_ / "out"}});
    (void)run_tool(folder_ / "inner/setup.xml", {.anywhere = true});
    EXPECT_TRUE(std::filesystem::remove(folder_ / "ik.mot"));
  }
}

}  // namespace
}  // namespace myoid::opensim
