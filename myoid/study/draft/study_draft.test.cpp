#include "myoid/study/draft/study_draft.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/study/checks/check_study.h"
#include "myoid/study/draft/draft_loads.h"
#include "myoid/study/draft/draft_model.h"
#include "myoid/study/read_study.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"
#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Angles of the elbow and raw EMG of one trial.
void write_trial(const std::filesystem::path& folder, const std::string& stem) {
  std::string motion =
      "Coordinates\nversion=1\nnRows=400\nnColumns=2\ninDegrees=no\nendheader\ntime\telbow_"
      "flexion\n";
  for (int i = 0; i < 400; ++i) motion += fmt::format("{:.2f}\t{:.6f}\n", 0.01 * i, 1.0 + 0.5 * std::sin(0.06 * i));
  write_file(folder / (stem + "_angles.mot"), motion);
  std::string emg = "time,Biceps Brachii [mV],Triceps [mV],Soleus [mV]\n";
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.001 * i;
    const double phase = static_cast<double>(stem.size());  // of each trial its own
    const double noise = std::sin(700.0 * t + phase) + std::sin(431.0 * t + 1.0);
    emg += fmt::format("{:.3f},{:.5f},{:.5f},{:.5f}\n", t, noise * (1.0 + std::sin(6.0 * t)),
                       noise * (1.2 - std::sin(6.0 * t)), noise);
  }
  write_file(folder / (stem + "_emg.csv"), emg);
}

/// Returns the code of the draft's remark on this file; empty: there is none.
std::optional<RemarkCode> code_of(const StudyDraft& draft, const std::string& file) {
  const auto remark = std::ranges::find(draft.remarks, file, &Remark::where);
  return remark == draft.remarks.end() ? std::nullopt : std::optional(remark->code);
}

TEST(StudyDraft, OffersTheBodyMassThatAFileStates) {
  const test::TemporaryFolder folder;
  recording::C3dFile file = test::plate_recording(2);
  recording::C3dGroup group{.id = 9, .name = "PROCESSING"};
  group.parameters = {test::c3d_numbers("Bodymass", recording::C3dType::real, {}, {61.5}),
                      test::c3d_numbers("Height", recording::C3dType::real, {}, {1680.0})};
  file.groups.push_back(group);
  recording::write_c3d(folder / "walk.c3d", file);
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  EXPECT_THAT(draft.toml, HasSubstr("\nmass_kg = 61.5\n"));
  EXPECT_THAT(draft.todo, Contains(testing::AllOf(HasSubstr("walk.c3d"), HasSubstr("1.68 m"))));
}

TEST(StudyDraft, OfAFolderOfRecordingsPassesTheCheck) {
  const test::TemporaryFolder folder;
  write_trial(folder.path(), "flex_2kg");
  write_trial(folder.path(), "slow");
  write_file(folder / "broken.trc", "no TRC");
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  const Study study = parse_study(draft.toml, folder / "study.toml");
  ASSERT_EQ(study.trials.size(), 2U);
  EXPECT_EQ(study.trials[0].name, "flex_2kg");
  EXPECT_EQ(study.trials[0].motion->filename(), "flex_2kg_angles.mot");
  EXPECT_EQ(study.trials[0].emg->filename(), "flex_2kg_emg.csv");
  ASSERT_EQ(study.muscles.size(), 2U);
  EXPECT_EQ(study.muscles[0].emg, "Biceps Brachii");
  EXPECT_EQ(study.muscles[0].osim, std::vector<std::string>{"BIC"});
  for (const Remark& f : check_study(study)) EXPECT_NE(f.severity, Severity::error) << f.says;
  EXPECT_THAT(draft.todo, Contains(HasSubstr("have no electrode: BRA, BRD")));
  EXPECT_THAT(draft.todo, Contains(HasSubstr("2 kg")));
  EXPECT_THAT(draft.toml, HasSubstr("# Channels that no muscle about elbow_flexion takes: Soleus"));
  EXPECT_EQ(code_of(draft, "broken.trc"), RemarkCode::refused);
}

TEST(StudyDraft, AModelThatCannotBeReadIsLeftOutAndTheReasonOfAnEmptyDraftIsGiven) {
  const test::TemporaryFolder folder;
  write_trial(folder.path(), "lift");
  write_file(folder / "empty.osim", "");
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  EXPECT_EQ(code_of(draft, "empty.osim"), RemarkCode::refused);
  EXPECT_EQ(parse_study(draft.toml, folder / "study.toml").trials.size(), 1U);
  EXPECT_THROW((void)draft_study(folder.path(), {.from = {folder.path()}, .model = folder / "empty.osim"}),
               InvalidInput);
  EXPECT_THROW((void)draft_study(folder.path(), {.from = {folder / "absent"}}), ReadError);
  write_file(folder / "empty/empty.trc", "");
  EXPECT_THAT(test::message_of([&] { (void)draft_study(folder.path(), {.from = {folder / "empty/empty.trc"}}); }),
              HasSubstr("not read"));
}

/// Torque and angle of a dynamometer in a table whose columns have these names, and the EMG beside it.
void write_dynamometer(const std::filesystem::path& folder, const std::string& stem, const std::string& columns) {
  std::string table = "time [s]," + columns + "\n";
  for (int i = 0; i < 400; ++i)
    table += fmt::format("{:.2f},{:.3f},60.0\n", 0.01 * i, -20.0 * (1.0 + std::sin(0.06 * i)));
  write_file(folder / (stem + "_dynamometer.csv"), table);
  write_trial(folder, stem);
  std::filesystem::remove(folder / (stem + "_angles.mot"));
}

TEST(StudyDraft, ADynamometersTableIsMotionAndTorqueOfATrial) {
  const test::TemporaryFolder folder;
  write_dynamometer(folder.path(), "hold_60", "elbow_flexion_moment [Nm],elbow_flexion [deg]");
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  const Study study = parse_study(draft.toml, folder / "study.toml");
  ASSERT_EQ(study.trials.size(), 1U);
  EXPECT_EQ(study.trials[0].name, "hold_60");
  EXPECT_EQ(study.trials[0].motion->filename(), "hold_60_dynamometer.csv");
  EXPECT_EQ(study.trials[0].emg->filename(), "hold_60_emg.csv");
  EXPECT_THAT(draft.toml, HasSubstr("# external_torque = \"hold_60_dynamometer.csv\""));
  EXPECT_THAT(draft.todo, Contains(HasSubstr("dynamometer measure")));
  EXPECT_THAT(draft.todo, testing::Not(Contains(HasSubstr("unit"))));
  // With the answer it is a study without an error.
  std::string answered = draft.toml;
  answered.erase(answered.find("# external_torque"), 2);
  for (const Remark& f : check_study(parse_study(answered, folder / "study.toml")))
    EXPECT_NE(f.severity, Severity::error) << f.says;
}

TEST(StudyDraft, ATorqueOfNoJointAsksForTheColumnsNames) {
  const test::TemporaryFolder folder;
  write_dynamometer(folder.path(), "hold_60", "torque [Nm],crank_angle [deg]");
  write_dynamometer(folder.path(), "hold_90", "torque [Nm],crank_angle [deg]");
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  EXPECT_THAT(draft.todo,
              Contains(testing::AllOf(HasSubstr("hold_60_dynamometer.csv and 1 more"),
                                      HasSubstr("'elbow_flexion_moment [Nm]'"), HasSubstr("'elbow_flexion [deg]'"))));
}

TEST(StudyDraft, ATorqueBesideEmgInOneTableAsksForTheColumnsNamesToo) {
  const auto todo = [](const std::string& columns) {
    const test::TemporaryFolder folder;
    std::string table = "Time (s)," + columns + ",EMG BIC (mV)\n";
    for (int i = 0; i < 4000; ++i)
      table += fmt::format("{:.3f},{:.3f},60.0,{:.4f}\n", 0.001 * i, -20.0 * (1.0 + std::sin(0.006 * i)),
                           std::sin(0.7 * i * i) * (1.0 + std::sin(0.006 * i)));
    write_file(folder / "k.csv", table);
    return draft_study(folder.path(), {.from = {folder.path()}}).todo;
  };
  const std::string question = question_of_torques({"k.csv"}, "elbow_flexion");
  EXPECT_THAT(todo("Torque (ft-lbf),Angle (deg)"), Contains(question));
  EXPECT_THAT(todo("elbow_flexion_moment (Nm),elbow_flexion (deg)"), testing::Not(Contains(question)));
}

// A maximal contraction without EMG says nothing of the largest EMG, and study.toml refuses it.
TEST(StudyDraft, AMaximalContractionWithoutEmgIsATrialOfMotionAndTorque) {
  const test::TemporaryFolder folder;
  for (const char* stem : {"slow", "mvc_flexion"}) write_trial(folder.path(), stem);
  std::filesystem::remove(folder / "mvc_flexion_emg.csv");
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  const Study study = parse_study(draft.toml, folder / "study.toml");
  ASSERT_EQ(study.trials.size(), 2U);
  EXPECT_EQ(study.trials[0].name, "mvc_flexion");
  EXPECT_EQ(study.trials[0].use, Use::static_pose);
  EXPECT_THAT(draft.todo, Contains(HasSubstr("no EMG was found for 'mvc_flexion'")));
}

TEST(StudyDraft, WhereNoChannelIsKnownTheCheckSaysWhatToFillIn) {
  const test::TemporaryFolder folder;
  write_trial(folder.path(), "a");
  std::string text = "time,V1 [V],V2 [V]\n";
  for (int i = 0; i < 4000; ++i) text += fmt::format("{:.3f},{:.5f},0.1\n", 0.001 * i, std::sin(0.7 * i));
  write_file(folder / "a_emg.csv", text);
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  EXPECT_THAT(draft.todo, Contains(HasSubstr("name the pairs")));
  const Study study = parse_study(draft.toml, folder / "study.toml");
  bool said = false;
  for (const Remark& f : check_study(study))
    said = said || (f.severity == Severity::error && f.says.find("TODO") != std::string::npos);
  EXPECT_TRUE(said);
}

TEST(StudyDraft, WithoutARecordingIsRefused) {
  const test::TemporaryFolder folder;
  EXPECT_THROW((void)draft_study(folder.path(), {.from = {folder.path()}}), InvalidInput);
}

TEST(StudyDraft, OfAWalkingTrialTheJointIsThatOfTheChannelsAndTheGroundReactionComesAlong) {
  const auto data = test::data_folder();
  MYOID_REQUIRE_DATA(data / "gait-emg");
  const test::TemporaryFolder folder;
  const StudyDraft draft = draft_study(folder.path(), {.from = {data / "gait-emg"}});
  const Study study = parse_study(draft.toml, folder / "study.toml");
  EXPECT_EQ(study.model.coordinate, "knee_angle_r");
  EXPECT_THAT(draft.todo, ::testing::Contains(HasSubstr("--coordinate knee_angle_l")));
  EXPECT_THAT(draft.toml, HasSubstr("# emg = { same_as = \"TODO\" }"));
  ASSERT_EQ(study.trials.size(), 1U);
  EXPECT_EQ(study.trials[0].external_loads->filename(), "grf_walk.xml");
  EXPECT_EQ(study.trials[0].emg->filename(), "emg_walk_raw.anc");
  std::vector<std::string> emg;
  for (const MuscleSpec& muscle : study.muscles) emg.push_back(muscle.emg);
  EXPECT_THAT(emg, ::testing::UnorderedElementsAre("GAS", "MH", "BF", "VL", "VM", "RF"));
  EXPECT_EQ(code_of(draft, "grf_walk.mot"), std::nullopt);
  EXPECT_EQ(code_of(draft, "grf_walk.xml"), std::nullopt);
  EXPECT_EQ(code_of(draft, "electromyography.sto"), RemarkCode::emg_processing);
}

TEST(StudyDraft, OfOnePersonsEnvelopesAndAnothersRawEmgTakesTheEnvelopes) {
  const auto data = test::data_folder();
  MYOID_REQUIRE_DATA(data / "upper-limb-optical");
  const test::TemporaryFolder folder;
  const StudyDraft draft = draft_study(folder.path(), {.from = {data / "upper-limb-optical"}});
  EXPECT_THAT(draft.toml, HasSubstr("kind = \"envelope\""));
  for (const std::string& question : draft.todo) EXPECT_EQ(question.find("no EMG was found"), std::string::npos);
  EXPECT_THAT(draft.todo, Contains(HasSubstr("the EMG of 'biosiglive_abd' (biosiglive_abd_emg_raw_V.sto) is raw")));
}

TEST(StudyDraft, OfSeveralPersonsAsksForAStudyEachAndOfJointTorquesNamesTheirCommand) {
  const test::TemporaryFolder folder;
  for (const char* stem : {"subject_1_bend", "subject_2_bend"}) write_trial(folder.path(), stem);
  write_file(folder / "id.sto",
             "Inverse Dynamics\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\n"
             "time\telbow_flexion_moment\n0.0\t1.0\n0.1\t2.0\n");
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  EXPECT_THAT(draft.todo, Contains(HasSubstr("subject_1, subject_2 in the names")));
  EXPECT_EQ(code_of(draft, "subject_2_bend_angles.mot"), RemarkCode::refused);
  const Study study = parse_study(draft.toml, folder / "study.toml");
  ASSERT_EQ(study.trials.size(), 1U);
  EXPECT_EQ(study.trials[0].emg->filename(), "subject_1_bend_emg.csv");
  EXPECT_EQ(code_of(draft, "id.sto"), RemarkCode::refused);
}

/// A recording of markers of these names.
void write_markers(const std::filesystem::path& file, const std::vector<std::string>& names) {
  std::string head = "Frame#\tTime", axes = "\t";
  for (std::size_t m = 0; m < names.size(); ++m) {
    head += "\t" + names[m] + "\t\t";
    axes += fmt::format("\tX{0}\tY{0}\tZ{0}", m + 1);
  }
  std::string text = fmt::format(
      "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\t"
      "OrigDataStartFrame\tOrigNumFrames\n100\t100\t20\t{}\tmm\t100\t1\t20\n{}\n{}\n\n",
      names.size(), head, axes);
  for (int f = 0; f < 20; ++f) {
    text += fmt::format("{}\t{:.2f}", f + 1, 0.01 * f);
    for (std::size_t m = 0; m < names.size(); ++m)
      text += fmt::format("\t{:.1f}\t{:.1f}\t{:.1f}", 100.0 * static_cast<double>(m), 900.0 + f,
                          50.0 * static_cast<double>(m % 3));
    text += "\n";
  }
  write_file(file, text);
}

TEST(StudyDraft, TakesTheModelThatKnowsTheMarkers) {
  const test::TemporaryFolder folder;
  const std::string arm(body::arm4_osim());
  std::string other = arm;
  std::vector<std::string> names;
  for (const body::Marker& marker : body::parse_osim(arm, "arm.osim").markers) {
    names.push_back(marker.name);
    const std::string tag = "Marker name=\"" + marker.name + "\"";
    if (const auto at = other.find(tag); at != std::string::npos)
      other.replace(at, tag.size(), "Marker name=\"Q" + marker.name + "\"");
  }
  write_file(folder / "a_other.osim", other);
  write_file(folder / "b_arm.osim", arm);
  write_markers(folder / "lift.trc", names);
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  EXPECT_THAT(draft.toml, HasSubstr("file = \"b_arm.osim\""));
  EXPECT_THAT(draft.todo, Contains(HasSubstr("a_other.osim")));
}

TEST(StudyDraft, OfModelsThatKnowNearlyAsManyMarkersTakesTheOneThatTheyLieNearest) {
  const auto data = test::data_folder();
  MYOID_REQUIRE_DATA(data / "box-lift");
  // das knows one marker more than wu, and its markers lie twice as far.
  const test::TemporaryFolder folder;
  const StudyDraft draft = draft_study(folder.path(), {.from = {data / "box-lift"}});
  EXPECT_THAT(draft.toml, HasSubstr("wu.osim\"\n"));
}

TEST(StudyDraft, OfAnArmTakesAJointWhoseAnglesTheModelCanHave) {
  const auto data = test::data_folder();
  MYOID_REQUIRE_DATA(data / "upper-limb-optical");
  const test::TemporaryFolder folder;
  const StudyDraft draft = draft_study(folder.path(), {.from = {data / "upper-limb-optical"}});
  write_file(folder / "study.toml", draft.toml);
  const Study study = read_study(folder / "study.toml");
  EXPECT_EQ(study.model.coordinate.find("shoulder_plane"), std::string::npos);
  for (const Remark& remark : check_study(study)) EXPECT_NE(remark.severity, Severity::error) << remark.says;
}

TEST(StudyDraft, SaysThatMarkersOfALegMeetAnArm) {
  const test::TemporaryFolder folder;
  write_markers(folder / "walk.trc", {"LASI", "RASI", "LKNE", "RKNE", "LANK", "RANK", "LHEE", "RHEE"});
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  EXPECT_THAT(draft.todo, Contains(HasSubstr("those of a leg")));
  // The draft asks nothing about joints that a leg has and the arm lacks.
  for (const char* words : {"which joint", "known to the model", "name the pairs", "segments of the built-in arm"})
    EXPECT_THAT(draft.todo, testing::Not(Contains(HasSubstr(words)))) << words;
}

/// Two seconds of raw EMG of these channels.
void write_emg(const std::filesystem::path& path, const std::string& channels) {
  std::string text = "time," + channels + "\n";
  for (int i = 0; i < 2000; ++i)
    text += fmt::format("{:.3f},{:.5f},{:.5f}\n", 0.001 * i, std::sin(0.7 * i), std::sin(0.9 * i));
  write_file(path, text);
}

TEST(StudyDraft, TheLimbIsThatOfTheEmgAndThenThatOfTheMarkers) {
  const auto of_a_leg = [](const std::vector<std::string>& markers, const std::string& channels) {
    const test::TemporaryFolder folder;
    if (!markers.empty()) write_markers(folder / "a.trc", markers);
    if (!channels.empty()) write_emg(folder / "a_emg.csv", channels);
    const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
    return std::ranges::any_of(draft.todo,
                               [](const std::string& q) { return q.find("of a leg") != std::string::npos; });
  };
  const std::vector<std::string> trunk{"ASISr", "ASISl", "PSISr", "PSISl", "STER", "T10", "EPICl", "EPICm"};
  std::vector<std::string> whole = trunk;
  whole.insert(whole.end(), {"RKNE", "RANK", "LKNE", "LANK"});
  EXPECT_FALSE(of_a_leg(trunk, ""));
  EXPECT_TRUE(of_a_leg(whole, ""));
  EXPECT_FALSE(of_a_leg(whole, "Biceps [uV],Triceps [uV]"));
  EXPECT_TRUE(of_a_leg(trunk, "VL [uV],TA [uV]"));
  EXPECT_TRUE(of_a_leg({}, "VL [uV],GL [uV]"));
}

TEST(StudyDraft, OffersUsualNamesOfTheArmsMarkersWithARemark) {
  const test::TemporaryFolder folder;
  write_markers(folder / "lift.trc", {"C7", "CLAV", "RSHO", "RELB", "RWRA", "RWRB", "RFIN", "LELB"});
  const StudyDraft draft = draft_study(folder.path(), {.from = {folder.path()}});
  EXPECT_THAT(draft.toml, HasSubstr("\n# rename = { \"CLAV\" = \"sternum\", \"RELB\" = \"r_epicondyle_lateral\", "
                                    "\"RFIN\" = \"r_hand\", \"RSHO\" = \"r_acromion\", "));
  // Two markers that claim one place, and a name that the arm has, take no part.
  EXPECT_TRUE(usual_arm_markers({"RELB", "EL"}).empty());
  EXPECT_TRUE(usual_arm_markers({"RELB", "r_epicondyle_lateral"}).empty());
  EXPECT_EQ(usual_arm_markers({"Subject:relb"}).at("Subject:relb"), "r_epicondyle_lateral");
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  for (const auto& [recorded, wanted] : usual_arm_markers({"IJ", "AC", "EL", "EM", "RS", "US", "RFIN"}))
    EXPECT_TRUE(arm.find_marker(wanted)) << recorded;
}

TEST(StudyDraft, OfTheElbowRecordingsPassesTheCheck) {
  const auto data = test::data_folder();
  MYOID_REQUIRE_DATA(data / "elbow-emg");
  const test::TemporaryFolder folder;
  const StudyDraft draft = draft_study(folder.path(), {.from = {data / "elbow-emg"}});
  const Study study = parse_study(draft.toml, folder / "study.toml");
  EXPECT_EQ(study.trials.size(), 6U);
  EXPECT_EQ(study.muscles.size(), 3U);
  // Every trial starts from its joint angles: nothing is asked about the markers beside them.
  EXPECT_NE(draft.toml.find("# Not used: markers"), std::string::npos);
  EXPECT_EQ(draft.toml.find("[markers]"), std::string::npos);
  for (const std::string& question : draft.todo) {
    EXPECT_EQ(question.find("marker"), std::string::npos) << question;
    EXPECT_EQ(question.find("vertical"), std::string::npos) << question;
  }
  for (const Remark& f : check_study(study)) EXPECT_NE(f.severity, Severity::error) << f.says;
}

}  // namespace
}  // namespace myoid::study
