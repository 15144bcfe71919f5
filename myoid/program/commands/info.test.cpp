#include "myoid/program/commands/info.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

nlohmann::ordered_json info_of(const test::TemporaryFolder& folder, const char* xml) {
  write_file(folder / "part.xml", xml);
  InfoOptions options;
  options.file = (folder / "part.xml").string();
  return info(options);
}

TEST(Info, OfExternalLoadsNamesForcesBodiesAndTheirFile) {
  const test::TemporaryFolder folder;
  const char* xml =
      "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"walk\"><objects><ExternalForce name=\"right\">"
      "<applied_to_body>calcn_r</applied_to_body></ExternalForce></objects><datafile>grf.mot</datafile>"
      "</ExternalLoads></OpenSimDocument>";
  nlohmann::ordered_json told = info_of(folder, xml);
  EXPECT_EQ(told.at("forces").at(0).at("name"), "right");
  EXPECT_EQ(told.at("forces").at(0).at("on"), "calcn_r");
  EXPECT_EQ(told.at("missing").at(0), (folder / "grf.mot").string());
  EXPECT_EQ(told.at("class"), "ExternalLoads");
  EXPECT_EQ(told.at("read_by").at(0), "myoid id --loads");
  write_file(folder / "grf.mot", "x");
  told = info_of(folder, xml);
  EXPECT_EQ(told.at("reads").at(0), (folder / "grf.mot").string());
  EXPECT_FALSE(told.contains("missing"));
}

TEST(Info, OfATaskSetNamesTheWeights) {
  const test::TemporaryFolder folder;
  const nlohmann::ordered_json told =
      info_of(folder,
              "<OpenSimDocument Version=\"40000\"><IKTaskSet name=\"gait\"><objects><IKMarkerTask name=\"RASI\"><apply>"
              "true</apply><weight>5</weight></IKMarkerTask><IKMarkerTask name=\"LASI\"><apply>false</apply>"
              "</IKMarkerTask><IKCoordinateTask name=\"knee\"/></objects></IKTaskSet></OpenSimDocument>");
  EXPECT_EQ(told.at("markers").at(0).at("weight"), 5.0);
  EXPECT_EQ(told.at("markers").at(1).at("weight"), "off");
  EXPECT_EQ(told.at("coordinates").at(0).at("name"), "knee");
  EXPECT_EQ(told.at("read_by").at(0), "myoid run-tool");
}

TEST(Info, OfAStudyNamesMusclesAndTrialsWithTheirFacts) {
  const test::TemporaryFolder folder;
  write_file(folder / "study.toml",
             "[[muscle]]\nname = \"BIC\"\nemg = \"ch1\"\n[[trial]]\nname = \"lift\"\nmarkers = \"t.trc\"\n"
             "emg = \"t.sto\"\n");
  InfoOptions options;
  options.file = (folder / "study.toml").string();
  const nlohmann::ordered_json told = info(options);
  EXPECT_EQ(told.at("muscles").at(0), (nlohmann::ordered_json{{"name", "BIC"}, {"emg", "ch1"}}));
  EXPECT_EQ(told.at("trials").at(0), (nlohmann::ordered_json{{"name", "lift"}, {"use", "calibration"}}));
}

}  // namespace
}  // namespace myoid::program
