#include "myoid/study/draft/draft_recordings.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/record_list.h"
#include "myoid/recording/series_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

TEST(TrialStem, IsTheNameWithoutWhatAFileSaysOfItsOwnKind) {
  EXPECT_EQ(trial_stem("a/Flex_2kg_emg_raw_uV.sto"), "flex_2kg");
  EXPECT_EQ(trial_stem("load2p75_T1_imu_landmarks.trc"), "load2p75_t1");
  EXPECT_EQ(trial_stem("in/walk36/ik.sto"), "walk36");
  EXPECT_EQ(trial_stem("in/walk36/emgFilt.sto"), "walk36");
  EXPECT_EQ(trial_stem("emg_walk_raw.anc"), "walk");
  EXPECT_EQ(trial_stem("grf_walk.xml"), "walk");
  EXPECT_EQ(trial_stem("Pas_-10_dynamometer.csv"), "pas_-10");  // the sign of an angle
  EXPECT_EQ(trial_stem("Walk-10_ik.csv"), "walk_10");
  EXPECT_EQ(trial_stem("Walk 01_trajectories.csv"), trial_stem("Walk 01_devices.csv"));
}

TEST(GuessedUse, IsWhatAWordOfTheNameSays) {
  EXPECT_EQ(guessed_use("mvc_biceps"), Use::mvc);
  EXPECT_EQ(guessed_use("static_1"), Use::static_pose);
  EXPECT_EQ(guessed_use("relaxed_elbow"), Use::passive);
  EXPECT_EQ(guessed_use("pas_-10"), Use::passive);
  EXPECT_EQ(guessed_use("rest_2"), Use::passive);
  EXPECT_EQ(guessed_use("arrest"), Use::calibration);
  EXPECT_EQ(guessed_use("subject_1_mvt_random"), Use::calibration);
}

TEST(RecordingsIn, AFolderAreThoseWithAKnownEndingInItAndItsFolders) {
  const test::TemporaryFolder folder;
  for (const char* name : {"b.trc", "a.sto", "c.txt", "notes.md", "sub/d.edf", "m.osim"})
    write_file(folder / name, "x");
  write_file(folder / "grf_walk.xml",
             "<OpenSimDocument><ExternalLoads name=\"g\"><datafile>grf\\walk.mot"
             "</datafile></ExternalLoads></OpenSimDocument>");
  write_file(folder / "setup.xml", "<OpenSimDocument><IKTool/></OpenSimDocument>");
  FoundBeside beside;
  const auto files = recordings_in({folder.path()}, beside);
  ASSERT_EQ(beside.external_loads.size(), 1U);
  EXPECT_EQ(loads_data_file(beside.external_loads[0]), folder / "grf/walk.mot");
  ASSERT_EQ(files.size(), 4U);
  EXPECT_EQ(files[0].filename(), "a.sto");
  EXPECT_EQ(files[2].filename(), "c.txt");
  EXPECT_EQ(files[3].filename(), "d.edf");
  EXPECT_EQ(beside.models.size(), 1U);
}

TEST(RecordingsIn, AFolderAreNoResultsOfThisProgram) {
  const test::TemporaryFolder folder;
  for (const char* name : {"lab/a.trc", "lab/truth/a.sto", "done/a/ik.sto", "mine/truth/b.trc", "ik/c.sto"})
    write_file(folder / name, "x");
  const auto list = [&](const char* in, const std::vector<std::string>& names, const std::string& command = "") {
    std::string text = std::string(kSignature) + (command.empty() ? "" : fmt::format("{}{}\n", kBy, command));
    for (const std::string& name : names) text += record_line(std::string(64, '0'), name) + "\n";
    write_file(folder / in / kRecordFile, text);
  };
  list("lab", {"a.trc", "truth/a.sto"});
  list("done", {"parameters.json", "a/ik.sto"});
  list("ik", {"c.sto"});  // a motion that a command computed is one
  FoundBeside beside;
  const auto files = recordings_in({folder.path()}, beside);
  EXPECT_THAT(files, ::testing::ElementsAre(folder / "ik/c.sto", folder / "lab/a.trc", folder / "mine/truth/b.trc"));
  EXPECT_THAT(beside.results, ::testing::UnorderedElementsAre(folder / "lab/truth", folder / "done"));
}

TEST(RecordingsIn, AFolderThatIsNamedAreItsFilesButResults) {
  const test::TemporaryFolder folder;
  for (const char* name : {"own.trc", "a/ik.sto", "paths/r.sto"}) write_file(folder / name, "x");
  const std::string hash(64, '0');
  write_file(folder.path() / kRecordFile,
             fmt::format("{}{}run\n{}\n{}convert\n{}\n", kSignature, kBy, record_line(hash, "a/ik.sto"), kBy,
                         record_line(hash, "own.trc")));
  write_file(folder.path() / "paths" / kRecordFile,
             fmt::format("{}{}paths\n{}\n", kSignature, kBy, record_line(hash, "r.sto")));
  FoundBeside beside;
  EXPECT_THAT(recordings_in({folder.path()}, beside), ::testing::ElementsAre(folder / "own.trc"));
  EXPECT_THAT(beside.results, ::testing::UnorderedElementsAre(folder.path(), folder / "paths"));
}

TEST(FindEmg, VoltagesThatGoThroughTheirMedianOftenAreRaw) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1000, 0.0, 0.999);
  Eigen::MatrixXd x(1000, 2);
  x.col(0) = 3.0 + (700.0 * t.array()).sin();
  x.col(1).setOnes();
  FoundRecording found;
  find_emg("a.csv", TimeSeries(t, {{"BIC", Unit::volt}, {"Fz", Unit::newton}}, x), {}, found);
  EXPECT_EQ(found.channels, std::vector<std::string>{"BIC"});
  EXPECT_TRUE(found.raw);
  FoundRecording unused;  // channels without an electrode do not vote
  Eigen::MatrixXd zeros = Eigen::MatrixXd::Zero(1000, 3);
  zeros.col(1) = x.col(0);
  find_emg("a.csv", TimeSeries(t, {{"A", Unit::volt}, {"B", Unit::volt}, {"C", Unit::volt}}, zeros), {}, unused);
  EXPECT_TRUE(unused.raw);
  FoundRecording envelope;
  const Eigen::VectorXd slow = 1.0 + (20.0 * t.array()).sin();
  find_emg("a.csv", TimeSeries(t, {{"BIC", Unit::volt}}, slow), {}, envelope);
  EXPECT_FALSE(envelope.raw);
}

TEST(FindEmg, ATitleOrTheNamesOfChannelsSayThatItIsEmg) {
  const test::TemporaryFolder folder;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1000, 0.0, 0.999);
  Eigen::MatrixXd x(1000, 2);
  x.col(0) = 1.0 + (20.0 * t.array()).sin();
  x.col(1) = 1.0 + (15.0 * t.array()).sin();
  const TimeSeries two(t, {{"soleus", Unit::dimensionless}, {"gastrocnemius", Unit::dimensionless}}, x);
  for (const char* title : {"Electromyography", "Forces"}) {
    recording::write_series(folder / "walk.sto", two, title);
    FoundRecording found;
    find_emg(folder / "walk.sto", two, {}, found);
    EXPECT_EQ(found.channels.size(), title[0] == 'E' ? 2U : 0U) << title;
    EXPECT_FALSE(found.has_unit);
  }
  FoundRecording named;
  find_emg("walk.csv",
           TimeSeries(t, {{"EMG 01 (54717) EMG 1", Unit::dimensionless}, {"EMG 01 ACC X", Unit::dimensionless}}, x), {},
           named);
  EXPECT_EQ(named.channels, std::vector<std::string>{"EMG 01 (54717) EMG 1"});
}

}  // namespace
}  // namespace myoid::study
