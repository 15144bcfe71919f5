#include "myoid/study/trial_table.h"

#include <string>

#include <gtest/gtest.h>

#include "myoid/study/setting_reader.h"

#include "tests/support/message_of.h"

namespace myoid::study {
namespace {

TrialSpec trial_of(const std::string& text) {
  const toml::table root = parse_toml(text, "dir/study.toml");
  return read_spec<TrialSpec>({root, "dir/study.toml", "[[trial]]"}, "dir");
}

std::string trial_message(const std::string& text) {
  return test::message_of([&] { (void)trial_of(text); });
}

const std::string kTrial = "name = \"t1\"\nmarkers = \"a/t1.trc\"\nemg = \"t1.sto\"\n";

TEST(TrialTable, PathsAreResolvedAgainstTheFolder) {
  EXPECT_EQ(trial_of(kTrial).markers, "dir/a/t1.trc");
  EXPECT_EQ(trial_of(kTrial).emg, "dir/t1.sto");
}

TEST(TrialTable, ATrialWithoutEmgIsRefusedWithTheRemedy) {
  const std::string message = trial_message("name = \"t1\"\nmarkers = \"a.trc\"\n");
  EXPECT_NE(message.find("dir/study.toml:1"), std::string::npos) << message;
  EXPECT_NE(message.find("'t1' has no 'emg'"), std::string::npos) << message;
  EXPECT_EQ(trial_message("name = \"t1\"\nmarkers = \"a.trc\"\nuse = \"static\"\n"), "(no error)");
}

TEST(TrialTable, AMaximalContractionIsFittedWhereItsTorqueAndPostureAreMeasured) {
  Study study;
  const auto fitted = [&](const std::string& more) {
    return study.fits(trial_of("name = \"t1\"\nemg = \"t1.sto\"\nuse = \"mvc\"\n" + more));
  };
  EXPECT_FALSE(fitted(""));
  EXPECT_FALSE(fitted("markers = \"a.trc\"\n"));
  EXPECT_FALSE(fitted("external_torque = \"m.sto\"\n"));
  EXPECT_TRUE(fitted("markers = \"a.trc\"\nexternal_torque = \"m.sto\"\n"));
  EXPECT_TRUE(fitted("motion = \"a.mot\"\nload_cell = \"m.sto\"\n"));
  EXPECT_TRUE(study.fits(trial_of(kTrial)));
  EXPECT_TRUE(study.fits(trial_of(kTrial + "use = \"isometric\"\n")));
  for (const char* use : {"validation", "static", "passive"})
    EXPECT_FALSE(study.fits(trial_of(kTrial + "external_torque = \"m.sto\"\nuse = \"" + use + "\"\n"))) << use;
  study.model.more_coordinates = {"knee_angle"};
  EXPECT_FALSE(fitted("markers = \"a.trc\"\nexternal_torque = \"m.sto\"\n")) << "a dynamometer measures one joint";
  EXPECT_TRUE(fitted("markers = \"a.trc\"\nload_cell = \"m.sto\"\n"));
}

const std::string kGiven =
    "name = \"t1\"\nemg = \"a.sto\"\nlengths = \"l.sto\"\nmoment_arms = \"r.sto\"\ntorques = \"id.sto\"\n";

TEST(TrialTable, ATrialThatGivesPathsAndTorquesNeedsNoMotion) {
  const TrialSpec trial = trial_of(kGiven);
  EXPECT_EQ(trial.given.lengths, "dir/l.sto");
  EXPECT_EQ(trial.given.moment_arms, std::vector<std::filesystem::path>{"dir/r.sto"});
  EXPECT_TRUE(trial.given.needs_no_body());
  EXPECT_TRUE(trial.moves());
  EXPECT_EQ(trial_message("name = \"t1\"\nemg = \"a.sto\"\nlengths = \"l.sto\"\nforces = \"f.sto\"\n"), "(no error)");
  EXPECT_NE(trial_message("name = \"t1\"\nemg = \"a.sto\"\nlengths = \"l.sto\"\n").find("moment_arms"),
            std::string::npos);
  EXPECT_NE(trial_message(kGiven + "use = \"passive\"\n").find("neither"), std::string::npos);
  EXPECT_TRUE(Study{}.fits(trial_of(kGiven + "use = \"mvc\"\n")));
}

TEST(TrialTable, TorquesOfTheMusclesExcludeWhatTheyWouldBeComputedFrom) {
  for (const char* more : {"external_torque = \"m.sto\"\n", "external_loads = \"l.xml\"\n", "held_mass_kg = 2\n"}) {
    const std::string message = trial_message(kGiven + more);
    EXPECT_NE(message.find("dir/study.toml:5"), std::string::npos) << message;
  }
  EXPECT_EQ(trial_message(kGiven + "held_mass_kg = 0\n"), "(no error)");
  EXPECT_NE(trial_message(kTrial + "velocities = \"v.sto\"\n").find("dir/study.toml:4"), std::string::npos);
}

TEST(TrialTable, AnEndBeforeTheStartIsRefused) {
  EXPECT_NE(trial_message(kTrial + "start_s = 10\nend_s = 5\n").find("after start_s = 10 s"), std::string::npos);
}

TEST(TrialTable, AnyTextThatCanBeSeenIsAName) {
  const auto message_for = [](const std::string& name) {
    return trial_message("name = \"" + name + "\"\nmotion = \"a.mot\"\nemg = \"e.sto\"\n");
  };
  for (const char* name : {"../t", "a/b", ".", "figures", "slow 2 kg", "李", "run.json", "{a}", "-x"})
    EXPECT_EQ(message_for(name), "(no error)") << name;
  for (const char* name : {"", "  ", "a\\u0007", "a\\tb", "a\\nb", "\\u202e"})
    EXPECT_NE(message_for(name).find("study.toml:1: "), std::string::npos) << message_for(name);
}

TEST(TrialTable, ExcludedWindowsArePairsOfTimesAndForeignContacts) {
  const ExcludeSpec both = trial_of(kTrial + "exclude = [[0.66, 0.78], \"foreign_contacts\", [2, 2.5]]\n").exclude;
  ASSERT_EQ(both.windows.size(), 2U);
  EXPECT_EQ(both.windows[0].begin_s, 0.66);
  EXPECT_EQ(both.windows[1].end_s, 2.5);
  EXPECT_TRUE(both.foreign_contacts);
  EXPECT_TRUE(trial_of(kTrial + "exclude = \"foreign_contacts\"\n").exclude.foreign_contacts);
  EXPECT_EQ(trial_of(kTrial + "exclude = [1.0, 1.5]\n").exclude.windows.size(), 1U);
  EXPECT_EQ(trial_of(kTrial).exclude, ExcludeSpec{});
}

TEST(TrialTable, WhatIsNoWindowIsRefusedWithItsLine) {
  for (const std::string wrong : {"[[0.78, 0.66]]", "[[0.1, 0.2, 0.3]]", "[\"contacts\"]", "[[\"a\", 1]]", "3",
                                  "[{ begin = 1 }]", "[[1, inf]]", "[[]]"}) {
    const std::string message = trial_message(kTrial + "exclude = " + wrong + "\n");
    EXPECT_NE(message.find("dir/study.toml:4"), std::string::npos) << wrong << ": " << message;
    EXPECT_NE(message.find("exclude"), std::string::npos) << wrong << ": " << message;
  }
}

TEST(TrialTable, NothingHeldIsAnotherAnswerThanNone) {
  EXPECT_FALSE(trial_of(kTrial).held_mass_kg.has_value());
  EXPECT_EQ(trial_of(kTrial + "held_mass_kg = 0\n").held_mass_kg, 0.0);
}

TEST(TrialTable, OneFileHasOneClock) {
  const std::string text = "name = \"t\"\nmotion = \"a.sto\"\nemg = \"a.sto\"\n[sync]\n";
  EXPECT_NE(trial_message(text + "offset_s = 0.1\n").find("one file"), std::string::npos);
  EXPECT_EQ(trial_message(text + "loads_offset_s = 0.1\n"), "(no error)");
}

TEST(TrialTable, ClocksAreJoinedByTriggersOrByANumber) {
  const std::string triggers = "[sync]\nemg_trigger = \"T\"\nmotion_trigger = \"start\"\n";
  EXPECT_EQ(trial_of(kTrial + triggers).sync->emg_trigger, "T");
  EXPECT_NE(trial_message(kTrial + triggers + "offset_s = 0.1\n").find("offset_s"), std::string::npos);
  EXPECT_NE(trial_message(kTrial + "[sync]\nemg_trigger = \"T\"\n").find("give both"), std::string::npos);
}

}  // namespace
}  // namespace myoid::study
