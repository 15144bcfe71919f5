#include "myoid/ground/files/atomic_file.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::inline ground {
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
               InvalidInput);  // a folder is no file
  std::size_t entries = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) entries += entry.exists() ? 1 : 0;
  EXPECT_EQ(entries, 1U);
}

TEST(WriteFile, AFullDiskIsToldAsSuch) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  try {
    write_file("/dev/full", "content");
    FAIL() << "was written";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string_view(error.what()).find("No space left"), std::string_view::npos);
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(WriteFile, ASymbolicLinkStaysAndTheFileBehindItIsReplaced) {
  const test::TemporaryFolder folder;
  write_file(folder / "there/real.txt", "one");
  std::filesystem::create_symlink("there/real.txt", folder / "link.txt");
  std::filesystem::create_symlink("there/later.txt", folder / "dangling.txt");
  write_file(folder / "link.txt", "two");
  write_file(folder / "dangling.txt", "three");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "dangling.txt"));
  EXPECT_EQ(read_text_file(folder / "there/real.txt"), "two");
  EXPECT_EQ(read_text_file(folder / "there/later.txt"), "three");
}

TEST(WriteFile, KeepsThePermissionsOfTheFileItReplaces) {
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  write_file(folder / "a.txt", "one");
  fs::permissions(folder / "a.txt", fs::perms::owner_read | fs::perms::owner_write);
  write_file(folder / "a.txt", "two");
  EXPECT_EQ(fs::status(folder / "a.txt").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(WriteFile, ANewFileHasThePermissionsThatTheUmaskLeaves) {
  const test::TemporaryFolder folder;
  const mode_t before = umask(077);
  write_file(folder / "private.txt", "one");
  umask(002);
  write_file(folder / "group.txt", "one");
  umask(before);
  using std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(folder / "private.txt").permissions(), perms{0600});
  EXPECT_EQ(std::filesystem::status(folder / "group.txt").permissions(), perms{0664});
}

TEST(WriteFile, WritesIntoAPipe) {
  const test::TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] {
    std::ifstream stream(pipe);
    read.assign(std::istreambuf_iterator<char>(stream), {});
  });
  write_file(pipe, "through");
  reader.join();
  EXPECT_EQ(read, "through");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

std::size_t temporaries_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::count_if(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator(),
                    [](const auto& entry) { return is_temporary(entry.path().filename()); }));
}

TEST(WriteFile, AKilledProcessLeavesOneTemporaryFileWhichIsSwept) {
  const test::TemporaryFolder folder;
  const std::string content(20'000'000, 'x');
  // The kill may fall between two files; a few of them do not.
  for (int attempt = 0; attempt < 50 && temporaries_in(folder.path()) == 0; ++attempt) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (;;) write_file(folder / "ik.mot", content, Flush::later);
    }
    while (temporaries_in(folder.path()) == 0) usleep(200);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  EXPECT_EQ(temporaries_in(folder.path()), 1U);
  EXPECT_EQ(sweep_temporaries(folder.path()), 1U);
  EXPECT_EQ(temporaries_in(folder.path()), 0U);
}

TEST(SweepTemporaries, LeavesTheFileThatALivingProcessWrites) {
  const test::TemporaryFolder folder;
  const std::string content(1'000'000, 'x');
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    try {
      for (int i = 0; i < 300; ++i) write_file(folder / "sub/ik.mot", content, Flush::later);
    } catch (const InvalidInput&) {
      _exit(1);  // its file was taken away
    }
    _exit(0);
  }
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) EXPECT_LE(sweep_temporaries(folder.path()), 1U);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(read_text_file(folder / "sub/ik.mot"), content);
}

TEST(WriteFile, TakesTheLongestNamesOfTheSystem) {
  const test::TemporaryFolder folder;
  const std::string name(255, 'n');
  write_file(folder / name, "one");
  EXPECT_EQ(read_text_file(folder / name), "one");
}

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
}  // namespace myoid::inline ground
