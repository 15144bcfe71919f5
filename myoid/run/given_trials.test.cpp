#include "myoid/run/given_trials.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/series_file.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/results/result_files.h"
#include "myoid/run/quality_gates.h"
#include "myoid/run/run_study.h"
#include "myoid/study/read_study.h"
#include "myoid/study/study_ids.h"
#include "myoid/study/study_model.h"

#include "tests/support/exact_recording.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::run {
namespace {

/// A virtual recording without noise with its run, whose stages are files in `results`.
struct Computed {
  test::TemporaryFolder folder;
  StudyResult result;

  Computed() {
    study::Study study = test::exact_recording(folder / "recording");
    study.identify.next_movements = 0;
    result = run_study(study);
    results::write_results(result, {}, folder / "results");
  }
  static const Computed& get() {
    static const Computed run;
    return run;
  }
};

/// Returns the text of a study whose trials give the stages of that run; `model` is its table [model].
std::string given_study(const std::string& model, bool angles) {
  const StudyResult& run = Computed::get().result;
  std::string text = model +
                     "[motion]\nsmoothing = \"none\"\n[emg]\nkind = \"activation\"\n"
                     "[identify]\nmuscle_law = \"paper\"\nmethod = [\"torque\"]\ncross_validate = false\n"
                     "next_movements = 0\n";
  if (!run.source.study.identify.elastic_tendon) text += "tendon = \"rigid\"\n";
  for (const fit::MuscleSetup& muscle : study::muscle_setups(run.source.study, *run.source.model)) {
    std::vector<std::string> start;
    for (const muscle::HillField& field : muscle::kHillFields)
      start.push_back(fmt::format("{} = {:.17g}", field.name, muscle.start.*field.member));
    text += fmt::format("[[muscle]]\nname = \"{0}\"\nemg = \"{1}\"\nstart = {{ {2} }}\n", muscle.name,
                        muscle.emg_channel, fmt::join(start, ", "));
  }
  const NameIds ids = study::trial_ids(run.source.study);
  for (const TrialResult& trial : run.trials) {
    if (!trial.has_motion() || trial.spec.external_torque || trial.emg.activation.empty()) continue;
    text += fmt::format(
        "[[trial]]\nname = \"{0}\"\nuse = \"{2}\"\nemg = \"results/{1}/activation.sto\"\n"
        "lengths = \"results/{1}/MuscleAnalysis_Length.sto\"\n"
        "velocities = \"results/{1}/MuscleAnalysis_MuscleTendonVelocity.sto\"\n"
        "moment_arms = [\"results/{1}/MuscleAnalysis_MomentArm_elbow_flexion.sto\"]\n"
        "torques = \"results/{1}/id.sto\"\n{3}",
        trial.spec.name, ids.of(trial.spec.name), choice_name(trial.spec.use),
        angles ? fmt::format("motion = \"results/{}/ik.mot\"\n", ids.of(trial.spec.name)) : "");
  }
  return text;
}

const std::string kNoModel = "[model]\nbuiltin = \"none\"\ncoordinate = \"elbow_flexion\"\n";

void expect_same_parameters(const StudyResult& given, double relative) {
  const fit::IdentificationResult& own = *torque_of(Computed::get().result.fit);
  const fit::IdentificationResult& found = *torque_of(given.fit);
  int compared = 0;
  for (const fit::ParameterEstimate& e : own.estimates) {
    for (const fit::ParameterEstimate& f : found.estimates) {
      if (f.muscle != e.muscle || f.parameter != e.parameter) continue;
      EXPECT_NEAR(f.estimate, e.estimate, relative * std::abs(e.estimate)) << e.muscle << " " << e.parameter;
      ++compared;
    }
  }
  EXPECT_GE(compared, 24) << "six numbers of each of four muscles";
}

// The files hold the stages to 1e-9 of their size or better; the fit without noise amplifies errors by less than 1e4.
TEST(GivenTrials, TheStagesOfARunGiveItsParametersWithoutAModel) {
  const Computed& run = Computed::get();
  write_file(run.folder / "given.toml", given_study(kNoModel, false));
  const StudyResult given = run_study(study::read_study(run.folder / "given.toml"));
  EXPECT_TRUE(given.trials[0].has_motion());
  EXPECT_EQ(given.trials[0].motion.joints.q.channel_count(), 0);
  expect_same_parameters(given, 1e-5);
  for (const page::Gate& gate : quality_gates(given)) EXPECT_NE(gate.status, page::GateStatus::fail) << gate.name;
}

TEST(GivenTrials, TheStagesOfARunGiveItsParametersWithItsModel) {
  const Computed& run = Computed::get();
  const std::string model = run.result.source.study.model.file->filename().string();
  write_file(run.folder / "with_model.toml",
             given_study("[model]\nfile = \"recording/" + model + "\"\ncoordinate = \"elbow_flexion\"\n", true));
  const StudyResult given = run_study(study::read_study(run.folder / "with_model.toml"));
  expect_same_parameters(given, 1e-5);
  // The trial's times are those of the lengths, and its stages those of the files.
  const TrialResult& trial = given.trials[0];
  EXPECT_EQ(trial.motion.joints.sample_count(), trial.input.given.lengths->sample_count());
  EXPECT_EQ(trial.forces.muscle_torque.values(), trial.input.given.torques->values());
}

TEST(GivenTrials, AStudyWithoutFileWhoseTrialsGiveEverythingHasNoModel) {
  const std::string joint = "[model]\ncoordinate = \"elbow_flexion\"\n";
  EXPECT_TRUE(study::parse_study(given_study(joint, false), "study.toml").model.is_none());
  const auto message = [](const std::string& text) {
    return test::message_of([&] { (void)study::parse_study(text, "study.toml"); });
  };
  EXPECT_NE(message(given_study("", false)).find("coordinate"), std::string::npos);
  EXPECT_NE(message(given_study("[model]\nbuiltin = \"arm4\"\n", false)).find("builtin = \"none\""), std::string::npos);
  const std::string two = "[model]\nbuiltin = \"none\"\ncoordinate = [\"elbow_flexion\", \"wrist\"]\n";
  EXPECT_NE(message(given_study(two, false)).find("moment_arms, expected 2"), std::string::npos);
}

TEST(GivenTrials, MomentArmsOfTheOtherSignStopTheRun) {
  const Computed& run = Computed::get();
  std::string text = given_study(kNoModel, false);
  const std::string name = "MuscleAnalysis_MomentArm_elbow_flexion.sto";
  for (const TrialResult& trial : run.result.trials) {
    const auto place = run.folder / "results" / study::trial_ids(run.result.source.study).of(trial.spec.name);
    if (!std::filesystem::exists(place / name)) continue;
    const TimeSeries arms = recording::read_storage(place / name).data;
    recording::write_series(place / "reversed.sto", {arms.time_s(), arms.channels(), -arms.values()}, "arms");
  }
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name))
    text.replace(at, name.size(), "reversed.sto");
  write_file(run.folder / "reversed.toml", text);
  const std::string message =
      test::message_of([&] { (void)run_study(study::read_study(run.folder / "reversed.toml")); });
  EXPECT_NE(message.find("reversed.sto"), std::string::npos) << message;
}

}  // namespace
}  // namespace myoid::run
