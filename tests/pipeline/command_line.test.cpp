// What the program answers to a wrong command line, to files that are not what they should be, and to Ctrl-C.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
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

/// One second of elbow flexion from 0 to 90 degrees, written in degrees under this header value.
std::string ramp_motion(const std::string& in_degrees) {
  std::string text =
      "Coordinates\nversion=1\nnRows=101\nnColumns=2\ninDegrees=" + in_degrees + "\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i <= 100; ++i) text += std::to_string(0.01 * i) + "\t" + std::to_string(0.9 * i) + "\n";
  return text;
}

/// A short virtual recording in `folder`/rec.
std::filesystem::path recording_in(const TemporaryFolder& folder) {
  write_text(folder / "protocol.toml",
             "name = \"short\"\nlevel = \"L0\"\n[motion]\nrate_hz = 100\n[[trial]]\nname = "
             "\"slow\"\nkind = \"flexion\"\nfrequency_hz = 0.5\n"
             "centre_deg = 72\namplitude_deg = 40\nheld_mass_kg = 1.0\nduration_s = 4\n");
  const Finished twin = myoid({"twin", "--protocol", folder / "protocol.toml", "--seed", "1", "--out", folder / "rec"});
  EXPECT_EQ(twin.exit_code, 0) << twin.err;
  return folder / "rec";
}

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

TEST(CommandLine, AWrongPathIsNamedWithExitCodeThree) {
  const TemporaryFolder folder;
  const std::string missing = folder / "missing.toml";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", missing, "--out", folder / "out"},
        {"check", missing},
        {"info", missing},
        {"twin", "--protocol", missing, "--out", folder / "out"},
        {"ik", "--model", missing, "--markers", missing, "--out", folder / "ik.mot"}}) {
    const Finished finished = myoid(arguments);
    EXPECT_EQ(finished.exit_code, 3) << arguments[0] << finished.err;
    EXPECT_THAT(finished.err, AllOf(HasSubstr("error: "), HasSubstr(missing))) << arguments[0];
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments[0] << " left a folder behind";
  }
}

TEST(CommandLine, WhoNamesARecordingOrAFolderForAStudyIsLedToInit) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  std::filesystem::copy_file(rec / "slow.trc", folder / "my lift.trc");
  const std::string recording = folder / "my lift.trc";
  const auto leads = [](const std::string& to) { return HasSubstr("myoid init STUDY --from " + to); };
  const Finished run = myoid({"run", recording, "--out", folder / "out"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, leads("'" + recording + "'"));
  EXPECT_THAT(myoid({"check", recording}).out, leads("'" + recording + "'\n"));
  std::filesystem::create_directory(folder / "lifts");
  const std::string lifts = folder / "lifts";
  EXPECT_EQ(myoid({"info", lifts}).exit_code, 3);  // no recording: nothing to draft a study of
  std::filesystem::copy_file(recording, folder / "lifts/lift.trc");
  EXPECT_THAT(myoid({"run", lifts, "--out", folder / "out"}).err, leads(lifts));
  EXPECT_THAT(myoid({"info", lifts}).err, leads(lifts));
  EXPECT_THAT(myoid({"run", rec, "--out", folder / "out"}).err, HasSubstr("study.toml"));
}

TEST(CommandLine, ACheckNamesTheNextCommand) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  const std::string study = rec / "study.toml";
  const std::string next = "next: myoid run " + study + " --out ";
  EXPECT_THAT(myoid({"check", study}).out, testing::EndsWith(next + (rec / "results").string() + "\n"));
  EXPECT_THAT(myoid({"check", study, "--json"}).out, Not(HasSubstr("next:")));
  replace_in(study, "emg = \"BIC\"", "emg = \"TODO\"");
  const Finished wrong = myoid({"check", study});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_THAT(wrong.out, testing::EndsWith("myoid check " + study + "\n"));
}

TEST(CommandLine, AnEmptyFileIsNamedWithExitCodeThree) {
  const TemporaryFolder folder;
  for (const std::string name : {"empty.toml", "empty.trc", "empty.sto", "empty.osim", "empty.csv"}) {
    write_text(folder / name, "");
    const Finished finished =
        name == "empty.toml" ? myoid({"run", folder / name, "--out", folder / "out"}) : myoid({"info", folder / name});
    EXPECT_EQ(finished.exit_code, 3) << name << finished.err;
    EXPECT_THAT(finished.err, HasSubstr(name));
  }
}

TEST(CommandLine, AnEmptyMarkerFileOfAStudyIsNamed) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  write_text(rec / "slow.trc", "");
  const Finished check = myoid({"check", rec / "study.toml"});
  EXPECT_EQ(check.exit_code, 3);
  EXPECT_THAT(check.out, HasSubstr("slow.trc"));
}

TEST(CommandLine, AMissingEmgColumnIsNamedWithWhatWasFoundAndWhatToDo) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  replace_in(rec / "study.toml", "emg = \"TRI\"", "emg = \"TRIC\"");
  const auto message = AllOf(HasSubstr("slow_emg.sto"), HasSubstr("no EMG channel 'TRIC'"), HasSubstr("found"),
                             HasSubstr("BRD"), HasSubstr("did you mean 'TRI'?"), HasSubstr("in the study"));
  const Finished check = myoid({"check", rec / "study.toml"});
  EXPECT_EQ(check.exit_code, 3);
  EXPECT_THAT(check.out, message);
  const Finished run = myoid({"run", rec / "study.toml", "--out", folder / "out"});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_THAT(run.err, message);
}

TEST(CommandLine, DegreesThatAreCalledRadiansAreNoticed) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  write_text(folder / "motion.mot", ramp_motion("no"));
  replace_in(rec / "study.toml", "markers = \"slow.trc\"", "motion = \"../motion.mot\"");
  const Finished run = myoid({"run", rec / "study.toml", "--out", folder / "out"});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("motion.mot"), HasSubstr("elbow_flexion"), HasSubstr("reaches 90"),
                             HasSubstr("these are degrees"), HasSubstr("inDegrees=yes")));
}

TEST(CommandLine, ATrialWithoutEmgIsNamed) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  replace_in(rec / "study.toml", "emg = \"slow_emg.sto\"\n", "");
  const Finished run = myoid({"run", rec / "study.toml", "--out", folder / "out"});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("study.toml"), HasSubstr("slow"), HasSubstr("emg")));
}

TEST(CommandLine, ResultsAreNotOverwrittenUnasked) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  const std::string before = read_text(rec / "study.toml");
  const Finished again = myoid({"twin", "--protocol", folder / "protocol.toml", "--seed", "2", "--out", rec});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_THAT(again.err, HasSubstr("--overwrite"));
  EXPECT_EQ(read_text(rec / "study.toml"), before);
  EXPECT_EQ(
      myoid({"twin", "--protocol", folder / "protocol.toml", "--seed", "2", "--out", rec, "--overwrite"}).exit_code, 0);
}

TEST(CommandLine, StderrIsEmptyWhenQuietAndAFailureIsStillSaid) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  const Finished check = myoid({"check", rec / "study.toml", "--quiet"});
  EXPECT_EQ(check.exit_code, 0) << check.out;
  EXPECT_EQ(check.err, "");
  EXPECT_NE(myoid({"check", folder / "none.toml", "--quiet"}).err, "");
}

/// Two channels of EMG with this title and a swelling amplitude, 2 s at 1 kHz.
std::string emg_text(const std::string& title) {
  std::string text = title + "\nversion=1\nnRows=2000\nnColumns=3\nendheader\ntime\tBIC\tTRI\n";
  for (int i = 0; i < 2000; ++i) {
    const int x = ((i * 7919) % 200 - 100) * (1 + i / 200);
    text += std::to_string(0.001 * i) + "\t" + std::to_string(x) + "\t" + std::to_string(-x) + "\n";
  }
  return text;
}

TEST(CommandLine, AResultNeverReplacesItsInput) {
  const TemporaryFolder folder;
  write_text(folder / "e.sto", emg_text("EMG microvolt"));
  std::filesystem::create_symlink("e.sto", folder / "link.sto");
  for (const std::string out : {"e.sto", "link.sto"}) {
    const Finished emg = myoid({"emg", folder / "e.sto", "--out", folder / out, "--overwrite"});
    EXPECT_EQ(emg.exit_code, 3) << out;
    EXPECT_THAT(emg.err, HasSubstr("is an input of this command"));
  }
  EXPECT_EQ(read_text(folder / "e.sto"), emg_text("EMG microvolt"));
  write_text(folder / "m.mot", ramp_motion("yes"));
  const Finished id =
      myoid({"id", "--model", "arm4", "--motion", folder / "m.mot", "--out", folder / "m.mot", "--overwrite"});
  EXPECT_EQ(id.exit_code, 3);
  EXPECT_EQ(read_text(folder / "m.mot"), ramp_motion("yes"));
}

TEST(CommandLine, AFolderThatIsMadeForAResultIsSaid) {
  const TemporaryFolder folder;
  write_text(folder / "e.sto", emg_text("EMG microvolt"));
  const Finished emg = myoid({"emg", folder / "e.sto", "--out", folder / "new/a.sto"});
  EXPECT_EQ(emg.exit_code, 0) << emg.err;
  EXPECT_THAT(emg.err, AllOf(HasSubstr((folder / "new").string()), HasSubstr("it was made")));
  // Once, whatever the number of files; and not at all where nothing was made.
  const Finished two =
      myoid({"emg", folder / "e.sto", "--out", folder / "two/a.sto", "--envelope", folder / "two/e.sto"});
  EXPECT_EQ(two.exit_code, 0) << two.err;
  EXPECT_EQ(two.err.find("it was made"), two.err.rfind("it was made"));
  const Finished none = myoid({"emg", folder / "none.sto", "--out", folder / "three/a.sto"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, Not(HasSubstr("three")));
}

TEST(CommandLine, AResultThatStandardOutputLosesIsAnError) {
  const TemporaryFolder folder;
  write_text(folder / "e.sto", emg_text("EMG microvolt"));
  EXPECT_EQ(myoid({"info", folder / "e.sto"}).exit_code, 0);
  const Finished lost = myoid({"info", folder / "e.sto"}, 0.0, "/dev/full");
  EXPECT_EQ(lost.exit_code, 3);
  EXPECT_THAT(lost.err, AllOf(HasSubstr("standard output"), HasSubstr("No space left")));
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

TEST(Info, NamesTheToolOfASetUpAndTheCommandThatRunsIt) {
  const TemporaryFolder folder;
  write_text(folder / "ik.xml",
             "<OpenSimDocument Version=\"40000\"><InverseKinematicsTool name=\"walk\"><model_file>Unassigned"
             "</model_file><marker_file>lost.trc</marker_file></InverseKinematicsTool></OpenSimDocument>\n");
  const Finished done = myoid({"info", folder / "ik.xml"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("InverseKinematicsTool"), HasSubstr("myoid run-tool"), HasSubstr("missing (1)"),
                              HasSubstr("lost.trc")));
}

TEST(Info, SaysTheUnitOfEmgThatTheTitleStatesAndNothingOfAngles) {
  const TemporaryFolder folder;
  write_text(folder / "e.sto", emg_text("EMG microvolt"));
  write_text(folder / "m.mot", ramp_motion("yes"));
  EXPECT_THAT(myoid({"info", folder / "e.sto"}).out, AllOf(HasSubstr("emg unit: uV"), Not(HasSubstr("angles"))));
  EXPECT_THAT(myoid({"info", folder / "m.mot"}).out, AllOf(HasSubstr("angles: degrees"), Not(HasSubstr("emg unit"))));
}

TEST(CommandLine, TheUnitThatAnEmgFileStatesHoldsWithAWarning) {
  const TemporaryFolder folder;
  write_text(folder / "e.sto", emg_text("EMG microvolt"));
  const Finished as_said = myoid({"emg", folder / "e.sto", "--out", folder / "a.sto"});
  const Finished other = myoid({"emg", folder / "e.sto", "--unit", "V", "--out", folder / "a.sto", "--overwrite"});
  EXPECT_EQ(other.out, as_said.out);
  EXPECT_THAT(other.err, AllOf(HasSubstr("warning"), HasSubstr("is not used")));
}

TEST(CommandLine, WhatAReaderLeftOutIsSaidByTheStagesThatReadSeries) {
  const TemporaryFolder folder;
  write_text(folder / "m.mot", ramp_motion("yes"));
  std::string cut = "EMG\nendheader\ntime\tBIC\tBRA\tBRD\tTRI\n";
  for (int i = 0; i <= 110; ++i) cut += std::to_string(0.01 * i) + "\t0.10\t0.10\t0.10\t0.10\n";
  cut.resize(cut.size() - 3);
  write_text(folder / "cut.sto", cut);
  const Finished so = myoid({"so", "--model", "arm4", "--motion", folder / "m.mot", "--out", folder / "so", "--emg",
                             folder / "cut.sto", "--emg-weight", "1"});
  EXPECT_EQ(so.exit_code, 0) << so.err;
  EXPECT_THAT(so.err, AllOf(HasSubstr("cut.sto:114"), HasSubstr("left out")));
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

TEST(CommandLine, ACutResultHasTheNumbersOfTheWholeFile) {
  const TemporaryFolder folder;
  std::string motion = "m\nversion=1\ninDegrees=yes\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i <= 200; ++i)
    motion += std::to_string(0.01 * i) + "\t" + std::to_string(60.0 + 30.0 * std::sin(0.1 * i)) + "\n";
  write_text(folder / "m.mot", motion);
  const auto id = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> arguments{"id",        "--model", "arm4",  "--motion",  folder / "m.mot",
                                       "--lowpass", "6",       "--out", folder / out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = myoid(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return read_text(folder / out);
  };
  const std::string whole = id("whole.sto", {});
  const std::string part = id("part.sto", {"--start", "0.5", "--end", "0.7"});
  const std::size_t first = part.find("\n0.5\t");
  ASSERT_NE(first, std::string::npos) << part;
  EXPECT_THAT(whole, HasSubstr(part.substr(first)));
}

TEST(CommandLine, AWarningOfAnInputIsSaidByCheckAndByRun) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  std::string motion = "m\nversion=1\ninDegrees=yes\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i <= 400; ++i) {
    if (i > 100 && i < 130) continue;
    motion += std::to_string(0.01 * i) + "\t" + std::to_string(60.0 + 30.0 * std::sin(0.03 * i)) + "\n";
  }
  write_text(folder / "motion.mot", motion);
  replace_in(rec / "study.toml", "markers = \"slow.trc\"", "motion = \"../motion.mot\"");
  const auto gap = HasSubstr("a gap from 1 to 1.3 s in its clock");
  const Finished check = myoid({"check", rec / "study.toml"});
  EXPECT_THAT(check.out, AllOf(HasSubstr("warning"), gap));
  const Finished run = myoid({"run", rec / "study.toml", "--out", folder / "out"});
  EXPECT_THAT(run.err, AllOf(HasSubstr("warning"), HasSubstr("trial slow"), gap));
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
