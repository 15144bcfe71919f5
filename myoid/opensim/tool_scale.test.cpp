#include <map>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/opensim/marker_placer.h"
#include "myoid/opensim/tool_stages.h"

#include "tests/support/data_folder.h"
#include "tests/support/tool_folder.h"

namespace myoid::opensim {
namespace {

using ToolScale = test::ToolFolder;

TEST_F(ToolScale, MarkersFarFromTheModelsAreSaidSo) {
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
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("times as far apart")));
}

TEST_F(ToolScale, ScalingByHandMakesALargerModelOfTheGivenMass) {
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
  const body::BodyModel scaled = body::read_osim(folder_ / "scaled.osim");
  double mass = 0.0;
  for (const body::Body& body : scaled.bodies) mass += body.mass_kg;
  EXPECT_NEAR(mass, 10.0, 1e-12);
  EXPECT_EQ(scaled.name, "someone");
  EXPECT_LT((scaled.bodies.back().p_BBcm_B - 1.1 * arm_.bodies.back().p_BBcm_B).norm(), 1e-15);
  EXPECT_EQ(result.files.size(), 2U);
}

TEST_F(ToolScale, AStaticPoseAtTheEndOfARangeIsSaidSo) {
  write_markers(5);  // the elbow at 69 degrees and more
  const auto placed_with_range = [&](const std::string& range) {
    std::string text = body::arm4_osim();
    const auto at = text.find("<range>", text.find("Coordinate name=\"elbow_flexion\"")) + 7;
    text.replace(at, text.find('<', at) - at, range);
    write("arm.osim", text);
    std::string tasks;
    for (const body::Marker& marker : arm_.markers)
      tasks += "<IKMarkerTask name=\"" + marker.name + "\"><weight>1</weight></IKMarkerTask>";
    return sentences(run("<ScaleTool name=\"s\"><GenericModelMaker><model_file>arm.osim</model_file>"
                         "</GenericModelMaker><ModelScaler><apply>false</apply></ModelScaler><MarkerPlacer>"
                         "<IKTaskSet><objects>" +
                         tasks +
                         "</objects></IKTaskSet><marker_file>m.trc"
                         "</marker_file><output_model_file>placed.osim</output_model_file></MarkerPlacer>"
                         "</ScaleTool>")
                         .remarks);
  };
  const auto said = ::testing::Contains(::testing::HasSubstr("'elbow_flexion' at its limit of 57.3 degrees"));
  EXPECT_THAT(placed_with_range("0 1"), said);
  std::filesystem::remove(folder_ / "placed.osim");
  EXPECT_THAT(placed_with_range("0 2"), ::testing::Not(said));
}

TEST(FramesIn, AreThoseOfTheRangeOrAll) {
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(11, 0.0, 1.0);
  markers.positions_m.resize(11, 0);
  using Frames = std::pair<Eigen::Index, Eigen::Index>;
  EXPECT_EQ(frames_in(markers, {0.2, 0.5}), Frames(2, 5));
  EXPECT_EQ(frames_in(markers, {-1.0, -1.0}), Frames(0, 10)) << "before all of them";
  EXPECT_EQ(frames_in(markers, {0.3, 7.0}), Frames(3, 10));
}

TEST_F(ToolScale, AStaticPoseStaysOffTheEndOfARangeWhereOpenSimsSearchHasABarrier) {
  write_markers(5);  // the elbow at 69 degrees and more
  std::string text = body::arm4_osim();
  const auto change = [&](const std::string& coordinate, const char* tag, const std::string& to) {
    const std::string open = std::string("<") + tag + ">";
    const auto at = text.find(open, text.find("Coordinate name=\"" + coordinate + "\"")) + open.size();
    text.replace(at, text.find('<', at) - at, to);
  };
  change("elbow_flexion", "range", "0 1");
  const auto lock_others = [&](const std::string& value) {
    for (const body::Coordinate& c : arm_.coordinates)
      if (c.name != "elbow_flexion") change(c.name, "locked", value);
  };
  std::string tasks;
  for (const body::Marker& marker : arm_.markers)
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

TEST_F(ToolScale, AStaticPoseSaysWhatNoMarkerDetermines) {
  write_markers(5);
  // Only the markers that the elbow does not move count.
  std::string tasks, forearm;
  const auto elbow = static_cast<std::size_t>(arm_.coordinate_index("elbow_flexion"));
  const int child = arm_.joints[static_cast<std::size_t>(arm_.coordinates[elbow].joint)].child;
  for (const body::Marker& marker : arm_.markers) {
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
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::AllOf(::testing::HasSubstr("determines"),
                                                                              ::testing::HasSubstr("elbow_flexion"),
                                                                              ::testing::HasSubstr(forearm))));
}

// MeasurementSet, ScaleSet and IKTaskSet in files give the scaled model of the same sets inside the set-up, to the last
// byte.
TEST(ScaleSets, InFilesOfTheirOwnScaleAsInside) {
  const auto data = test::data_folder() / "round3" / "opensim" / "file_attribute" / "scale";
  MYOID_REQUIRE_DATA(data);
  test::TemporaryFolder folder;
  std::map<std::string, std::string> results;
  for (const char* name : {"a", "b", "c", "d"}) {
    const auto here = folder / name;
    std::filesystem::copy(data, here);
    std::filesystem::permissions(here, std::filesystem::perms::owner_all, std::filesystem::perm_options::add);
    const ToolResult result = run_tool(here / (std::string(name) + ".xml"));
    std::string all;
    for (const auto& file : result.files) {
      std::ifstream in(file, std::ios::binary);
      all += file.filename().string() + "\n" + std::string(std::istreambuf_iterator<char>(in), {});
    }
    EXPECT_GT(all.size(), 100000U) << name;
    results[name] = all;
  }
  for (const char* name : {"b", "c", "d"}) EXPECT_TRUE(results[name] == results["a"]) << name;
}

TEST_F(ToolScale, MarkersThatTheStaticTrialLacksAreNamed) {
  write_markers(5);
  std::string text;
  {
    std::ifstream in(folder_ / "m.trc");
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string name = arm_.markers.back().name;
  text.replace(text.find(name), name.size(), "other");
  write("m.trc", text);
  const ToolResult result = run(
      "<ScaleTool><GenericModelMaker><model_file>arm.osim</model_file></GenericModelMaker><MarkerPlacer>"
      "<marker_file>m.trc</marker_file><output_model_file>placed.osim</output_model_file></MarkerPlacer></ScaleTool>");
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("as in OpenSim: " + name)));
}

TEST_F(ToolScale, FactorsThatNobodyGivesAreSaidSo) {
  const ToolResult result =
      run("<ScaleTool><GenericModelMaker><model_file>arm.osim</model_file></GenericModelMaker><ModelScaler>"
          "<scaling_order>measurements manualScale</scaling_order><MeasurementSet fle=\"m.xml\"/>"
          "<output_model_file>scaled.osim</output_model_file></ModelScaler></ScaleTool>");
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("no measurement is used")));
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("no factor that applies")));
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("did you mean 'file'")));
}

}  // namespace
}  // namespace myoid::opensim
