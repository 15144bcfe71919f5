#include "myoid/run/run_study.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "myoid/recording/tables/csv_reader.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/results/parameter_files.h"
#include "myoid/results/result_files.h"
#include "myoid/results/study_report.h"
#include "myoid/run/quality_gates.h"
#include "myoid/study/study_model.h"

#include "tests/support/exact_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::run {
namespace {

/// The exact virtual recording, written once and run once for all tests of this file.
struct ExactRun {
  test::TemporaryFolder folder;
  StudyResult result;

  ExactRun() { result = run_study(test::exact_recording(folder / "recording"), {.store = folder / "stages"}); }
  static const ExactRun& get() {
    static const ExactRun run;
    return run;
  }
};

TEST(RunStudy, ASecondRunReusesInverseKinematicsAndFindsTheSame) {
  const ExactRun& first = ExactRun::get();
  study::Study study = first.result.source.study;
  study.identify.methods = {fit::Method::paper};
  study.emg.chain.lowpass_hz = 5.0;
  const StudyResult second = run_study(study, {.store = first.folder / "stages"});
  ASSERT_EQ(second.trials.size(), first.result.trials.size());
  int with_markers = 0;
  for (std::size_t i = 0; i < second.trials.size(); ++i) {
    if (!second.trials[i].motion.ik) continue;
    ++with_markers;
    EXPECT_FALSE(first.result.trials[i].motion.ik_reused);
    EXPECT_TRUE(second.trials[i].motion.ik_reused);
    EXPECT_EQ(first.result.trials[i].motion.ik->q.values(), second.trials[i].motion.ik->q.values());
  }
  EXPECT_GT(with_markers, 0);
}

TEST(RunStudy, FromExactFilesEveryParameterIsTheTruthToAMillionth) {
  const StudyResult& result = ExactRun::get().result;
  ASSERT_EQ(result.fit.methods.size(), 2U);
  const fit::IdentificationResult& torque = result.fit.methods[1];
  int compared = 0;
  for (const auto& e : torque.estimates) {
    for (const TrueValue& t : result.source.truth) {
      if (t.parameter != e.parameter || t.muscle != e.muscle) continue;
      EXPECT_NEAR(e.estimate, t.value, 1e-6 * std::abs(t.value)) << e.muscle << " " << e.parameter;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 25);  // six of each muscle, and the delay
}

TEST(RunStudy, PlansNoRecordingOnNumbersThatFailed) {
  study::Study study = ExactRun::get().result.source.study;
  study.identify.methods = {fit::Method::torque};
  study.identify.cross_validate = false;
  study.identify.next_movements = 1;
  // A held mass that acts nowhere is the failure of its trial.
  study.model.held_mass.reset();
  for (study::TrialSpec& trial : study.trials) trial.held_mass_kg = 0.0;
  const auto moves = std::ranges::find(study.trials, study::Use::calibration, &study::TrialSpec::use);
  ASSERT_NE(moves, study.trials.end());
  moves->held_mass_kg = 2.0;
  const StudyResult failed = run_study(study, {.store = ExactRun::get().folder / "stages"});
  EXPECT_FALSE(failed.next);
  EXPECT_EQ(std::ranges::find(failed.times, "next recording", &StageTime::stage), failed.times.end());
}

TEST(WriteResults, LeavesTheFilesThatArePromised) {
  const ExactRun& run = ExactRun::get();
  const auto out = run.folder / "results";
  results::write_results(run.result, {}, out);
  const std::string trial = run.result.fit_input.data.trials.front().name;
  for (const std::string name : {"ik.mot", "ik_marker_errors.sto", "id.sto", "MuscleAnalysis_Length.sto",
                                 "MuscleAnalysis_MuscleTendonVelocity.sto",
                                 "MuscleAnalysis_MomentArm_elbow_flexion.sto", "StaticOptimization_force.sto",
                                 "StaticOptimization_activation.sto", "activation.sto", "identified_forces.sto"}) {
    EXPECT_GT(recording::read_storage(out / trial / name).data.sample_count(), 10) << name;
  }
  const recording::CsvTable table = recording::read_csv_table(out / "parameters.csv");
  const std::vector<std::string> columns{"muscle",         "parameter",    "unit",          "method",     "case",
                                         "initial",        "estimate",     "std_error",     "ci_low",     "ci_high",
                                         "given_estimate", "given_ci_low", "given_ci_high", "prior_mean", "prior_sd",
                                         "shrinkage",      "at_bound",     "verdict",       "reason"};
  EXPECT_EQ(table.names, columns);
  EXPECT_TRUE(std::filesystem::exists(out / "run.json"));
  EXPECT_TRUE(std::filesystem::exists(out / "parameters.json"));
}

TEST(IdentifiedModel, DiffersFromTheInputOnlyInIdentifiedNumbers) {
  const StudyResult& result = ExactRun::get().result;
  study::IdentifiedMuscle muscle{
      "BIC", result.fit_input.data.muscles[0].start, result.fit_input.data.muscles[0].start, {"max_isometric_force"}};
  EXPECT_EQ(study::identified_model(result.source.study, result.source.model_text,
                                    {{"BIC", muscle.start, muscle.identified, {}}}),
            result.source.model_text);
  muscle.identified.max_isometric_force_n *= 2.0;
  const std::string changed = study::identified_model(result.source.study, result.source.model_text, {muscle});
  pugi::xml_document before;
  pugi::xml_document after;
  ASSERT_TRUE(before.load_string(result.source.model_text.c_str()));
  ASSERT_TRUE(after.load_string(changed.c_str()));
  const char* path = "//*[@name='BIC']/max_isometric_force";
  EXPECT_DOUBLE_EQ(after.select_node(path).node().text().as_double(),
                   2.0 * before.select_node(path).node().text().as_double());
  const char* other = "//*[@name='TRI']/max_isometric_force";
  EXPECT_EQ(std::string(after.select_node(other).node().text().get()), before.select_node(other).node().text().get());
}

TEST(RunStudy, TheReportHasMethodForce) {
  StudyResult result = ExactRun::get().result;
  const auto torque = std::find_if(result.fit.methods.begin(), result.fit.methods.end(),
                                   [](const auto& m) { return m.method == fit::Method::torque; });
  ASSERT_NE(torque, result.fit.methods.end());
  fit::IdentificationResult force = *torque;
  force.method = fit::Method::force;
  result.fit.methods = {force};
  const page::Report report = results::study_report(result, {});
  EXPECT_EQ(report.headline.find("source paper"), std::string::npos) << report.headline;
  const auto section = std::find_if(report.sections.begin(), report.sections.end(),
                                    [](const page::Section& s) { return s.id == "force_method"; });
  ASSERT_NE(section, report.sections.end());
  EXPECT_EQ(section->tables.front().id, "parameters_force");
}

TEST(StudyReport, HasGatesTablesAndFiguresThatFitTogether) {
  const page::Report report = results::study_report(ExactRun::get().result, {});
  EXPECT_NO_THROW(page::validate(report));
  EXPECT_GE(report.gates.size(), 5U);
  std::vector<std::string> tables;
  for (const page::Section& section : report.sections) {
    for (const page::Table& table : section.tables) tables.push_back(table.id);
  }
  for (const std::string wanted : {"parameters_torque", "table_1_shortening", "table_2_lengthening", "trials"}) {
    EXPECT_NE(std::find(tables.begin(), tables.end(), wanted), tables.end()) << wanted;
  }
}

TEST(IdentifiedModel, AWidthIsWrittenOnlyWhereWidthAndLengthAreBothIdentified) {
  const StudyResult& result = ExactRun::get().result;
  const auto start = result.fit_input.data.muscles[0].start;
  study::IdentifiedMuscle muscle{"BIC", start, start, {"optimal_fiber_length"}};
  muscle.identified.optimal_fiber_length_m *= 1.1;
  muscle.identified.force_length_width_m *= 1.3;
  muscle.identified.concentric_curvature *= 1.2;
  muscle.identified.eccentric_plateau *= 1.05;
  const auto number = [&](const std::vector<std::string>& changed, const std::string& property) {
    muscle.changed = changed;
    pugi::xml_document document;
    EXPECT_TRUE(
        document.load_string(study::identified_model(result.source.study, result.source.model_text, {muscle}).c_str()));
    return document.select_node(("//*[@name='BIC']/" + property).c_str()).node().text().as_double();
  };
  const std::vector<std::string> all{"optimal_fiber_length", "force_length_width", "concentric_curvature",
                                     "eccentric_plateau", "max_isometric_force"};
  for (const auto& [property, needed] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"KshapeActive", {"optimal_fiber_length", "force_length_width"}},
           {"optimal_fiber_length", {"optimal_fiber_length"}},
           {"Af", {"concentric_curvature"}},
           {"Flen", {"eccentric_plateau"}}}) {
    const double before = number({}, property);
    EXPECT_NE(number(needed, property), before) << property;
    // Without any one of what it is made of it stays, whatever else is identified.
    for (const std::string& left_out : needed) {
      std::vector<std::string> others = all;
      std::erase(others, left_out);
      EXPECT_EQ(number(others, property), before) << property << " without " << left_out;
    }
  }
  const double ratio = muscle.identified.force_length_width_m / muscle.identified.optimal_fiber_length_m;
  EXPECT_NEAR(number(all, "KshapeActive"), ratio * ratio, 1e-12);
}

}  // namespace
}  // namespace myoid::run
