#include "myoid/program/commands/identify_study.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/program/commands/identify.h"
#include "myoid/program/commands/run.h"
#include "myoid/recording/series_file.h"
#include "myoid/study/read_study.h"

#include "tests/support/elbow_study.h"
#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

/// Files of a made-up person, with noise.
struct Files {
  test::TemporaryFolder folder;
  test::ElbowStudy study;
  IdentifyOptions options;

  Files() {
    test::ElbowStudyOptions person = test::noisy_person(5);
    person.seconds = 15.0;
    study = test::elbow_study(person);
    std::string csv = "muscle";
    for (const muscle::HillField& field : muscle::kHillFields) csv += fmt::format(",{}", field.name);
    csv += "\n";
    for (const fit::MuscleSetup& muscle : study.data.muscles) {
      csv += muscle.name;
      for (const muscle::HillField& field : muscle::kHillFields)
        csv += fmt::format(",{:.17g}", muscle.start.*field.member);
      csv += "\n";
    }
    write_file(folder / "muscles.csv", csv);
    options.muscles = folder / "muscles.csv";
    for (std::size_t i = 0; i < study.data.trials.size(); ++i) add_trial(fmt::format("t{}", i), study.data.trials[i]);
    options.folds.reset();
  }
  void add_trial(const std::string& name, const fit::TrialData& trial) {
    const auto write = [&](const char* what, const Eigen::MatrixXd& values, Unit unit) {
      std::vector<Channel> channels;
      for (const fit::MuscleSetup& muscle : study.data.muscles) channels.push_back({muscle.name, unit});
      const auto path = folder / fmt::format("{}_{}.sto", name, what);
      recording::write_series(path, {trial.time_s, channels, values}, what);
      return path.string();
    };
    options.files.lengths.push_back(write("l", trial.length_m, Unit::meter));
    options.files.velocities.push_back(write("v", trial.velocity_mps, Unit::meter_per_second));
    options.files.moment_arms.push_back(write("r", trial.moment_arm_m, Unit::meter));
    const auto emg = folder / (name + "_a.sto"), torque = folder / (name + "_id.sto");
    recording::write_series(emg, trial.activation, "activation");
    recording::write_series(torque, {trial.time_s, {{"elbow_moment", Unit::newton_meter}}, trial.torque_nm}, "torque");
    options.files.activations.push_back(emg.string());
    options.files.torques.push_back(torque.string());
  }
};

void expect_same(const fit::IdentificationResult& a, const fit::IdentificationResult& b) {
  ASSERT_EQ(a.estimates.size(), b.estimates.size());
  for (std::size_t i = 0; i < a.estimates.size(); ++i) {
    const fit::ParameterEstimate &x = a.estimates[i], &y = b.estimates[i];
    EXPECT_EQ(x.muscle, y.muscle);
    EXPECT_EQ(x.parameter, y.parameter);
    // Both searches end at one mode, to their tolerance; a study without a tie or prior differs in the first digits.
    EXPECT_NEAR(x.estimate, y.estimate, 1e-5 * std::max(std::abs(x.estimate), 1e-3)) << x.muscle << " " << x.parameter;
    EXPECT_EQ(x.verdict, y.verdict) << x.muscle << " " << x.parameter;
  }
}

/// Writes the results of `identify`, and runs the study among them.
RunResult run_of(IdentifyResult& result, const std::filesystem::path& folder) {
  write_identify(result, folder);
  RunOptions options;
  options.study = (folder / "study.toml").string();
  return run(options);
}

TEST(IdentifyStudy, RunFindsTheParametersOfTheStudyAmongTheResults) {
  Files files;
  files.options.exports = {results::ExportFormat::ceinms, results::ExportFormat::osim, results::ExportFormat::ceinms};
  IdentifyResult result = identify(files.options);
  const std::filesystem::path folder = files.folder / "results";
  const RunResult same = run_of(result, folder);
  EXPECT_EQ(result.run.exports.size(), 1U);  // each form once, and the model by every run that has one
  for (const char* file : {"ceinms_calibrated.xml", "ceinms_uncalibrated.xml"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  expect_same(result.fit(), *run::torque_of(same.study.fit));
  EXPECT_EQ(result.run.gates.size(), same.gates.size());
  for (const char* file : {"report.html", "run.json", "parameters.json", "1_t0_l/id.sto"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
}

TEST(IdentifyStudy, RunFitsGivenForcesAsIdentifyDoes) {
  Files files;
  IdentifyOptions& o = files.options;
  o.method = fit::Method::force;
  for (std::size_t i = 0; i < files.study.data.trials.size(); ++i) {
    const fit::TrialData& trial = files.study.data.trials[i];
    std::vector<Channel> channels;
    for (const fit::MuscleSetup& muscle : files.study.data.muscles) channels.push_back({muscle.name, Unit::newton});
    const auto path = files.folder / fmt::format("t{}_f.sto", i);
    recording::write_series(path, {trial.time_s, channels, trial.force_n}, "forces");
    o.files.forces.push_back(path.string());
  }
  o.files.torques.clear();
  o.files.moment_arms.clear();
  IdentifyResult result = identify(o);
  const RunResult same = run_of(result, files.folder / "results");
  ASSERT_NE(run::method_of(same.study.fit, fit::Method::force), nullptr);
  expect_same(result.fit(), *run::method_of(same.study.fit, fit::Method::force));
  EXPECT_TRUE(same.study.trials[0].forces.generalized.empty());
}

TEST(IdentifyStudy, WishesOfTheTableAndOfTheOptionsStandInTheStudy) {
  Files files;
  const auto& muscles = files.study.data.muscles;
  std::string csv =
      "muscle,emg,max_isometric_force,optimal_fiber_length,tendon_slack_length,max_isometric_force_prior_sd,"
      "optimal_fiber_length_lower,concentric_curvature_fixed,pennation_angle\n";
  for (std::size_t k = 0; k < muscles.size(); ++k)
    csv += fmt::format("{},{},{:.17g},{:.17g},{:.17g},100,0.05,{},{}\n", muscles[k].name,
                       k == 1 ? muscles[0].name : muscles[k].name, muscles[k].start.max_isometric_force_n,
                       muscles[k].start.optimal_fiber_length_m, muscles[k].start.tendon_slack_length_m,
                       k == 2 ? "true" : "", k == 3 ? "0.2" : "");
  write_file(files.folder / "muscles.csv", csv);
  files.options.hold = {"emg_exponent"};
  files.options.delay_s = 0.05;
  IdentifyResult result = identify(files.options);
  expect_same(result.fit(), *run::torque_of(run_of(result, files.folder / "results").study.fit));
}

TEST(IdentifyStudy, ATrialHasItsMeasuredFasciclesOrNone) {
  Files files;
  files.options.files.fascicles.assign(files.options.files.lengths.size(), std::string(run::kNoFile));
  files.options.files.fascicles[1] = "ultrasound.csv";
  Remarks remarks(files.options.call);
  run::MuscleTable table;
  table.muscles = files.study.data.muscles;
  const study::Study study = identify_study(files.options, table, remarks);
  ASSERT_GT(study.trials.size(), 1U);
  EXPECT_FALSE(study.trials[0].fascicles);
  EXPECT_EQ(study.trials[1].fascicles, "ultrasound.csv");
  EXPECT_EQ(seen_from("results", study).trials[1].fascicles, "../ultrasound.csv");
  EXPECT_TRUE(without_effect(files.options).empty());
  files.options.files.fascicles.pop_back();
  EXPECT_THROW((void)identify_study(files.options, table, remarks), InvalidInput);
  files.options.method = fit::Method::force;
  EXPECT_EQ(without_effect(files.options).size(), 3U);  // beside torques and moment arms
}

TEST(IdentifyStudy, LagsToBeIdentifiedLeaveNoOtherWayToFollowTheEmg) {
  Files files;
  files.options.free_more = {"excitation_time"};
  Remarks remarks(files.options.call);
  run::MuscleTable table;
  table.muscles = files.study.data.muscles;
  EXPECT_TRUE(identify_study(files.options, table, remarks).identify.dynamics);
  ASSERT_EQ(remarks.list().size(), 1U);
  EXPECT_NE(remarks.list()[0].says.find("lags of equation (1)"), std::string::npos);
  files.options.lag = fit::LagChoice::shared;
  EXPECT_THROW((void)identify_study(files.options, table, remarks), InvalidInput);
}

}  // namespace
}  // namespace myoid::program
