#include "myoid/opensim/setup_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/tool_folder.h"

namespace myoid::opensim {
namespace {

class SetupList : public test::ToolFolder {
 protected:
  /// The place of a set-up with this tool.
  int place(const std::string& tool) {
    write("s.xml", "<OpenSimDocument Version=\"40000\">" + tool + "</OpenSimDocument>");
    return place_in_study(OpensimSetup(folder_ / "s.xml"));
  }
  [[nodiscard]] std::vector<std::string> names(const std::vector<std::filesystem::path>& given) const {
    std::vector<std::string> all;
    for (const NamedSetup& setup : list_setups(given)) all.push_back(setup.name.string());
    return all;
  }
};

TEST_F(SetupList, AToolComesAfterTheToolsWhoseResultsItReads) {
  EXPECT_EQ(place("<ScaleTool/>"), 0);
  EXPECT_EQ(place("<InverseKinematicsTool/>"), 1);
  EXPECT_EQ(place("<IKTool/>"), 1);
  EXPECT_EQ(place("<InverseDynamicsTool/>"), 2);
  const std::string analysis = "<AnalyzeTool><AnalysisSet><objects><JointReaction><forces_file>";
  const std::string end = "</forces_file></JointReaction></objects></AnalysisSet></AnalyzeTool>";
  EXPECT_EQ(place(analysis + end), 2);
  EXPECT_EQ(place(analysis + "Unassigned" + end), 2);
  EXPECT_EQ(place(analysis + "so_force.sto" + end), 3);
}

TEST_F(SetupList, AFolderStandsForItsSetUpsAndEqualStemsGetTheirFolders) {
  for (const char* trial : {"a", "b"}) {
    std::filesystem::create_directory(folder_ / trial);
    write(std::string(trial) + "/ik.xml", "<OpenSimDocument><InverseKinematicsTool/></OpenSimDocument>");
    write(std::string(trial) + "/tasks.xml", "<OpenSimDocument><IKTaskSet name=\"MyTool\"/></OpenSimDocument>");
  }
  write("cmc.xml", "<OpenSimDocument><CMCTool/></OpenSimDocument>");
  EXPECT_THAT(names({folder_}), testing::ElementsAre("a/ik", "b/ik", "cmc"));
  EXPECT_THAT(names({folder_ / "a/ik.xml", folder_ / "b/ik.xml"}), testing::ElementsAre("a/ik", "b/ik"));
  EXPECT_THAT(names({folder_ / "a/ik.xml", folder_ / "cmc.xml"}), testing::ElementsAre("ik", "cmc"));
  std::filesystem::create_directory(folder_ / "empty");
  EXPECT_THROW((void)list_setups({folder_ / "empty"}), InvalidInput);
  EXPECT_THROW((void)list_setups({folder_ / "a/ik.xml", folder_ / "a/ik.xml"}), InvalidInput);
}

}  // namespace
}  // namespace myoid::opensim
