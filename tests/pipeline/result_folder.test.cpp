// The folder of results when two commands want it, when one is killed in the middle, and when the
// system grants no threads.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::Running;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A virtual recording of so many trials, and the command that makes it.
std::vector<std::string> twin_command(const TemporaryFolder& folder, const std::string& out, int trials) {
  std::string protocol = "name = \"short\"\nlevel = \"L0\"\n[motion]\nrate_hz = 100\n";
  for (int i = 0; i < trials; ++i) {
    protocol += "[[trial]]\nname = \"slow_" + std::to_string(i) +
                "\"\nkind = \"flexion\"\nfrequency_hz = 0.5\ncentre_deg = 72\namplitude_deg = "
                "40\nheld_mass_kg = 1.0\nduration_s = 4\n";
  }
  write_text(folder / "protocol.toml", protocol);
  return {"twin", "--protocol", folder / "protocol.toml", "--out", folder / out};
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = read_text(entry.path());
  }
  return files;
}

/// Waits until the condition holds or the program has ended.
template <typename Condition>
void wait_until(Running& running, Condition holds) {
  while (!running.ended() && !holds()) usleep(500);
}

TEST(ResultFolder, TwoCommandsAtTheSameTimeTheSecondIsRefusedAndTheFirstLosesNothing) {
  const TemporaryFolder folder;
  ASSERT_EQ(myoid(twin_command(folder, "rec", 1)).exit_code, 0);
  const std::vector<std::string> study{"run", folder / "rec/study.toml", "--out", folder / "results"};
  Running first(study);
  // Its owner's name stands in the lock as soon as the folder is its own.
  std::error_code none;
  wait_until(first, [&] {
    const auto size = fs::file_size(folder / "results/.myoid.lock", none);
    return !none && size > 0;
  });
  first.send(SIGSTOP);  // it keeps the folder while the others ask for it
  ASSERT_FALSE(first.ended());
  std::vector<std::string> insisting = study;
  insisting.emplace_back("--overwrite");
  for (const auto& arguments : {study, insisting, twin_command(folder, "results", 1)}) {
    const Finished second = myoid(arguments);
    EXPECT_EQ(second.exit_code, 3) << second.err;
    EXPECT_THAT(second.err, AllOf(HasSubstr("another myoid is writing into the folder"), HasSubstr("myoid run "),
                                  HasSubstr(" UTC")));
  }
  first.send(SIGCONT);
  const Finished finished = first.wait();
  EXPECT_TRUE(finished.exit_code == 0 || finished.exit_code == 4) << finished.err;
  EXPECT_TRUE(fs::exists(folder / "results/run.json"));
  EXPECT_FALSE(fs::exists(folder / "results/.myoid.lock"));
}

TEST(ResultFolder, OfACommandThatWasKilledInTheMiddleTakesTheSameCommandAgain) {
  const TemporaryFolder folder;
  ASSERT_EQ(myoid(twin_command(folder, "whole", 12)).exit_code, 0);
  const std::vector<std::string> again = twin_command(folder, "killed", 12);
  {
    Running running(again);
    wait_until(running, [&] { return fs::exists(folder / "killed/slow_1.trc"); });
    ASSERT_FALSE(running.ended());
    running.send(SIGKILL);
    EXPECT_EQ(running.wait().exit_code, 128 + SIGKILL);
  }
  // A kill in the middle of one write leaves this.
  write_text(folder / "killed/truth/.slow_1_motion.sto.myoid-part.a1B2c3", "half");
  const Finished another = myoid({"run", folder / "whole/study.toml", "--out", folder / "killed"});
  EXPECT_EQ(another.exit_code, 3);
  EXPECT_THAT(another.err, HasSubstr("is not empty"));
  const Finished finished = myoid(again);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.err,
              AllOf(HasSubstr("taken over from a command that did not finish (process "), HasSubstr("half-written")));
  EXPECT_EQ(files_in(folder / "killed"), files_in(folder / "whole"));
  const Finished third = myoid(again);
  EXPECT_EQ(third.exit_code, 3);
  EXPECT_THAT(third.err, HasSubstr("is not empty"));
}

/// The size of the longest file in a folder.
std::uint64_t longest_file(const fs::path& folder) {
  std::uint64_t longest = 0;
  for (const auto& [name, text] : files_in(folder)) longest = std::max(longest, text.size());
  return longest;
}

// On a full disk some files are written and one is not.
TEST(ResultFolder, OfACommandThatAFullDiskStoppedTakesTheSameCommandAgain) {
  const TemporaryFolder folder;
  ASSERT_EQ(myoid(twin_command(folder, "whole", 2)).exit_code, 0);
  const std::vector<std::string> again = twin_command(folder, "full", 2);
  const Finished stopped = myoid(again, 0.0, "", {.file_bytes = longest_file(folder / "whole") - 1});
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_THAT(stopped.err, HasSubstr("writing failed"));
  ASSERT_FALSE(files_in(folder / "full").empty());
  const Finished another = myoid({"run", folder / "whole/study.toml", "--out", folder / "full"});
  EXPECT_EQ(another.exit_code, 3);
  const Finished finished = myoid(again);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.err, HasSubstr("taken over from a command that did not finish (process "));
  EXPECT_EQ(files_in(folder / "full"), files_in(folder / "whole"));
  EXPECT_EQ(myoid(again).exit_code, 3);  // It is whole, and needs --overwrite.
}

/// The program under a system that grants so many threads at the same time.
Finished with_threads(int granted, const std::vector<std::string>& arguments) {
  return Running(arguments, "", {"LD_PRELOAD=" MYOID_FEW_THREADS, "MYOID_GRANTED=" + std::to_string(granted)}).wait();
}

TEST(Threads, ThatTheSystemDoesNotGrantAreDoneWithout) {
  if (std::string(MYOID_FEW_THREADS).empty()) GTEST_SKIP() << "not under a sanitizer";
  const TemporaryFolder folder;
  std::vector<std::string> arguments = twin_command(folder, "many", 6);
  arguments.insert(arguments.end(), {"--subjects", "4", "--threads", "8"});
  ASSERT_EQ(myoid(arguments).exit_code, 0);
  for (const int granted : {0, 1, 2, 4}) {
    const std::string out = "few_" + std::to_string(granted);
    std::vector<std::string> few = arguments;
    few[4] = folder / out;
    const Finished finished = with_threads(granted, few);
    EXPECT_EQ(finished.exit_code, 0) << granted << ": " << finished.err;
    EXPECT_THAT(finished.err, HasSubstr("grants fewer threads than the 8 that are wanted"));
    EXPECT_EQ(files_in(folder / out), files_in(folder / "many")) << granted;
  }
  EXPECT_THAT(with_threads(16,
                           [&] {
                             auto more = arguments;
                             more[4] = folder / "enough";
                             return more;
                           }())
                  .err,
              Not(HasSubstr("fewer threads")));
}

}  // namespace
