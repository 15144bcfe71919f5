#include "myoid/program/commands/run_tools.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"

#include "tests/support/tool_folder.h"

namespace myoid::program {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Three trials in folders of their own: inverse kinematics of markers, then inverse dynamics of that motion.
class SeveralSetups : public test::ToolFolder {
 protected:
  void SetUp() override {
    test::ToolFolder::SetUp();
    for (const char* trial : {"a", "b", "c"}) {
      const std::string folder = trial;
      std::filesystem::create_directory(folder_ / folder);
      write_markers(folder == "a" ? 20 : 30);
      std::filesystem::rename(folder_ / "m.trc", folder_ / folder / "m.trc");
      write(folder + "/2_ik.xml", setup("InverseKinematicsTool",
                                        "<marker_file>m.trc</marker_file>"
                                        "<output_motion_file>ik.mot</output_motion_file>"));
      // Its name comes before that of the set-up whose motion it reads.
      write(folder + "/1_id.xml", setup("InverseDynamicsTool",
                                        "<coordinates_file>ik.mot</coordinates_file>"
                                        "<output_gen_force_file>id.sto</output_gen_force_file>"));
      write(folder + "/tasks.xml", "<OpenSimDocument Version=\"40000\"><IKTaskSet/></OpenSimDocument>");
    }
  }
  static std::string setup(const std::string& tool, const std::string& elements) {
    return "<OpenSimDocument Version=\"40000\"><" + tool + " name=\"t\"><model_file>../arm.osim</model_file>" +
           elements + "</" + tool + "></OpenSimDocument>";
  }
  [[nodiscard]] std::vector<SetupOutcome> run_all() const {
    RunToolsOptions options;
    options.setups = {folder_.string()};
    return run_tools(options);
  }
  static SetupStatus status_of(const std::vector<SetupOutcome>& outcomes, const std::string& setup) {
    const auto found = std::ranges::find(outcomes, setup, &SetupOutcome::setup);
    EXPECT_NE(found, outcomes.end()) << setup;
    return found->status;
  }
};

TEST_F(SeveralSetups, AFolderGivesTheFilesOfEachSetUpAlone) {
  const std::vector<SetupOutcome> outcomes = run_all();
  ASSERT_EQ(outcomes.size(), 6U);  // the task sets are no set-ups
  for (const SetupOutcome& each : outcomes) EXPECT_EQ(each.status, SetupStatus::done) << each.setup << each.message;
  EXPECT_EQ(outcomes[0].setup, "a/1_id");
  EXPECT_EQ(outcomes[1].result.tool.frames, 20);
  const std::string motion = bytes_of(folder_ / "c/ik.mot"), torque = bytes_of(folder_ / "c/id.sto");
  EXPECT_FALSE(torque.empty());
  std::filesystem::remove(folder_ / "c/ik.mot");
  std::filesystem::remove(folder_ / "c/id.sto");
  (void)run_tool({.setup = folder_ / "c/2_ik.xml"});
  (void)run_tool({.setup = folder_ / "c/1_id.xml"});
  EXPECT_EQ(bytes_of(folder_ / "c/ik.mot"), motion);
  EXPECT_EQ(bytes_of(folder_ / "c/id.sto"), torque);
}

TEST_F(SeveralSetups, ASetUpThatFailsStopsNoOtherAndNothingIsComputedFromItsOldResult) {
  (void)run_all();
  std::filesystem::remove(folder_ / "b/m.trc");
  write("c/broken.xml", "<OpenSimDocument><InverseKinematicsTool>");
  const std::vector<SetupOutcome> outcomes = run_all();
  EXPECT_EQ(status_of(outcomes, "a/1_id"), SetupStatus::done);
  EXPECT_EQ(status_of(outcomes, "b/2_ik"), SetupStatus::failed);
  EXPECT_EQ(status_of(outcomes, "b/1_id"), SetupStatus::not_run);  // ik.mot is that of the first call
  EXPECT_EQ(status_of(outcomes, "c/1_id"), SetupStatus::done);
  EXPECT_EQ(status_of(outcomes, "c/broken"), SetupStatus::failed);
  const nlohmann::json json = nlohmann::json::parse(run_tools_json(outcomes));
  EXPECT_EQ(json.at(0).at("setup"), "a/1_id");
  EXPECT_EQ(json.at(0).at("status"), "done");
  EXPECT_EQ(json.at(0).at("frames"), 20);
}

TEST_F(SeveralSetups, TwoSetUpsNeverWriteOneFile) {
  write("a/3_ik.xml", setup("InverseKinematicsTool",
                            "<marker_file>m.trc</marker_file><output_motion_file>ik.mot</output_motion_file>"));
  const std::vector<SetupOutcome> outcomes = run_all();
  const auto failed = std::ranges::count(outcomes, SetupStatus::failed, &SetupOutcome::status);
  EXPECT_EQ(failed, 1);
  EXPECT_TRUE((status_of(outcomes, "a/2_ik") == SetupStatus::failed) !=
              (status_of(outcomes, "a/3_ik") == SetupStatus::failed));
}

TEST_F(SeveralSetups, EachHasAFolderOfItsOwnInOut) {
  RunToolsOptions options;
  options.setups = {folder_ / "a/2_ik.xml", folder_ / "b/2_ik.xml"};
  options.files.out = folder_ / "results";
  const std::vector<SetupOutcome> outcomes = run_tools(options);
  for (const SetupOutcome& each : outcomes) EXPECT_EQ(each.status, SetupStatus::done) << each.message;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "results/a/2_ik/ik.mot"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "results/b/2_ik/ik.mot"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a/ik.mot"));
}

TEST_F(SeveralSetups, AFolderWithoutASetUpAndEqualNamesAreRefused) {
  std::filesystem::create_directory(folder_ / "empty");
  RunToolsOptions options;
  options.setups = {folder_ / "empty"};
  EXPECT_THROW((void)run_tools(options), InvalidInput);
  options.setups = {folder_ / "a/2_ik.xml", folder_ / "a/2_ik.xml"};
  EXPECT_THROW((void)run_tools(options), InvalidInput);
}

}  // namespace
}  // namespace myoid::program
