#include "myoid/study/draft/draft_trials.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/study/draft/draft_text.h"

namespace myoid::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

FoundRecording found(const std::string& name, bool angles, bool emg) {
  FoundRecording f;
  f.path = name;
  f.stem = trial_stem(name);
  if (angles) f.angles = {"elbow"};
  if (emg) f.channels = {"BIC"};
  return f;
}

TEST(DraftText, IsOneLineARemarkAndHoldsNoControlCharacter) {
  EXPECT_EQ(in_remark("a\nname = 1\x07"), "a name = 1\\u0007");
  EXPECT_EQ(list_of({"a", "b"}), "[\"a\", \"b\"]");
}

TEST(DraftTrials, MotionAndEmgOfOneNameAreATrialAndEmgCalledSoIsAMaximalContraction) {
  std::vector<FoundRecording> files{found("flex_2p5kg.mot", true, false), found("flex_2p5kg_emg.csv", false, true),
                                    found("mvc_emg.csv", false, true)};
  DraftText out;
  draft_trials(files,
               {.external_loads = {},
                .own_model = true,
                .relative = [](const std::filesystem::path& path) { return "in/" + path.string(); }},
               out);
  EXPECT_THAT(out.toml, HasSubstr("motion = \"in/flex_2p5kg.mot\"\nemg = \"in/flex_2p5kg_emg.csv\"\n"
                                  "use = \"calibration\""));
  EXPECT_THAT(out.toml, HasSubstr("# held_mass_kg = 2.5"));
  EXPECT_THAT(out.toml, HasSubstr("emg = \"in/mvc_emg.csv\"\nuse = \"mvc\""));
  EXPECT_THAT(out.toml, Not(HasSubstr("no trial has use")));
  EXPECT_EQ(out.questions.size(), 1U);  // is the mass held in the hand?
}

TEST(DraftTrials, EmgOfSomeMovementIsNotTakenForAMaximum) {
  std::vector<FoundRecording> files{found("ik_walk.mot", true, false), found("run_emg.csv", false, true)};
  DraftText out;
  draft_trials(files,
               {.external_loads = {"in/grf_walk.xml", "in/grf_run.xml"},
                .own_model = true,
                .relative = [](const std::filesystem::path& path) { return path.string(); }},
               out);
  EXPECT_THAT(out.toml, Not(HasSubstr("\nuse = \"mvc\"")));
  EXPECT_THAT(out.toml, HasSubstr("# emg = \"run_emg.csv\"\n# use = \"mvc\""));
  EXPECT_THAT(out.toml, HasSubstr("external_loads = \"in/grf_walk.xml\""));
  EXPECT_THAT(out.toml, Not(HasSubstr("grf_run")));
}

TEST(DraftTrials, AFolderWithOneSetOfFilesIsATrial) {
  std::vector<FoundRecording> files{found("a/walk36/ik.sto", true, false), found("a/walk36/emgFilt.sto", false, true),
                                    found("b/walk36/ik.sto", true, false), found("b/walk36/emgFilt.sto", false, true)};
  std::swap(files[1], files[3]);
  DraftText out;
  draft_trials(files,
               {.external_loads = {"a/walk36/loads.xml"},
                .own_model = true,
                .relative = [](const std::filesystem::path& path) { return path.string(); }},
               out);
  for (const char* folder : {"a", "b"})
    EXPECT_THAT(out.toml, HasSubstr(fmt::format("motion = \"{0}/walk36/ik.sto\"\nemg = \"{0}/walk36/emgFilt.sto\"\n"
                                                "use = \"calibration\"",
                                                folder)));
  EXPECT_THAT(out.toml, HasSubstr("name = \"walk36\""));
  EXPECT_TRUE(out.questions.empty());
}

TEST(DraftTrials, OfferATableOfTorquesOfTheirNameAndAskOnceWhetherItWasMeasured) {
  std::vector<FoundRecording> files{found("bend.mot", true, false), found("bend_emg.sto", false, true),
                                    found("hold.mot", true, false), found("hold_emg.sto", false, true),
                                    found("pull.mot", true, false), found("pull_emg.sto", false, true)};
  DraftText out;
  draft_trials(files,
               {.torques = {"bend_torque.sto", "id/bend_torque.sto", "hold_id.sto", "bender_torque.sto"},
                .own_model = true,
                .relative = [](const std::filesystem::path& path) { return path.string(); }},
               out);
  EXPECT_THAT(out.toml, HasSubstr("# external_torque = \"bend_torque.sto\"\n\n"));
  EXPECT_THAT(out.toml, HasSubstr("use = \"calibration\"\n# external_torque = \"hold_id.sto\"\n\n"));
  EXPECT_EQ(out.toml.find("bender"), std::string::npos);
  EXPECT_EQ(out.questions.size(), 2U);  // the torques of two trials, and what was held in the third
}

TEST(DraftTrials, TakeTheTorqueOfTheMotionsOwnFileAndNoneOfAnotherTrial) {
  std::vector<FoundRecording> files{found("turn.csv", true, false), found("turn_emg.sto", false, true),
                                    found("turn_id.csv", true, false), found("turn_id_emg.sto", false, true)};
  DraftText out;
  draft_trials(files,
               {.torques = {"turn_id.csv", "turn.csv"},
                .own_model = true,
                .relative = [](const std::filesystem::path& path) { return path.string(); }},
               out);
  EXPECT_THAT(out.toml, HasSubstr("motion = \"turn.csv\"\nemg = \"turn_emg.sto\"\nuse = \"calibration\"\n# TODO"));
  EXPECT_THAT(out.toml, HasSubstr("# external_torque = \"turn.csv\"\n\n[[trial]]"));
  EXPECT_THAT(out.toml, HasSubstr("# external_torque = \"turn_id.csv\"\n\n"));
}

TEST(DraftTrials, OfferRelaxedMusclesAsPassiveAndNotAsAMaximalContraction) {
  std::vector<FoundRecording> files{found("pas_10.sto", false, true), found("push.sto", false, true)};
  DraftText out;
  draft_trials(files, {.own_model = true, .relative = [](const std::filesystem::path& path) { return path.string(); }},
               out);
  EXPECT_THAT(out.toml, HasSubstr("# emg = \"pas_10.sto\"\n# use = \"passive\""));
  EXPECT_THAT(out.toml, HasSubstr("# emg = \"push.sto\"\n# use = \"mvc\""));
}

TEST(DraftTrials, TakeTheKindOfEmgOfMostMovementsAndSayWhichKindTheOthersHave) {
  std::vector<FoundRecording> files{found("bend.mot", true, false),      found("bend_emg.sto", false, true),
                                    found("stretch.mot", true, false),   found("stretch_emg.sto", false, true),
                                    found("other_raw.sto", false, true), found("other.mot", true, false)};
  EXPECT_TRUE(takes_raw_emg(files));
  files[1].raw = files[3].raw = false;
  EXPECT_FALSE(takes_raw_emg(files));
  DraftText out;
  draft_trials(files,
               {.external_loads = {},
                .own_model = true,
                .raw_emg = false,
                .relative = [](const std::filesystem::path& path) { return path.string(); }},
               out);
  EXPECT_THAT(out.toml, HasSubstr("emg = \"bend_emg.sto\"\nuse = \"calibration\""));
  EXPECT_THAT(out.questions,
              ::testing::Contains("the EMG of 'other' (other_raw.sto) is raw, and the study takes envelopes; 'other' "
                                  "gives motion and torque only; use = \"passive\" if the muscles were at rest"));
  EXPECT_EQ(out.questions.size(), 2U);  // the other: what was held, once for all trials
  files[3].raw = true;                  // as many raw as envelopes
  files.resize(4);
  EXPECT_TRUE(takes_raw_emg(files));
}

}  // namespace
}  // namespace myoid::study
