#include "myoid/opensim/opensim_setup.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/ground/core/error.h"

namespace myoid::opensim {
namespace {

class Setup : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("myoid_setup_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "arm.osim") << body::arm4_osim();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder_ / "setup.xml") << text;
    return folder_ / "setup.xml";
  }
  std::filesystem::path folder_;
};

TEST_F(Setup, FilesAreRelativeToTheSetUp) {
  const OpensimSetup setup(
      write("<OpenSimDocument Version=\"20302\"><InverseDynamicsTool name=\"id\">"
            "<model_file> arm.osim </model_file><results_directory>out</results_directory>"
            "<coordinates_file>Unassigned</coordinates_file><time_range> 0.5  1 </time_range>"
            "</InverseDynamicsTool></OpenSimDocument>"));
  EXPECT_EQ(setup.kind(), "InverseDynamicsTool");
  EXPECT_EQ(setup.name(), "id");
  EXPECT_EQ(setup.required_file(setup.tool(), "model_file"), folder_ / "arm.osim");
  EXPECT_EQ(setup.results_folder(), folder_ / "out");
  EXPECT_FALSE(setup.file(setup.tool(), "coordinates_file"));
  EXPECT_THROW((void)setup.required_file(setup.tool(), "coordinates_file"), ReadError);
  EXPECT_DOUBLE_EQ(setup.time_range(setup.tool(), "time_range").first, 0.5);
  EXPECT_TRUE(std::isinf(setup.time_range(setup.tool(), "other").second));
}

TEST_F(Setup, AnOldSetUpNeedsNoDocumentElement) {
  const OpensimSetup setup(write("<AnalyzeTool name=\"a\"/>"));
  EXPECT_EQ(setup.kind(), "AnalyzeTool");
}

TEST_F(Setup, AnotherKindOfFileIsNamed) {
  try {
    const OpensimSetup setup(write("<OpenSimDocument Version=\"40000\"><CMCTool/></OpenSimDocument>"));
    FAIL() << "was taken";
  } catch (const ReadError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("CMCTool"));
  }
  EXPECT_THROW(OpensimSetup(write("<OpenSimDocument><AnalyzeTool>")), ReadError);
  EXPECT_THROW(OpensimSetup(folder_ / "missing.xml"), InvalidInput);
}

TEST_F(Setup, ForcesAreLeftOutByGroupOrName) {
  const OpensimSetup setup(
      write("<OpenSimDocument Version=\"40000\"><InverseDynamicsTool>"
            "<model_file>arm.osim</model_file></InverseDynamicsTool></OpenSimDocument>"));
  std::vector<Remark> remarks;
  const auto count = [&](const std::vector<std::string>& excluded) {
    return setup_model(setup, {}, excluded, remarks).muscles.size();
  };
  const std::size_t all = count({});
  EXPECT_GT(all, 1U);
  EXPECT_EQ(count({"Muscles"}), 0U);
  EXPECT_EQ(count({"ALL"}), 0U);
  EXPECT_EQ(count({setup_model(setup, {}, {}, remarks).muscles[0].name}), all - 1);
}

}  // namespace
}  // namespace myoid::opensim
