// The program answers a wrong command line and Ctrl-C with a sentence and an exit code.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "small_inputs.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::emg_text;
using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::ramp_motion;
using myoid::test::read_text;
using myoid::test::recording_in;
using myoid::test::replace_in;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kProtocols = myoid::test::source_dir() / "examples/protocols/";

constexpr const char* kCommands[] = {"run",        "check",   "info",     "emg",     "ik",       "id",
                                     "muscle",     "paths",   "so",       "predict", "identify", "twin",
                                     "report",     "convert", "simulate", "compare", "design",   "run-tool",
                                     "twin-study", "init",    "cohort",   "demo"};

TEST(CommandLine, PrintedSettingsAreAStudyOfTheSameSettings) {
  const TemporaryFolder folder;
  write_text(folder / "study.toml",
             "[emg]\nlowpass_hz = 5\n[[muscle]]\nname = \"BIC\"\nemg = \"b\"\n[[trial]]\nname = "
             "\"t\"\nmarkers = \"t.trc\"\nemg = \"t.sto\"\n");
  const Finished first = myoid({"check", folder / "study.toml", "--defaults"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, AllOf(HasSubstr("lowpass_hz = 5.0"), HasSubstr("markers = \"t.trc\"")));
  write_text(folder / "again.toml", first.out);
  EXPECT_EQ(myoid({"check", folder / "again.toml", "--defaults"}).out, first.out);
}

TEST(CommandLine, TheSettingsOfAStudyAreExplainedAllOrByTable) {
  const std::string all = myoid({"check", "--settings"}).out;
  EXPECT_THAT(all, HasSubstr("  rate_hz: 10 to 2000 Hz; default 100\n"));
  const std::size_t begin = all.find("\n[emg] ") + 1, end = all.find("\n[sync] ", begin) + 1;
  ASSERT_LT(begin, end);
  EXPECT_EQ(myoid({"check", "--settings", "emg"}).out, all.substr(begin, end - begin));
  const Finished unknown = myoid({"check", "--settings", "emgs"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("'emg'"));
}

/// Expects that two command lines print the same and write the same into a file of their own, apart from a note on
/// stderr that names the command of the second.
void expect_same_command(const TemporaryFolder& folder,
                         const std::vector<std::string>& other_name,
                         const std::vector<std::string>& command) {
  const auto finished = [&](std::vector<std::string> words) {
    std::filesystem::remove(folder / "out.osim");
    words.emplace_back("--json");
    const Finished done = myoid(words);
    return std::pair(done, std::filesystem::exists(folder / "out.osim") ? read_text(folder / "out.osim") : "");
  };
  const auto [first, first_file] = finished(other_name);
  const auto [second, second_file] = finished(command);
  EXPECT_EQ(first.exit_code, second.exit_code) << other_name[0];
  EXPECT_EQ(first.out, second.out) << other_name[0];
  EXPECT_EQ(first_file, second_file) << other_name[0];
  EXPECT_EQ(std::ranges::count(first.err, '\n'), std::ranges::count(second.err, '\n') + 1) << first.err;
  EXPECT_THAT(first.err, testing::EndsWith(second.err));
  EXPECT_THAT(first.err, AllOf(HasSubstr("myoid " + command[0] + " "), HasSubstr(other_name[0])));
}

TEST(CommandLine, AnotherNameOfACommandDoesTheSameAndSaysSo) {
  const TemporaryFolder folder;
  const std::filesystem::path rec = recording_in(folder);
  const std::string study = rec / "study.toml", model = rec / "model.osim";
  const std::string out = folder / "out.osim";
  expect_same_command(folder, {"settings"}, {"check", "--settings"});
  expect_same_command(folder, {"settings", study}, {"check", study, "--defaults"});
  expect_same_command(folder, {"settings", folder / "none.toml"}, {"check", folder / "none.toml", "--defaults"});
  expect_same_command(folder, {"update-file", model, out}, {"convert", model, out});
  expect_same_command(folder, {"update-file", model, out, "--compat", "opensim"},
                      {"convert", model, out, "--compat", "opensim"});
  expect_same_command(folder, {"update-file", study, out}, {"convert", study, out});
  EXPECT_EQ(myoid({"settings", "--quiet"}).err, "");
  // The lists of commands name each job once.
  const std::string listed = myoid({"--help"}).out;
  for (const std::string other_name : {"bids", "settings", "update-file"}) {
    EXPECT_THAT(listed, Not(HasSubstr("\n  " + other_name + " "))) << other_name;
    EXPECT_EQ(myoid({other_name, "--help"}).exit_code, 0) << other_name;
  }
}

TEST(CommandLine, InitPrintsEachQuestionWithItsLine) {
  const TemporaryFolder folder;
  const Finished init = myoid({"init", folder / "study", "--from", recording_in(folder)});
  EXPECT_EQ(init.exit_code, 0) << init.err;
  constexpr std::string_view kMark = "# TODO: ";
  std::istringstream file(read_text(folder / "study" / "study.toml"));
  int number = 0, asked = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (!line.starts_with(kMark)) continue;
    ++asked;
    const std::string question = line.substr(kMark.size(), line.find(" [draft") - kMark.size());
    EXPECT_THAT(init.out, HasSubstr("TODO line " + std::to_string(number) + ": " + question + "\n"));
  }
  EXPECT_GT(asked, 0);
}

TEST(CommandLine, HelpOfEveryCommandSucceedsAndShowsAnExample) {
  EXPECT_EQ(myoid({"--help"}).exit_code, 0);
  EXPECT_EQ(myoid({"--version"}).exit_code, 0);
  for (const std::string command : kCommands) {
    const Finished help = myoid({command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_THAT(help.out, HasSubstr("Example: myoid " + command)) << command;
    EXPECT_THAT(myoid({"--help"}).out, HasSubstr(command));
  }
}

TEST(CommandLine, HelpIsAlsoACommand) {
  EXPECT_EQ(myoid({"help"}).out, myoid({"--help"}).out);
  EXPECT_EQ(myoid({}).out, myoid({"--help"}).out);
  for (const std::string command : kCommands) {
    const Finished help = myoid({"help", command});
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(help.out, myoid({command, "--help"}).out) << command;
  }
  const Finished unknown = myoid({"help", "fly"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("there is no command 'fly'"));
}

/// Returns the help with this width of the terminal; empty: the environment does not say.
std::string help_in(const std::vector<std::string>& words, const std::string& columns) {
  myoid::test::Running running(words, "", {"COLUMNS=" + columns});
  return running.wait().out;
}

TEST(CommandLine, HelpFillsTheWidthOfTheTerminal) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"}, {"run", "--help"}, {"identify", "--help"}, {"twin", "--help"}}) {
    for (const auto& [columns, width] : {std::pair{"70", 70}, {"130", 130}, {"", 100}, {"none", 100}}) {
      std::istringstream help(help_in(words, columns));
      int longest = 0;
      for (std::string line; std::getline(help, line);) {
        // A code point has one byte that is no continuation.
        const auto length = std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; });
        longest = std::max(longest, static_cast<int>(length));
      }
      EXPECT_LE(longest, width) << words[0];
      EXPECT_GT(longest, width - 15) << words[0];
    }
  }
}

TEST(CommandLine, HelpGroupsCommandsAndOptions) {
  const std::string all = myoid({"--help"}).out;
  std::size_t at = 0;
  for (const char* next :
       {"One study:\n  demo ", "\n  run ", "Many persons:\n  cohort ", "Single steps", "\n  ik ",
        "OpenSim and other programs:\n  review ", "\n  run-tool ", "Virtual persons", "\n  twin ", "Options:\n"}) {
    at = all.find(next, at);
    ASSERT_NE(at, std::string::npos) << next;
  }
  const std::string info = myoid({"info", "--help"}).out;
  EXPECT_LT(info.find("Options:"), info.find("Page of a model:\n  --html "));
  EXPECT_LT(info.find("Page of a model:"), info.find("Common options:\n  -h,--help "));
  EXPECT_THAT(myoid({"run", "--help"}).out, HasSubstr("Required:\n  --out "));
  EXPECT_THAT(myoid({"design", "--help"}).out, HasSubstr("(1 to 50; default 8)"));
}

TEST(CommandLine, AWrongLineIsToldInTheProgramsOwnWords) {
  using Words = std::vector<std::string>;
  const std::vector<std::pair<Words, std::string>> cases{
      {{"run", "s.toml", "--ouput", "x"}, "unknown option '--ouput'; did you mean --out?"},
      {{"run", "s.toml", "--out", "x", "--overw"}, "unknown option '--overw'; did you mean --overwrite?"},
      {{"run", "s.toml", "--out", "x", "--zzzzzz=1"}, "unknown option '--zzzzzz'; myoid run --help lists them"},
      {{"--vesrion"}, "unknown option '--vesrion'; did you mean --version?"},
      {{"--json", "run", "s.toml"}, "--json stands before the command; options stand behind it: myoid run ... --json"},
      {{"run", "s.toml", "--out"}, "--out needs a value; it is the last word"},
      {{"ik", "--model", "--markers", "m.trc", "--out", "x"},
       "--model needs a value, and behind it stands the option --markers; a value of this name goes as "
       "--model=--markers"},
      {{"run"}, "run needs STUDY and --out; myoid run --help explains them"},
      {{"run", "a.toml", "b.toml", "--out", "x"}, "'b.toml' is one word too many; run takes STUDY"},
      {{"run", "s.toml", "--out", "x", "--json=maybe"}, "--json takes no value; found 'maybe'"},
      {{"run", "s.toml", "--out", "x", "--threads", "many"}, "--threads: found 'many', expected a whole number"},
      {{"run", "s.toml", "--out", "x", "--threads", "5000"},
       "--threads: found '5000', expected a number from 0 to 1024"},
      {{"run", "s.toml", "--out", "x", "--start", "now"}, "--start: found 'now', expected a number"},
      {{"twin", "--protocol", "p", "--out", "x", "--seed", "99999999999999999999"},
       "--seed: found '99999999999999999999', expected a whole number from 0 to 18446744073709551615"},
      {{"run", "s.toml", "--out", "x", "--method", "papr"},
       "--method: found \"papr\" (did you mean 'paper'?), expected one of paper, force, torque"},
      {{"cohort", "d", "o", "all"}, "ANALYSIS_LEVEL: found \"all\", expected one of participant, group"},
      {{"bids", "d", "o"}, "cohort needs ANALYSIS_LEVEL; myoid cohort --help explains it"},
      {{"check"}, "check needs STUDY, or --settings; myoid check --help explains them"},
      {{"check", "s.toml", "--settings"}, "STUDY and --settings exclude each other"},
      {{"id", "--model", "arm4", "--motion", "m", "--out", "x", "--held-at", "1", "2"},
       "--held-at takes 3 values; found 2: 1, 2"},
      {{"info", "arm4", "--motion", "m.mot"}, "--motion has a use only with --html"},
      {{"emg", "e.sto", "--out", "a.sto", "--whitening", "--no-whitening"},
       "--whitening and --no-whitening exclude each other"},
      {{"report"}, "report needs the folder of a run, or --group with several"},
      {{"emg", "e.sto", "--out", "a.sto", "--start", "2", "--end", "1"},
       "--end: expected a time after --start 2, found 1"},
  };
  for (const auto& [words, sentence] : cases) {
    const Finished wrong = myoid(words);
    EXPECT_EQ(wrong.exit_code, 2) << sentence;
    EXPECT_EQ(wrong.err, "error: " + sentence + "\n");
    EXPECT_EQ(wrong.out, "");
  }
  EXPECT_THAT(myoid({"chek", "s.toml"}).err, HasSubstr("there is no command 'chek' (did you mean 'check'?)"));
}

TEST(CommandLine, IsWrongWithExitCodeTwoAndNothingOnStdout) {
  const std::vector<std::vector<std::string>> wrong{{"fly"},
                                                    {"run"},
                                                    {"run", "study.toml"},
                                                    {"twin", "--protocol", "p.toml", "--out", "x", "--colour"},
                                                    {"twin", "--out", "x"},
                                                    {"run", "study.toml", "--out", "x", "--threads", "many"},
                                                    {"identify", "--method", "guess"}};
  for (const auto& arguments : wrong) {
    const Finished finished = myoid(arguments);
    EXPECT_EQ(finished.exit_code, 2) << testing::PrintToString(arguments) << finished.err;
    EXPECT_EQ(finished.out, "");
    EXPECT_NE(finished.err, "");
  }
  // An option that has no effect here is named like any other.
  const Finished seed = myoid({"run", "s.toml", "--out", "x", "--seed", "abc"});
  EXPECT_EQ(seed.exit_code, 2);
  EXPECT_THAT(seed.err, AllOf(HasSubstr("--seed"), HasSubstr("'abc'")));
}

TEST(CommandLine, AnOptionOfOneValueThatIsGivenTwiceIsNamed) {
  const Finished twice = myoid({"check", "a.c3d", "--up", "x", "--up", "z"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_EQ(twice.err, "error: --up is given 2 times (x, z); it takes one value\n");
}

TEST(CommandLine, NumbersOutOfRangeAreRefused) {
  const TemporaryFolder folder;
  write_text(folder / "e.sto", emg_text("EMG microvolt"));
  write_text(folder / "m.mot", ramp_motion("yes"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"twin", "--protocol", kProtocols + "paper.toml", "--seed", "-1", "--out",
                                 folder / "rec"},
        {"identify", "--muscles", "m", "--activations", "a", "--lengths", "l", "--velocities", "v", "--delay", "5",
         "--out", folder / "out"},
        {"emg", folder / "e.sto", "--out", folder / "a.sto", "--start", "1", "--end", "0.5"},
        {"emg", folder / "e.sto", "--out", folder / "a.sto", "--window", "-1"}}) {
    const Finished finished = myoid(arguments);
    EXPECT_EQ(finished.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_NE(finished.err, "");
  }
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"emg", folder / "e.sto", "--out", folder / "a.sto", "--window", "100"},
        {"id", "--model", "arm4", "--motion", folder / "m.mot", "--lowpass", "500", "--out", folder / "id.sto"},
        {"emg", folder / "e.sto", "--out", ""},
        {"emg", folder / "e.sto", "--out", folder / "a.txt"}}) {
    const Finished finished = myoid(arguments);
    EXPECT_EQ(finished.exit_code, 3) << testing::PrintToString(arguments) << finished.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "rec"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.sto"));
}

TEST(Compare, OneFolderWithItselfIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a");
  std::filesystem::create_symlink("a", folder / "b");
  for (const char* second : {"a", "b"}) {
    const Finished compared = myoid({"compare", folder / "a", folder / second});
    EXPECT_EQ(compared.exit_code, 3);
    EXPECT_THAT(compared.err, HasSubstr("are one folder"));
  }
}

TEST(CommandLine, OfACommonOptionWithoutEffectTheHelpIsSilentAndAWarningSpeaks) {
  const TemporaryFolder folder;
  write_text(folder / "e.sto", emg_text("EMG microvolt"));
  EXPECT_THAT(myoid({"check", "--help"}).out, AllOf(HasSubstr("--json"), Not(HasSubstr("--overwrite"))));
  const Finished check = myoid({"check", folder / "e.sto", "--overwrite"});
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_THAT(check.err, HasSubstr("--overwrite has no effect on check"));
}

TEST(CommandLine, JsonOnStdoutIsOneValueFromEveryStage) {
  const TemporaryFolder folder;
  write_text(folder / "e.sto", emg_text("EMG microvolt"));
  write_text(folder / "m.mot", ramp_motion("yes"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"emg", folder / "e.sto", "--out", folder / "a.sto"},
        {"id", "--model", "arm4", "--motion", folder / "m.mot", "--out", folder / "id.sto"},
        {"paths", "--model", "arm4", "--motion", folder / "m.mot", "--out", folder / "paths"},
        {"so", "--model", "arm4", "--motion", folder / "m.mot", "--out", folder / "so"}}) {
    std::vector<std::string> asked = arguments;
    asked.emplace_back("--json");
    const Finished finished = myoid(asked);
    EXPECT_EQ(finished.exit_code, 0) << arguments[0] << finished.err;
    EXPECT_TRUE(finished.out.starts_with("{\n") && finished.out.ends_with("}\n")) << finished.out;
    EXPECT_THAT(finished.out, HasSubstr("\"out\":")) << arguments[0];
  }
}

TEST(CommandLine, AnUnknownModelIsAnsweredWithTheBuiltInOnes) {
  const TemporaryFolder folder;
  write_text(folder / "m.mot", ramp_motion("yes"));
  const Finished unknown = myoid({"id", "--model", "arm26", "--motion", folder / "m.mot", "--out", folder / "id.sto"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("arm26"), HasSubstr("arm4")));
}

TEST(CommandLine, InterruptedItEndsWithHundredAndThirty) {
  const TemporaryFolder folder;
  const Finished twin =
      myoid({"twin", "--protocol", kProtocols + "noise_free.toml", "--seed", "1", "--out", folder / "rec"});
  ASSERT_EQ(twin.exit_code, 0) << twin.err;
  // The whole study takes many seconds, so a signal after one second falls into the work.
  const Finished run = myoid({"run", folder / "rec/study.toml", "--out", folder / "out"}, 1.0);
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("interrupted; "), HasSubstr(folder / "out")));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/parameters.csv"));
}

TEST(Twin, SameSeedGivesTheSameBytesAndAnotherSeedOthers) {
  const TemporaryFolder folder;
  for (const auto& [name, seed] : {std::pair{"a", "7"}, {"b", "7"}, {"c", "8"}}) {
    ASSERT_EQ(myoid({"twin", "--protocol", myoid::test::source_dir() / "examples/demo/protocol.toml", "--seed", seed,
                     "--out", folder / name})
                  .exit_code,
              0);
  }
  int files = 0, differing = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "a")) {
    if (!entry.is_regular_file()) continue;
    const auto relative = std::filesystem::relative(entry.path(), folder / "a");
    const std::string text = read_text(entry.path());
    EXPECT_EQ(text, read_text((folder / "b") / relative)) << relative;
    differing += text != read_text((folder / "c") / relative) ? 1 : 0;
    ++files;
  }
  EXPECT_GT(files, 10);
  EXPECT_GT(differing, files / 2);
}

}  // namespace
