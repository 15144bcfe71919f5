// Manual pages and completions name every command and option that the program has.
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::set<std::string> all_matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) found.insert((*it)[1]);
  return found;
}

/// The commands that the program's own help lists.
std::set<std::string> commands() { return all_matches(myoid({"--help"}).out, "\n  ([a-z-]+)  "); }

bool installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// The standard output and error of a shell's command.
std::string said(const TemporaryFolder& folder, const std::string& command) {
  const std::string file = folder / "said";
  (void)std::system(("{ " + command + "; } >" + file + " 2>&1").c_str());
  return read_text(file);
}

class HelpFiles : public testing::Test {
 protected:
  void SetUp() override {
    const Finished done = myoid({"help-files", folder / "help"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  TemporaryFolder folder;
};

TEST_F(HelpFiles, NameEveryCommandAndEveryOptionOfItsHelp) {
  const std::string page = read_text(folder / "help/man1/myoid.1");
  const std::string bash = read_text(folder / "help/bash/myoid");
  const std::string zsh = read_text(folder / "help/zsh/_myoid");
  const std::string fish = read_text(folder / "help/fish/myoid.fish");
  const auto escaped = [](const std::string& text) { return std::regex_replace(text, std::regex("-"), "\\-"); };
  std::size_t options = 0;
  ASSERT_GT(commands().size(), 20U);
  for (const std::string& command : commands()) {
    EXPECT_THAT(page, HasSubstr(".B " + escaped(command) + "\n"));
    const std::string own = read_text(folder / ("help/man1/myoid-" + command + ".1"));
    const std::set<std::string> words = all_matches(bash, "\n    " + command + "\\) words=\"([^\"]*)\"");
    ASSERT_EQ(words.size(), 1U) << command;
    const std::string of_bash = *words.begin() + " ";
    const std::size_t begin = zsh.find("\n    " + command + ")\n");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string of_zsh = zsh.substr(begin, zsh.find(";;", begin) - begin);
    for (const std::string& option : all_matches(myoid({command, "--help"}).out, "\n  (?:-\\w,)?--([\\w-]+)")) {
      ++options;
      EXPECT_THAT(own, HasSubstr("\\fB\\-\\-" + escaped(option) + "\\fR")) << command;
      EXPECT_THAT(of_bash, HasSubstr("--" + option + " ")) << command;
      EXPECT_THAT(of_zsh, HasSubstr("'*--" + option + "[")) << command;
      EXPECT_THAT(fish, HasSubstr("from " + command + "' -l " + option + " ")) << command;
    }
  }
  EXPECT_GT(options, 200U);
}

TEST_F(HelpFiles, AreTheSameBytesEveryTime) {
  ASSERT_EQ(myoid({"help-files", folder / "again"}).exit_code, 0);
  EXPECT_EQ(said(folder, "diff -r " + (folder / "help").string() + " " + (folder / "again").string()), "");
}

TEST_F(HelpFiles, ManFindsNothingToWarnOf) {
  if (!installed("man")) GTEST_SKIP() << "there is no man";
  for (const auto& entry : fs::directory_iterator(folder / "help/man1")) {
    const std::string complaint =
        said(folder, "LC_ALL=C.UTF-8 MANWIDTH=100 man -l --warnings " + entry.path().string() + " 2>&1 >/dev/null");
    EXPECT_EQ(complaint, "") << entry.path();
  }
}

TEST_F(HelpFiles, BashCompletesCommandsOptionsAndWords) {
  if (!installed("bash")) GTEST_SKIP() << "there is no bash";
  const auto completed = [&](const std::string& words, int at) {
    write_text(folder / "ask.bash", "source " + (folder / "help/bash/myoid").string() + "\nCOMP_WORDS=(" + words +
                                        ")\nCOMP_CWORD=" + std::to_string(at) +
                                        "\n_myoid\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
    return said(folder, "bash " + (folder / "ask.bash").string());
  };
  EXPECT_EQ(completed("myoid twin-", 1), "twin-study\n");
  EXPECT_EQ(completed("myoid help twin-", 2), "twin-study\n");
  EXPECT_EQ(completed("myoid update-f", 1), "\n") << "each job is listed once";
  EXPECT_EQ(completed("myoid update-file --comp", 2), "--compat\n");
  EXPECT_EQ(completed("myoid run --met", 2), "--method\n");
  EXPECT_EQ(completed("myoid run --method p", 3), "paper\n");
  EXPECT_EQ(completed("myoid run --method ''", 3), "paper\nforce\ntorque\n");
  EXPECT_EQ(completed("myoid run study", 2), "\n") << "names of files are bash's own";
}

TEST_F(HelpFiles, OtherShellsReadTheirCompletions) {
  if (installed("zsh")) {
    EXPECT_EQ(said(folder, "zsh -n " + (folder / "help/zsh/_myoid").string()), "");
  }
  if (!installed("fish")) GTEST_SKIP() << "there is no fish (zsh was asked if it is there)";
  EXPECT_THAT(said(folder, "cd / && XDG_CONFIG_HOME=" + folder.path().string() + " fish -c 'source " +
                               (folder / "help/fish/myoid.fish").string() + "; complete -C \"myoid run --method p\"'"),
              HasSubstr("paper"));
}

}  // namespace
