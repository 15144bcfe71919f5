#include "myoid/pipeline/run_study.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "myoid/core/error.h"
#include "myoid/pipeline/result_files.h"
#include "myoid/pipeline/study_model.h"
#include "myoid/pipeline/study_report.h"
#include "myoid/pipeline/trial_input.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/csv_reader.h"
#include "myoid/recording/storage_reader.h"
#include "myoid/simulation/write_recording.h"

#include "tests/support/temporary_folder.h"

namespace myoid::pipeline {
namespace {

/// The exact virtual recording, written once and run once for all tests of this file.
struct ExactRun {
  test::TemporaryFolder folder;
  StudyResult result;

  ExactRun() {
    const auto protocol = simulation::read_protocol(std::string(MYOID_SOURCE_DIR) +
                                                    "/examples/protocols/noise_free.toml");
    simulation::write_virtual_recording(simulation::make_virtual_recording(protocol, 3),
                                        folder / "recording");
    Study study = read_study(folder / "recording/study.toml");
    study.identify.cross_validate = false;
    result = run_study(study, {.store = folder / "stages"});
  }
  static const ExactRun& get() {
    static const ExactRun run;
    return run;
  }
};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(RunStudy, ASecondRunReusesInverseKinematicsAndFindsTheSame) {
  const ExactRun& first = ExactRun::get();
  Study study = first.result.study;
  study.identify.methods = {"paper"};
  study.emg.lowpass_hz = 5.0;
  const StudyResult second = run_study(study, {.store = first.folder / "stages"});
  ASSERT_EQ(second.trials.size(), first.result.trials.size());
  int with_markers = 0;
  for (std::size_t i = 0; i < second.trials.size(); ++i) {
    if (!second.trials[i].ik) continue;
    ++with_markers;
    EXPECT_FALSE(first.result.trials[i].ik_reused);
    EXPECT_TRUE(second.trials[i].ik_reused);
    EXPECT_EQ(first.result.trials[i].ik->q.values(), second.trials[i].ik->q.values());
  }
  EXPECT_GT(with_markers, 0);
}

TEST(RunStudy, FromExactFilesEveryParameterIsTheTruthToAMillionth) {
  const StudyResult& result = ExactRun::get().result;
  ASSERT_EQ(result.methods.size(), 2U);
  const identification::IdentificationResult& torque = result.methods[1];
  int compared = 0;
  for (const auto& e : torque.estimates) {
    for (const TrueValue& t : result.truth) {
      if (t.parameter != e.parameter || t.muscle != e.muscle) continue;
      EXPECT_NEAR(e.estimate, t.value, 1e-6 * std::abs(t.value)) << e.muscle << " " << e.parameter;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 25);  // six of each muscle, and the delay
}

TEST(WriteResults, LeavesTheFilesThatArePromised) {
  const ExactRun& run = ExactRun::get();
  const auto out = run.folder / "results";
  write_results(run.result, {}, out);
  const std::string trial = run.result.data.trials.front().name;
  for (const std::string name :
       {"ik.mot", "ik_marker_errors.sto", "id.sto", "MuscleAnalysis_Length.sto",
        "MuscleAnalysis_MuscleTendonVelocity.sto", "MuscleAnalysis_MomentArm_elbow_flexion.sto",
        "StaticOptimization_force.sto", "StaticOptimization_activation.sto", "activation.sto",
        "identified_forces.sto"}) {
    EXPECT_GT(recording::read_storage(out / trial / name).data.sample_count(), 10) << name;
  }
  const recording::CsvTable table = recording::read_csv_table(out / "parameters.csv");
  const std::vector<std::string> columns{"muscle",
                                         "parameter",
                                         "unit",
                                         "method",
                                         "case",
                                         "initial",
                                         "estimate",
                                         "std_error",
                                         "ci_low",
                                         "ci_high",
                                         "prior_mean",
                                         "prior_sd",
                                         "shrinkage",
                                         "at_bound",
                                         "verdict",
                                         "reason",
                                         "ci_low_sandwich",
                                         "ci_high_sandwich",
                                         "ci_low_cluster",
                                         "ci_high_cluster",
                                         "ci_low_jackknife",
                                         "ci_high_jackknife",
                                         "ci_low_bootstrap",
                                         "ci_high_bootstrap",
                                         "ci_low_profile",
                                         "ci_high_profile",
                                         "routes_disagree"};
  EXPECT_EQ(table.names, columns);
  EXPECT_TRUE(std::filesystem::exists(out / "run.json"));
  EXPECT_TRUE(std::filesystem::exists(out / "parameters.json"));
}

TEST(IdentifiedModel, DiffersFromTheInputOnlyInIdentifiedNumbers) {
  const StudyResult& result = ExactRun::get().result;
  IdentifiedMuscle muscle{
      "BIC", result.data.muscles[0].start, result.data.muscles[0].start, {"max_isometric_force"}};
  EXPECT_EQ(identified_model(result.study, result.model_text,
                             {{"BIC", muscle.start, muscle.identified, {}}}),
            result.model_text);
  muscle.identified.max_isometric_force_n *= 2.0;
  const std::string changed = identified_model(result.study, result.model_text, {muscle});
  pugi::xml_document before;
  pugi::xml_document after;
  ASSERT_TRUE(before.load_string(result.model_text.c_str()));
  ASSERT_TRUE(after.load_string(changed.c_str()));
  const char* path = "//*[@name='BIC']/max_isometric_force";
  EXPECT_DOUBLE_EQ(after.select_node(path).node().text().as_double(),
                   2.0 * before.select_node(path).node().text().as_double());
  const char* other = "//*[@name='TRI']/max_isometric_force";
  EXPECT_EQ(std::string(after.select_node(other).node().text().get()),
            before.select_node(other).node().text().get());
}

TEST(StudyReport, HasGatesTablesAndFiguresThatFitTogether) {
  const report::Report report = study_report(ExactRun::get().result, {});
  EXPECT_NO_THROW(report::validate(report));
  EXPECT_GE(report.gates.size(), 5U);
  std::vector<std::string> tables;
  for (const report::Section& section : report.sections) {
    for (const report::Table& table : section.tables) tables.push_back(table.id);
  }
  for (const std::string wanted :
       {"parameters_torque", "table_1_shortening", "table_2_lengthening", "trials"}) {
    EXPECT_NE(std::find(tables.begin(), tables.end(), wanted), tables.end()) << wanted;
  }
}

TEST(ReadTrialInput, RefusesDegreesThatAreSaidToBeRadians) {
  const test::TemporaryFolder folder;
  std::string text = "motion\nversion=1\ninDegrees=no\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i < 20; ++i)
    text += std::to_string(0.01 * i) + "\t" + std::to_string(5 * i) + "\n";
  recording::write_file(folder / "m.mot", text);
  const Study& study = ExactRun::get().result.study;
  TrialSpec trial;
  trial.name = "t";
  trial.motion = folder / "m.mot";
  trial.use = Use::static_pose;
  const std::string message =
      message_of([&] { (void)read_trial_input(study, trial, ExactRun::get().result.model); });
  EXPECT_NE(message.find("these are degrees"), std::string::npos) << message;
  EXPECT_NE(message.find("m.mot"), std::string::npos) << message;
}

TEST(ReadTrialInput, AMissingEmgChannelIsNamedWithThoseThereAre) {
  const test::TemporaryFolder folder;
  recording::write_file(
      folder / "e.sto",
      "EMG\nendheader\ntime\tBICC\tBRA\tBRD\tTRI\n0\t0\t0\t0\t0\n1\t0\t0\t0\t0\n");
  TrialSpec trial;
  trial.name = "t";
  trial.emg = folder / "e.sto";
  trial.use = Use::mvc;
  const std::string message = message_of([&] {
    (void)read_trial_input(ExactRun::get().result.study, trial, ExactRun::get().result.model);
  });
  EXPECT_NE(message.find("no EMG channel 'BIC'"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean 'BICC'"), std::string::npos) << message;
}

/// A trial of an elbow that turns with this time step, with EMG from 0 s for `emg_s` seconds.
struct WrittenTrial {
  test::TemporaryFolder folder;
  TrialSpec spec;

  WrittenTrial(double motion_step, double emg_s, double hole_s = 0.0) {
    std::string motion = "motion\nversion=1\ninDegrees=yes\nendheader\ntime\telbow_flexion\n";
    for (int i = 0; i < 500; ++i) {
      motion += fmt::format("{:.6f}\t{:.4f}\n", motion_step * i + (i < 250 ? 0.0 : hole_s),
                            40.0 + 30.0 * std::sin(0.02 * i));
    }
    std::string emg = "EMG\nendheader\ntime\tBIC\tBRA\tBRD\tTRI\n";
    for (int i = 0; i <= static_cast<int>(100.0 * emg_s); ++i)
      emg += fmt::format("{:.2f}\t0.1\t0.1\t0.1\t0.1\n", 0.01 * i);
    recording::write_file(folder / "m.mot", motion);
    recording::write_file(folder / "e.sto", emg);
    spec.name = "t";
    spec.motion = folder / "m.mot";
    spec.emg = folder / "e.sto";
  }
  [[nodiscard]] TrialInput read(const Study& study) const {
    return read_trial_input(study, spec, ExactRun::get().result.model);
  }
};

TEST(ReadTrialInput, AShortPauseOfTheClockIsWarnedOfAndALongOneRefused) {
  const Study& study = ExactRun::get().result.study;
  EXPECT_TRUE(WrittenTrial(0.01, 5.0).read(study).warnings.empty());
  const TrialInput paused = WrittenTrial(0.01, 5.3, 0.3).read(study);
  ASSERT_EQ(paused.warnings.size(), 1U);
  EXPECT_NE(paused.warnings[0].find("a gap from 2.49 to 2.8 s"), std::string::npos)
      << paused.warnings[0];
  EXPECT_NE(std::find(paused.notes.begin(), paused.notes.end(), paused.warnings[0]),
            paused.notes.end());
  const std::string message = message_of([&] { (void)WrittenTrial(0.01, 8.0, 3.0).read(study); });
  EXPECT_NE(message.find("a gap from 2.49 to 5.5 s"), std::string::npos) << message;
  EXPECT_NE(message.find("make two trials of it"), std::string::npos) << message;
}

TEST(ReadTrialParts, ATrialIsCutAtALongPauseAndShortPartsAreLeftOut) {
  const Study& study = ExactRun::get().result.study;
  const model::BodyModel& model = ExactRun::get().result.model;
  const WrittenTrial paused(0.01, 8.0, 3.0);
  const std::vector<TrialPart> parts = read_trial_parts(study, paused.spec, model);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].spec.name, "t.1");
  EXPECT_EQ(parts[1].spec.name, "t.2");
  EXPECT_NEAR(parts[0].input.motion->time_s()[249], 2.49, 1e-9);
  EXPECT_EQ(parts[0].input.motion->sample_count(), 250);
  EXPECT_NEAR(parts[1].input.motion->time_s()[0], 5.5, 1e-9);
  ASSERT_FALSE(parts[1].input.warnings.empty());
  EXPECT_NE(parts[1].input.warnings.back().find("cut at the pauses of its clock (m.mot)"),
            std::string::npos);
  // Of a trial that ends 0.5 s after the pause, that part is left out.
  WrittenTrial shorter(0.01, 8.0, 3.0);
  shorter.spec.end_s = 6.0;
  EXPECT_EQ(read_trial_parts(study, shorter.spec, model).size(), 1U);
  EXPECT_EQ(read_trial_parts(study, WrittenTrial(0.01, 5.0).spec, model)[0].spec.name, "t");
}

TEST(ReadTrialInput, AClockInMillisecondsIsRefused) {
  const std::string message =
      message_of([&] { (void)WrittenTrial(10.0, 5.0).read(ExactRun::get().result.study); });
  EXPECT_NE(message.find("is the time in ms"), std::string::npos) << message;
}

TEST(ReadTrialInput, EmgThatCoversLessThanHalfOfTheMotionIsRefusedAndALittleLessIsWarnedOf) {
  const Study& study = ExactRun::get().result.study;
  const std::string message = message_of([&] { (void)WrittenTrial(0.1, 20.0).read(study); });
  EXPECT_NE(message.find("covers less than half of the motion (0 to 49.9 s)"), std::string::npos)
      << message;
  const TrialInput shorter = WrittenTrial(0.01, 4.0).read(study);
  ASSERT_EQ(shorter.warnings.size(), 1U);
  EXPECT_NE(shorter.warnings[0].find("0.99 s without EMG"), std::string::npos)
      << shorter.warnings[0];
}

TEST(ReadTrialInput, ACutOffAboveWhatTheRateAllowsIsRefused) {
  Study study = ExactRun::get().result.study;
  study.motion.smoothing = Smoothing::cutoff;
  study.motion.cutoff_hz = 60.0;
  const std::string message = message_of([&] { (void)WrittenTrial(0.01, 5.0).read(study); });
  EXPECT_NE(message.find("cutoff_hz = 60"), std::string::npos) << message;
}

}  // namespace
}  // namespace myoid::pipeline
