#include "myoid/ground/files/folder_lock.h"

#include <csignal>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::inline ground {
namespace {

using testing::HasSubstr;

/// A process that holds a folder until `end` kills it.
class OtherProcess {
 public:
  explicit OtherProcess(const std::filesystem::path& folder) {
    int ready[2];
    if (pipe(ready) != 0) return;
    child_ = fork();
    if (child_ == 0) {
      FolderLock lock(folder);
      lock.sign("myoid run study.toml --out results", true);
      (void)!write(ready[1], "x", 1);
      for (;;) pause();
    }
    char byte = 0;
    (void)!read(ready[0], &byte, 1);
    close(ready[0]);
    close(ready[1]);
  }
  ~OtherProcess() { end(); }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

  void end() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = 0;
  }
  [[nodiscard]] pid_t child() const { return child_; }

 private:
  pid_t child_ = 0;
};

// A command that an error ends leaves this block, so that its destructors run.
TEST(FolderLock, StaysWhereACommandDidNotFinishWhatItBegan) {
  const test::TemporaryFolder folder;
  const auto file = folder / std::string(FolderLock::kFile);
  for (const bool finished : {false, true}) {
    std::filesystem::remove(folder / "ik.mot");
    {
      FolderLock lock(folder.path());
      lock.sign("myoid run study.toml", true);
      write_file(folder / "ik.mot", "half of the results");
      if (finished) lock.finish();
    }
    EXPECT_EQ(std::filesystem::exists(file), !finished);
    FolderLock next(folder.path());
    EXPECT_EQ(next.left_behind().has_value(), !finished);
    if (!finished) {
      EXPECT_EQ(next.left_behind()->command, "myoid run study.toml");
      next.sign("myoid run study.toml", true);
      next.finish();
    }
  }
}

TEST(FolderLock, IsGoneWhereNothingWasWrittenOrTheFolderHadContent) {
  const test::TemporaryFolder folder;
  const auto file = folder / std::string(FolderLock::kFile);
  { FolderLock(folder.path()).sign("myoid run study.toml", true); }
  EXPECT_FALSE(std::filesystem::exists(file));
  write_file(folder / "ik.mot", "of another command");
  { FolderLock(folder.path()).sign("myoid run study.toml --overwrite", false); }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(FolderLock, RefusesAFolderThatAnotherProcessHoldsAndNamesTheProcess) {
  const test::TemporaryFolder folder;
  const OtherProcess other(folder.path());
  const std::string said = test::message_of([&] { FolderLock mine(folder.path()); });
  EXPECT_THAT(said, HasSubstr("process " + std::to_string(other.child())));
  EXPECT_THAT(said, HasSubstr("myoid run study.toml --out results"));
  EXPECT_THAT(said, HasSubstr(" UTC"));
}

TEST(FolderLock, OfAKilledProcessIsTakenOver) {
  const test::TemporaryFolder folder;
  OtherProcess other(folder.path());
  const std::string process = std::to_string(other.child());
  other.end();
  {
    FolderLock mine(folder.path());
    ASSERT_TRUE(mine.left_behind());
    EXPECT_EQ(std::to_string(mine.left_behind()->process), process);
    EXPECT_TRUE(mine.left_behind()->from_empty);
    EXPECT_EQ(mine.left_behind()->command, "myoid run study.toml --out results");
    mine.sign("myoid run study.toml", false);
  }
  EXPECT_FALSE(FolderLock(folder.path()).left_behind());
}

TEST(FolderLock, ThatIsNotSignedLeavesTheDeadOwnerKnown) {
  const test::TemporaryFolder folder;
  OtherProcess(folder.path()).end();
  EXPECT_TRUE(FolderLock(folder.path()).left_behind());
  EXPECT_TRUE(FolderLock(folder.path()).left_behind());
}

TEST(FolderLock, IsGivenBackWithoutATrace) {
  const test::TemporaryFolder folder;
  { FolderLock(folder.path()).sign("myoid so", true); }
  EXPECT_FALSE(std::filesystem::exists(folder / std::string(FolderLock::kFile)));
}

TEST(HoldsContent, CountsNeitherLocksNorHalfWrittenFiles) {
  const test::TemporaryFolder folder;
  write_file(folder / std::string(FolderLock::kFile), "process: 1\n");
  write_file(folder / ".ik.mot.myoid-part.a1B2c3", "half");
  write_file(folder / ".stages/x", "kept");
  EXPECT_FALSE(holds_content(folder.path(), ".stages"));
  EXPECT_TRUE(holds_content(folder.path()));
  write_file(folder / "ik.mot", "whole");
  EXPECT_TRUE(holds_content(folder.path(), ".stages"));
}

}  // namespace
}  // namespace myoid::inline ground
