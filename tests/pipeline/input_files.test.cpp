// The program names wrong input files with a remedy, and lists the result files.
#include <filesystem>
#include <string>
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

}  // namespace
