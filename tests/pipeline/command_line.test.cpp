// What the program answers to a wrong command line, to files that are not what they should be, and
// to Ctrl-C.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
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

const std::string kProtocols = MYOID_SOURCE_DIR "/examples/protocols/";

constexpr const char* kCommands[] = {"run",  "check",  "info",   "emg", "ik",
                                     "id",   "muscle", "paths",  "so",  "identify",
                                     "twin", "report", "convert"};

/// One second of elbow flexion from 0 to 90 degrees, written in degrees under this header value.
std::string ramp_motion(const std::string& in_degrees) {
  std::string text = "Coordinates\nversion=1\nnRows=101\nnColumns=2\ninDegrees=" + in_degrees +
                     "\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i <= 100; ++i)
    text += std::to_string(0.01 * i) + "\t" + std::to_string(0.9 * i) + "\n";
  return text;
}

/// A short virtual recording in `folder`/rec.
std::filesystem::path recording_in(const TemporaryFolder& folder) {
  write_text(folder / "protocol.toml",
             "name = \"short\"\nlevel = \"L0\"\n[motion]\nrate_hz = 100\n[[trial]]\nname = "
             "\"slow\"\nkind = \"flexion\"\nfrequency_hz = 0.5\n"
             "centre_deg = 72\namplitude_deg = 40\nheld_mass_kg = 1.0\nduration_s = 4\n");
  const Finished twin = myoid(
      {"twin", "--protocol", folder / "protocol.toml", "--seed", "1", "--out", folder / "rec"});
  EXPECT_EQ(twin.exit_code, 0) << twin.err;
  return folder / "rec";
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

TEST(CommandLine, IsWrongWithExitCodeTwoAndNothingOnStdout) {
  const std::vector<std::vector<std::string>> wrong{
      {"fly"},
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
    EXPECT_FALSE(std::filesystem::exists(folder / "out"))
        << arguments[0] << " left a folder behind";
  }
}

TEST(CommandLine, AnEmptyFileIsNamedWithExitCodeThree) {
  const TemporaryFolder folder;
  for (const std::string name :
       {"empty.toml", "empty.trc", "empty.sto", "empty.osim", "empty.csv"}) {
    write_text(folder / name, "");
    const Finished finished = name == "empty.toml"
                                  ? myoid({"run", folder / name, "--out", folder / "out"})
                                  : myoid({"info", folder / name});
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
  const auto message =
      AllOf(HasSubstr("slow_emg.sto"), HasSubstr("no EMG channel 'TRIC'"), HasSubstr("found"),
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
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("motion.mot"), HasSubstr("elbow_flexion"), HasSubstr("reaches 90"),
                    HasSubstr("degrees, not radians"), HasSubstr("inDegrees=yes")));
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
  const Finished again =
      myoid({"twin", "--protocol", folder / "protocol.toml", "--seed", "2", "--out", rec});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_THAT(again.err, HasSubstr("--overwrite"));
  EXPECT_EQ(read_text(rec / "study.toml"), before);
  EXPECT_EQ(myoid({"twin", "--protocol", folder / "protocol.toml", "--seed", "2", "--out", rec,
                   "--overwrite"})
                .exit_code,
            0);
}

TEST(CommandLine, StderrIsEmptyWhenQuietAndAFailureIsStillSaid) {
  const TemporaryFolder folder;
  const auto rec = recording_in(folder);
  const Finished check = myoid({"check", rec / "study.toml", "--quiet"});
  EXPECT_EQ(check.exit_code, 0) << check.out;
  EXPECT_EQ(check.err, "");
  EXPECT_NE(myoid({"check", folder / "none.toml", "--quiet"}).err, "");
}

TEST(CommandLine, InterruptedItEndsWithHundredAndThirty) {
  const TemporaryFolder folder;
  const Finished twin = myoid({"twin", "--protocol", kProtocols + "noise_free.toml", "--seed", "1",
                               "--out", folder / "rec"});
  ASSERT_EQ(twin.exit_code, 0) << twin.err;
  // The whole study takes many seconds, so a signal after one second falls into the work.
  const Finished run = myoid({"run", folder / "rec/study.toml", "--out", folder / "out"}, 1.0);
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_THAT(run.err, HasSubstr("interrupted"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/parameters.csv"));
}

TEST(Twin, SameSeedGivesTheSameBytesAndAnotherSeedOthers) {
  const TemporaryFolder folder;
  for (const auto& [name, seed] : {std::pair{"a", "7"}, {"b", "7"}, {"c", "8"}}) {
    ASSERT_EQ(myoid({"twin", "--protocol", MYOID_SOURCE_DIR "/examples/demo/protocol.toml",
                     "--seed", seed, "--out", folder / name})
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
