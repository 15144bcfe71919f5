#include "myoid/study/intake/read_trial.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

TEST(ReadTrialInput, RefusesDegreesThatAreSaidToBeRadians) {
  const test::TemporaryFolder folder;
  std::string text = "motion\nversion=1\ninDegrees=no\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(0.01 * i) + "\t" + std::to_string(5 * i) + "\n";
  write_file(folder / "m.mot", text);
  const Study study = arm_study();
  TrialSpec trial;
  trial.name = "t";
  trial.motion = folder / "m.mot";
  trial.use = Use::static_pose;
  const std::string message = message_of([&] { (void)read_trial_input(study, trial, arm()); });
  EXPECT_NE(message.find("degrees"), std::string::npos) << message;
  EXPECT_NE(message.find("m.mot"), std::string::npos) << message;
}

TEST(ReadTrialInput, AMotionWithANumberForAMissingValueNamesTheNumber) {
  const test::TemporaryFolder folder;
  std::string text = "motion\nversion=1\ninDegrees=yes\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i < 200; ++i)
    text += std::to_string(0.01 * i) + "\t" + (i > 90 && i < 100 ? "-9999" : std::to_string(0.2 * i)) + "\n";
  write_file(folder / "m.mot", text);
  TrialSpec trial;
  trial.name = "t";
  trial.motion = folder / "m.mot";
  const std::string message = message_of([&] { (void)read_trial_input(arm_study(), trial, arm()); });
  EXPECT_NE(message.find("-9999"), std::string::npos) << message;
}

TEST(AddRepairs, AClockThatMayBeWrongIsAWarning) {
  std::vector<Remark> remarks;
  add_repairs("e.csv", {{3, "one rate and another", 0.2}, {0, "two rates alike", 0.01}}, remarks);
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_EQ(remarks[0].code, RemarkCode::clock_drift);
  EXPECT_EQ(remarks[0].severity, Severity::warning);
  EXPECT_EQ(remarks[1].severity, Severity::note);
}

TEST(AddRepairs, AFileThatHoldsLessThanItStatesIsAWarning) {
  std::vector<Remark> remarks;
  add_repairs("e.sto", {{.message = "rows are lost", .lost = true}, {.message = "a comma"}}, remarks);
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_EQ(remarks[0].severity, Severity::warning);
  EXPECT_FALSE(remarks[0].remedy.empty());
  EXPECT_EQ(remarks[1].severity, Severity::note);
}

TEST(ReadTrialParts, ATrialIsCutAtALongPauseAndShortPartsAreLeftOut) {
  const Study study = arm_study();
  const WrittenTrial paused(0.01, 8.0, 3.0);
  const std::vector<TrialPart> parts = read_trial_parts(study, paused.spec, arm());
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].spec.name, "t.1");
  EXPECT_EQ(parts[1].spec.name, "t.2");
  EXPECT_NEAR(parts[0].input.motion->time_s()[249], 2.49, 1e-9);
  EXPECT_EQ(parts[0].input.motion->sample_count(), 250);
  EXPECT_NEAR(parts[1].input.motion->time_s()[0], 5.5, 1e-9);
  ASSERT_FALSE(parts[1].input.remarks.empty());
  EXPECT_EQ(parts[1].input.remarks.back().code, RemarkCode::clock_pause);
  EXPECT_NE(parts[1].input.remarks.back().says.find("m.mot"), std::string::npos);
  // Of a trial that ends 0.5 s after the pause, that part is left out.
  WrittenTrial shorter(0.01, 8.0, 3.0);
  shorter.spec.end_s = 6.0;
  EXPECT_EQ(read_trial_parts(study, shorter.spec, arm()).size(), 1U);
  EXPECT_EQ(read_trial_parts(study, WrittenTrial(0.01, 5.0).spec, arm())[0].spec.name, "t");
}

TEST(ReadTrialParts, LeavesOutTheMotionBeyondTheTorquesFile) {
  // 5 s of motion; the torque's file ends after 3 s, as one that was cut off.
  WrittenTrial trial(0.01, 4.99);
  std::string torque = "torque\nendheader\ntime\telbow_flexion_moment\n";
  for (int i = 0; i <= 300; ++i) torque += fmt::format("{:.2f}\t{:.1f}\n", 0.01 * i, -0.1 * i);
  write_file(trial.folder / "torque.sto", torque);
  trial.spec.external_torque = trial.folder / "torque.sto";
  const std::vector<TrialPart> parts = read_trial_parts(arm_study(), trial.spec, arm());
  ASSERT_EQ(parts.size(), 1U);
  const TrialInput& input = parts[0].input;
  EXPECT_NEAR(input.motion->time_s()[input.motion->sample_count() - 1], 3.0, 1e-9);
  EXPECT_EQ(parts[0].spec.end_s, 3.0);  // as one who gives the trial a window
  EXPECT_TRUE(std::any_of(input.remarks.begin(), input.remarks.end(), [](const Remark& remark) {
    return remark.severity == Severity::warning &&
           remark.says.find("torque.sto: the torque (0 to 3 s) lacks 1.99 s") == 0;
  }));

  write_file(trial.folder / "torque.sto", torque.substr(0, 2000));
  EXPECT_NE(message_of([&] { (void)read_trial_parts(arm_study(), trial.spec, arm()); }).find("torque.sto"),
            std::string::npos);
}

TEST(ReadTrialParts, TheClockOfATorqueIsJudgedAsThatOfEmg) {
  WrittenTrial trial(0.01, 4.99);
  trial.spec.external_torque = trial.folder / "torque.sto";
  const auto parts = [&](double step, double pause_s) {
    std::string torque = "torque\nendheader\ntime\telbow_flexion_moment\n";
    for (int i = 0; i <= 500; ++i)
      torque += fmt::format("{:.2f}\t{:.1f}\n", step * i + (i < 250 ? 0.0 : pause_s), -0.1 * i);
    write_file(*trial.spec.external_torque, torque);
    return read_trial_parts(arm_study(), trial.spec, arm());
  };
  const auto pauses = [](const TrialPart& part) {
    return std::ranges::count(part.input.remarks, RemarkCode::clock_pause, &Remark::code);
  };
  EXPECT_EQ(pauses(parts(0.01, 0.0).at(0)), 0);
  EXPECT_EQ(pauses(parts(0.01, 0.3).at(0)), 1);
  const std::vector<TrialPart> cut = parts(0.01, 1.0);
  ASSERT_EQ(cut.size(), 2U);
  EXPECT_NEAR(*cut[0].spec.end_s, 2.49, 1e-9);
  EXPECT_NEAR(*cut[1].spec.start_s, 3.5, 1e-9);
  EXPECT_THROW((void)parts(10.0, 0.0), ReadError) << "milliseconds";
}

TEST(ReadTrialParts, AWindowOfTheStudyBeyondTheRecordingIsWarnedOf) {
  WrittenTrial trial(0.01, 4.99);  // 5 s of motion
  const auto warnings = [&](std::optional<double> start_s, std::optional<double> end_s) {
    trial.spec.start_s = start_s;
    trial.spec.end_s = end_s;
    const std::vector<TrialPart> parts = read_trial_parts(arm_study(), trial.spec, arm());
    return std::ranges::count(parts.at(0).input.remarks, Severity::warning, &Remark::severity);
  };
  const auto without = warnings(std::nullopt, std::nullopt);
  EXPECT_EQ(warnings(1.0, 4.0), without);
  EXPECT_EQ(warnings(std::nullopt, 5.05), without);
  EXPECT_EQ(warnings(1.0, 7.0), without + 1);
  EXPECT_EQ(warnings(-2.0, std::nullopt), without + 1);
}

TEST(ReadTrialParts, ATorqueMayBeATableInItsOwnUnit) {
  WrittenTrial trial(0.01, 4.99);
  std::string rows;
  for (int i = 0; i <= 500; ++i) rows += fmt::format("{:.2f},{:.1f}\n", 0.01 * i, -100.0 * i);
  const std::string name = "time,elbow_flexion_moment [";
  write_file(trial.folder / "torque.csv", name + "N.mm]\n" + rows);
  trial.spec.external_torque = trial.folder / "torque.csv";
  const std::vector<TrialPart> parts = read_trial_parts(arm_study(), trial.spec, arm());
  ASSERT_EQ(parts.size(), 1U);
  const TimeSeries& torque = *parts[0].input.external_torque;
  EXPECT_NEAR(torque.column("elbow_flexion_moment")[200], -20.0, 1e-12);
  write_file(trial.folder / "torque.csv", name + "N]\n" + rows);
  EXPECT_NE(message_of([&] { (void)read_trial_parts(arm_study(), trial.spec, arm()); }).find("is in N, expected N m"),
            std::string::npos);
}

TEST(ReadTrialParts, ATorqueInAShareIsRefusedAndAUnitThatIsNotSIIsSaid) {
  WrittenTrial trial(0.01, 4.99);
  trial.spec.external_torque = trial.folder / "torque.csv";
  const auto read = [&](const std::string& unit) {
    std::string table = "time,elbow_flexion_moment [" + unit + "]\n";
    for (int i = 0; i <= 500; ++i) table += fmt::format("{:.2f},{:.1f}\n", 0.01 * i, -0.1 * i);
    write_file(*trial.spec.external_torque, table);
    const TrialInput input = read_trial_parts(arm_study(), trial.spec, arm()).front().input;
    return std::pair(input.external_torque->values()(200, 0),
                     std::ranges::count(input.remarks, RemarkCode::reading, &Remark::code));
  };
  EXPECT_THROW((void)read("%"), ReadError);
  EXPECT_THROW((void)read("Nm/kg"), ReadError);
  const auto [torque_nm, remarks] = read("Nm");
  EXPECT_NEAR(torque_nm, -20.0, 1e-12);
  const auto [torque_of_knm, remarks_of_knm] = read("kNm");
  EXPECT_NEAR(torque_of_knm, -20000.0, 1e-9);
  EXPECT_EQ(remarks_of_knm, remarks + 1);
}

// A dynamometer's export: angle and torque are columns of one table, the angle in degrees.
TEST(ReadTrialParts, AnAngleMayBeAColumnOfTheTableOfTheTorque) {
  WrittenTrial trial(0.01, 4.99);
  std::string rows;
  for (int i = 0; i <= 500; ++i) rows += fmt::format("{:.2f},{:.1f},{:.2f}\n", 0.01 * i, -0.1 * i, 0.18 * i);
  const std::string name = "time [s],elbow_flexion_moment [Nm],elbow_flexion";
  write_file(trial.folder / "table.csv", name + " [deg]\n" + rows);
  trial.spec.motion = trial.spec.external_torque = trial.folder / "table.csv";
  const std::vector<TrialPart> parts = read_trial_parts(arm_study(), trial.spec, arm());
  ASSERT_EQ(parts.size(), 1U);
  const TrialInput& input = parts[0].input;
  // 18 degrees a second.
  EXPECT_NEAR(input.motion->column("elbow_flexion")[250], 18.0 * input.motion->time_s()[250] * kDegree, 1e-9);
  EXPECT_NEAR(input.external_torque->column("elbow_flexion_moment")[250], -25.0, 1e-9);
  write_file(trial.folder / "table.csv", name + "\n" + rows);
  EXPECT_NE(message_of([&] { (void)read_trial_parts(arm_study(), trial.spec, arm()); }).find("'elbow_flexion [deg]'"),
            std::string::npos);
}

TEST(ReadTrialParts, LeavesOutTheMotionBeyondTheForcesFile) {
  WrittenTrial trial(0.01, 4.99);
  std::string force = "f\nendheader\ntime\tf_vx\tf_vy\tf_vz\tf_px\tf_py\tf_pz\n";
  for (int i = 0; i <= 300; ++i) force += fmt::format("{:.2f}\t0\t{:.1f}\t0\t0\t0\t0\n", 1.0 + 0.01 * i, -0.1 * i);
  write_file(trial.folder / "force.mot", force);
  write_file(trial.folder / "loads.xml",
             "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"l\"><objects>"
             "<ExternalForce name=\"grip\"><applied_to_body>forearm_hand</applied_to_body>"
             "<force_expressed_in_body>ground</force_expressed_in_body>"
             "<point_expressed_in_body>forearm_hand</point_expressed_in_body>"
             "<force_identifier>f_v</force_identifier><point_identifier>f_p</point_identifier>"
             "</ExternalForce></objects><datafile>force.mot</datafile></ExternalLoads>"
             "</OpenSimDocument>");
  trial.spec.external_loads = trial.folder / "loads.xml";
  const std::vector<TrialPart> parts = read_trial_parts(arm_study(), trial.spec, arm());
  ASSERT_EQ(parts.size(), 1U);
  const TrialInput& input = parts[0].input;
  EXPECT_NEAR(input.motion->time_s()[0], 1.0, 1e-9);
  EXPECT_NEAR(input.motion->time_s()[input.motion->sample_count() - 1], 4.0, 1e-9);
  EXPECT_TRUE(std::any_of(input.remarks.begin(), input.remarks.end(), [](const Remark& remark) {
    return remark.says.find("loads.xml: the force (1 to 4 s) lacks 1.99 s") == 0;
  }));
  // The check of rates sees the durations of the files.
  ASSERT_EQ(input.lengths.size(), 1U);
  EXPECT_NEAR(input.lengths[0].motion_s, 4.99, 1e-9);
}

}  // namespace
}  // namespace myoid::study
