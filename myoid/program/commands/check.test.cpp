#include "myoid/program/commands/check.h"

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

TEST(PlaceForResults, IsBesideTheStudyAndPassesByFoldersOfOthers) {
  const test::TemporaryFolder folder;
  const fs::path study = folder / "study.toml";
  write_file(study, "");
  EXPECT_EQ(place_for_results(study).folder, folder / "results");
  fs::create_directory(folder / "results");
  EXPECT_EQ(place_for_results(study).folder, folder / "results");
  write_file(folder / "results" / "thesis.txt", "");
  EXPECT_EQ(place_for_results(study).folder, folder / "results-2");
  write_file(folder / "results-2", "a file");
  EXPECT_EQ(place_for_results(study).folder, folder / "results-3");
  EXPECT_FALSE(place_for_results(study).overwrite);
}

TEST(PlaceForResults, IsTheFolderOfAnEarlierRunOfTheSameStudyAndOfNoOther) {
  const test::TemporaryFolder folder;
  const fs::path study = folder / "study.toml", other = folder / "other.toml";
  for (const fs::path& each : {study, other}) write_file(each, "");
  fs::create_directory(folder / "results");
  write_file(folder / "results" / "run.json", "{\"study\": \"" + study.string() + "\"}");
  EXPECT_EQ(place_for_results(study).folder, folder / "results");
  EXPECT_TRUE(place_for_results(study).overwrite);
  EXPECT_EQ(place_for_results(other).folder, folder / "results-2");
  EXPECT_FALSE(place_for_results(other).overwrite);
}

}  // namespace
}  // namespace myoid::program
