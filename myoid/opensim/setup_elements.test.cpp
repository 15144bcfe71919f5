#include "myoid/opensim/setup_elements.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/run_tool.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> told(const std::string& text) {
  const body::OsimXml xml(text, "setup.xml", body::OsimXml::Root::any);
  return unknown_elements(xml, body::OsimXml::first_element(xml.root()));
}

TEST(UnknownElements, AreToldWithLineAndNearestName) {
  EXPECT_THAT(
      told("<OpenSimDocument>\n<AnalyzeTool name=\"t\">\n<model_file>m.osim</model_file>\n"
           "<!-- a remark -->\n<final_tiem>2</final_tiem>\n<AnalysisSet>\n<objects>\n"
           "<StaticOptimization name=\"s\">\n<activaton_exponent>3</activaton_exponent>\n"
           "</StaticOptimization>\n</objects>\n</AnalysisSet>\n<colour/>\n</AnalyzeTool>\n"
           "</OpenSimDocument>\n"),
      ElementsAre(AllOf(HasSubstr("line 5: <AnalyzeTool> has no element <final_tiem>"),
                        HasSubstr("did you mean <final_time>?")),
                  AllOf(HasSubstr("line 9: <StaticOptimization>"), HasSubstr("did you mean <activation_exponent>?")),
                  AllOf(HasSubstr("line 13: <AnalyzeTool> has no element <colour>;"))));
}

TEST(UnknownElements, AreFoundInTasksAndMeasurements) {
  EXPECT_THAT(told("<OpenSimDocument><ScaleTool><ModelScaler><MeasurementSet><object/><objects>"
                   "<Measurement><apply>true</apply><MarkerPairSet><objects><MarkerPair><marker>A B"
                   "</marker></MarkerPair></objects></MarkerPairSet></Measurement></objects>"
                   "</MeasurementSet></ModelScaler><MarkerPlacer><IKTaskSet><objects><IKMarkerTask>"
                   "<wieght>2</wieght></IKMarkerTask></objects></IKTaskSet></MarkerPlacer></ScaleTool>"
                   "</OpenSimDocument>"),
              ElementsAre(HasSubstr("did you mean <objects>?"), HasSubstr("did you mean <markers>?"),
                          HasSubstr("did you mean <weight>?")));
}

// Controllers hold functions and controls, whose elements are not listed.
TEST(UnknownElements, AreNotLookedForInControllers) {
  EXPECT_THAT(told("<OpenSimDocument><ForwardTool><ControllerSet><objects><ControlSetController>"
                   "<enabled>true</enabled></ControlSetController></objects></ControllerSet>"
                   "</ForwardTool></OpenSimDocument>"),
              IsEmpty());
}

// Without the element that was meant the tool cannot run: the error names both.
TEST(UnknownElements, AreNamedByTheErrorThatTheyCause) {
  const test::TemporaryFolder folder;
  write_file(folder / "ik.xml",
             "<OpenSimDocument Version=\"40000\">\n<InverseKinematicsTool>\n"
             "<model_fiel>m.osim</model_fiel>\n</InverseKinematicsTool>\n"
             "</OpenSimDocument>\n");
  EXPECT_THAT(test::message_of([&] { (void)run_tool(folder / "ik.xml"); }),
              AllOf(HasSubstr("<model_file> expected"),
                    HasSubstr("line 3: <InverseKinematicsTool> has no element <model_fiel> (did "
                              "you mean <model_file>?)")));
}

// OpenSim itself and its users wrote them: nothing in them is misspelt.
TEST(UnknownElements, AreNoneInSetUpsThatOpenSimWrote) {
  const fs::path data = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(data);
  int setups = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data)) {
    if (entry.path().extension() != ".xml") continue;
    const std::string text = read_text_file(entry.path());
    if (text.find("Tool name=") == std::string::npos) continue;
    const body::OsimXml xml(text, entry.path(), body::OsimXml::Root::any);
    ++setups;
    EXPECT_THAT(unknown_elements(xml, body::OsimXml::first_element(xml.root(), {"defaults"})), IsEmpty())
        << entry.path();
  }
  EXPECT_GT(setups, 50);
}

}  // namespace
}  // namespace myoid::opensim
