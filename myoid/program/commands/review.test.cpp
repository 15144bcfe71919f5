#include "myoid/program/commands/review.h"

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/commands/identify.h"
#include "myoid/program/commands/init.h"
#include "myoid/program/commands/project_files.h"
#include "myoid/study/read_study.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

std::map<std::string, fs::file_time_type> contents(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    files[entry.path().string()] = entry.last_write_time();
  return files;
}

TEST(ReviewFunction, RefusesResultsInsideTheProjectAndFoldersWithoutOne) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "project");
  EXPECT_THROW(refuse_inside(folder / "project", folder / "project"), InvalidInput);
  EXPECT_THROW(refuse_inside(folder / "project", folder / "project/out"), InvalidInput);
  EXPECT_THROW(refuse_inside(folder / "project", folder / "project/../project/out"), InvalidInput);
  fs::create_directory_symlink(folder / "project", folder / "link");
  EXPECT_THROW(refuse_inside(folder / "project", folder / "link/out"), InvalidInput);
  EXPECT_NO_THROW(refuse_inside(folder / "project", folder / "project2"));
  EXPECT_NO_THROW(refuse_inside(folder / "project", folder.path()));
  EXPECT_THROW(
      (void)review({.call = {}, .project = folder.path().string(), .joints = {}, .folder = (folder / "out").string()}),
      InvalidInput);
}

TEST(ReviewFunction, JudgesAProjectAndLeavesItAsItIs) {
  const fs::path data = test::data_folder() / "ceinms-rt-leg";
  MYOID_REQUIRE_DATA(data);
  const auto before = contents(data);
  const test::TemporaryFolder folder;
  ReviewOptions options{.call = {}, .project = data.string(), .joints = {}, .folder = folder.path().string()};
  options.call.start_s = 19.0;  // the part that calibrated the project's subject
  options.call.end_s = 24.0;
  const ReviewResult result = review(options);
  write_review(result, folder.path());
  EXPECT_TRUE(fs::exists(folder / "report.html"));
  EXPECT_TRUE(fs::exists(folder / "tables/torques.csv"));
  ASSERT_EQ(result.opinion.torques.size(), 2U);
  for (const results::ReviewedTorque& torque : result.opinion.torques) {
    ASSERT_TRUE(torque.theirs && torque.ours) << torque.trial;
    // Their subject was fitted to the calibration's trial.
    if (!torque.is_calibrating) {
      EXPECT_GT(torque.ours->r2(), torque.theirs->r2()) << torque.trial;
    }
  }
  EXPECT_EQ(result.opinion.numbers.size(), 12U);  // force, fiber and slack of four muscles
  EXPECT_EQ(contents(data), before);
}

TEST(InitFunction, MakesTheStudyOfAProjectThatRunReads) {
  const fs::path data = test::data_folder() / "ceinms-rt-back";
  MYOID_REQUIRE_DATA(data);
  const test::TemporaryFolder folder;
  const fs::path file = folder / "study/study.toml";
  fs::create_directories(file.parent_path());
  const InitOptions options{
      .call = {}, .folder = file.parent_path().string(), .from = {data.string()}, .model = {}, .coordinate = {}};
  write_init(init(options), file, options.call);
  const study::Study study = study::read_study(file);
  EXPECT_EQ(study.trials.size(), 3U);
  EXPECT_EQ(study.muscles.size(), 8U);  // 116 muscles of 8 electrodes
  EXPECT_EQ(study.model.coordinate, "L5_S1_Flex_Ext");
  EXPECT_TRUE(fs::exists(*study.model.file));
  EXPECT_TRUE(fs::exists(*study.trials[0].motion));
}

}  // namespace
}  // namespace myoid::program
