#include "myoid/files/file_in_parts.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/files/text_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

TEST(FileInParts, IsThereWhenItIsFinishedAndNotBefore) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.txt", "old");
  FileInParts file(folder / "a.txt");
  file.append("one ");
  file.append("two");
  EXPECT_EQ(read_text_file(folder / "a.txt"), "old");
  file.finish();
  EXPECT_EQ(read_text_file(folder / "a.txt"), "one two");
}

TEST(FileInParts, LeavesNothingBehindUnlessItIsFinished) {
  const test::TemporaryFolder folder;
  {
    FileInParts file(folder / "a.txt");
    file.append("half of it");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FileInParts, AFullDiskIsToldAtThePartThatDoesNotFit) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  FileInParts file("/dev/full");
  try {
    file.append("content");
    FAIL() << "was written";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("No space left"));
  }
}

}  // namespace
}  // namespace myoid::recording
