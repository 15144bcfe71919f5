#include "myoid/recording/atomic_file.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/recording/text_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

TEST(WriteFile, MakesTheFolderAndReplacesTheFile) {
  const test::TemporaryFolder folder;
  write_file(folder / "a/b.txt", "one");
  write_file(folder / "a/b.txt", "two");
  EXPECT_EQ(read_text_file(folder / "a/b.txt"), "two");
}

TEST(WriteFile, LeavesNothingBehindWhenItFails) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "taken/inside");
  EXPECT_THROW(write_file(folder / "taken", "x"),
               InvalidInput);  // a folder that is not empty cannot be replaced
  std::size_t entries = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    entries += entry.exists() ? 1 : 0;
  EXPECT_EQ(entries, 1U);
}

TEST(WriteFile, AFullDiskIsToldAsSuch) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_THROW(write_file("/dev/full/x", "content"), InvalidInput);
}

}  // namespace
}  // namespace myoid::recording
