#include "myoid/study/draft/draft_persons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::study {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> persons_of(const std::vector<std::string>& files, bool with_markers = false) {
  std::vector<FoundRecording> found;
  for (const std::string& file : files) {
    FoundRecording f;
    f.path = file;
    f.stem = trial_stem(file);
    if (with_markers) {
      f.markers.names = {"m"};
      f.markers.time_s.setZero(1);
      f.markers.positions_m.setZero(1, 3);
    }
    found.push_back(f);
  }
  return persons_in(found);
}

TEST(DraftPersons, AreStatedByNamesOfFilesOrFolders) {
  EXPECT_THAT(persons_of({"/d/sub-01/emg/sub-01_task-walk_emg.edf", "/d/sub-cp2/motion/sub-cp2_task-walk_motion.tsv"}),
              ElementsAre("sub-01", "sub-cp2"));
  EXPECT_THAT(persons_of({"/d/subject_1_abd.trc", "/d/subject_2_abd.trc", "/d/subject_2_flex.trc"}),
              ElementsAre("subject_1", "subject_2"));
  EXPECT_THAT(persons_of({"/d/Participant 3/walk.trc", "/d/Participant 12/walk.trc"}),
              ElementsAre("Participant 12", "Participant 3"));
  EXPECT_THAT(persons_of({"/d/subject_1/Subject01_walk.trc", "/d/subject_1/static.trc"}), ElementsAre("Subject01"));
}

TEST(DraftPersons, AreNumbersThatSeveralTrialsShare) {
  EXPECT_THAT(persons_of({"/d/01_knee_emg.csv", "/d/01_hip_emg.csv", "/d/17_knee_emg.csv", "/d/17_hip_emg.csv"}),
              ElementsAre("01", "17"));
  EXPECT_THAT(persons_of({"/d/P01/walk.trc", "/d/P01/run.trc", "/d/P02/walk.trc", "/d/P02/run.trc"}),
              ElementsAre("P01", "P02"));
}

TEST(DraftPersons, AFileThatNamesNobodyBesideMoreThatNameOneIsAskedFor) {
  const auto unnamed_of = [](const std::vector<std::string>& files) {
    std::vector<FoundRecording> found;
    for (const std::string& file : files) found.emplace_back().path = file;
    return keep_one_person(found).unnamed;
  };
  EXPECT_THAT(unnamed_of({"/d/subject_1_abd.trc", "/d/subject_1_flex.trc", "/d/live_abd.trc"}),
              ElementsAre("/d/live_abd.trc"));
  EXPECT_THAT(unnamed_of({"/d/subject_1_abd.trc", "/d/flex.trc"}), IsEmpty());
  EXPECT_THAT(unnamed_of({"/d/abd.trc", "/d/flex.trc"}), IsEmpty());
}

TEST(DraftPersons, AreFoldersWhoseTrialsHaveTheSameNames) {
  EXPECT_THAT(
      persons_of({"/d/Anna M/lift 2 kg.c3d", "/d/Anna M/mvc.c3d", "/d/Bob/lift 2 kg.c3d", "/d/Bob/mvc.c3d"}, true),
      ElementsAre("Anna M", "Bob"));
  // Folders of one trial each; folders that are not side by side; other trials of the same person.
  EXPECT_THAT(persons_of({"/d/walk/markers.trc", "/d/run/markers.trc"}, true), IsEmpty());
  EXPECT_THAT(persons_of({"/d/a/x/lift.c3d", "/d/a/x/mvc.c3d", "/d/b/y/lift.c3d", "/d/b/y/mvc.c3d"}, true), IsEmpty());
  EXPECT_THAT(persons_of({"/d/day1/lift.c3d", "/d/day1/mvc.c3d", "/d/day2/throw.c3d", "/d/day2/mvc.c3d"}, true),
              IsEmpty());
  EXPECT_THAT(persons_of({"/d/walk36/ik.sto", "/d/walk36/id.sto", "/d/walk45/ik.sto", "/d/walk45/id.sto"}), IsEmpty());
}

// Numbers of trials, loads and repetitions of one person.
TEST(DraftPersons, AreNotTheNumbersOfTrials) {
  EXPECT_THAT(
      persons_of({"/d/01_walk_markers.trc", "/d/01_walk_emg.csv", "/d/02_walk_markers.trc", "/d/02_walk_emg.csv"}),
      IsEmpty());
  EXPECT_THAT(persons_of({"/d/walk36/ik.sto", "/d/walk45/ik.sto", "/d/walk36/emgFilt.sto", "/d/walk45/emgFilt.sto"}),
              IsEmpty());
  EXPECT_THAT(persons_of({"/d/load2p75_T1_elbow.mot", "/d/load2p75_T2_elbow.mot", "/d/load5p5_T1_elbow.mot"}),
              IsEmpty());
  EXPECT_THAT(persons_of({"/d/1/ik.mot", "/d/1/emg.csv", "/d/2/ik.mot", "/d/2/emg.csv"}), IsEmpty());
}

}  // namespace
}  // namespace myoid::study
