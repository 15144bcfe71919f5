#include "myoid/pipeline/identify_data.h"

#include <string>

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/series_file.h"
#include "myoid/recording/text_file.h"

#include "tests/support/elbow_study.h"
#include "tests/support/temporary_folder.h"

namespace myoid::pipeline {
namespace {

/// A made-up trial of four muscles, in files.
struct Written {
  test::TemporaryFolder folder;
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 5.0});
  MuscleTable table;
  IdentifySources sources;
  std::vector<std::string> remarks;

  Written() {
    table.muscles = study.data.muscles;
    const identification::TrialData& trial = study.data.trials[0];
    recording::write_series(folder / "a.sto", trial.activation, "activation");
    write("l.sto", trial.length_m, Unit::meter);
    write("v.sto", trial.velocity_mps, Unit::meter_per_second);
    write("r.sto", trial.moment_arm_m, Unit::meter);
    recording::write_series(folder / "id.sto",
                            {trial.time_s, {{"elbow_moment", Unit::newton_meter}}, trial.torque_nm},
                            "torque");
    sources.activations = {path("a.sto")};
    sources.lengths = {path("l.sto")};
    sources.velocities = {path("v.sto")};
    sources.moment_arms = {path("r.sto")};
    sources.torques = {path("id.sto")};
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
  void write(const std::string& name, const Eigen::MatrixXd& values, Unit unit) const {
    std::vector<Channel> channels;
    for (const auto& muscle : study.data.muscles) channels.push_back({muscle.name, unit});
    recording::write_series(folder / name, {study.data.trials[0].time_s, channels, values}, name);
  }
  identification::TrialData read() {
    return read_identify_data(sources, table,
                              [&](const std::string& text) { remarks.push_back(text); })
        .trials.at(0);
  }
  std::string message() {
    try {
      (void)read();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "(no error)";
  }
};

TEST(IdentifyData, ColumnsComeBackByNameOnTheClockOfTheLengths) {
  Written files;
  const identification::TrialData& truth = files.study.data.trials[0];
  const identification::TrialData trial = files.read();
  EXPECT_EQ(trial.time_s, truth.time_s);
  EXPECT_EQ(trial.length_m, truth.length_m);
  EXPECT_EQ(trial.moment_arm_m, truth.moment_arm_m);
  EXPECT_EQ(trial.torque_nm, truth.torque_nm);
  EXPECT_TRUE(files.remarks.empty());
}

TEST(IdentifyData, WithoutVelocitiesTheyAreTheRatesOfTheLengths) {
  Written files;
  files.sources.velocities.clear();
  const identification::TrialData& truth = files.study.data.trials[0];
  // Movements below 2 Hz at 100 Hz; the spline is least good at the ends, where it has one side.
  EXPECT_LT((files.read().velocity_mps - truth.velocity_mps).cwiseAbs().maxCoeff(),
            1e-3 * truth.velocity_mps.cwiseAbs().maxCoeff());
}

TEST(IdentifyData, OnlyTheTimeThatAllFilesCoverIsTaken) {
  Written files;
  const identification::TrialData& truth = files.study.data.trials[0];
  recording::write_series(
      files.folder / "id.sto",
      TimeSeries(truth.time_s, {{"elbow_moment", Unit::newton_meter}}, truth.torque_nm)
          .slice(1.0, 4.0),
      "torque");
  const identification::TrialData trial = files.read();
  EXPECT_NEAR(trial.time_s[0], 1.0, 1e-9);
  EXPECT_NEAR(trial.time_s[trial.time_s.size() - 1], 4.0, 1e-9);
  files.sources.start_s = 4.5;
  EXPECT_NE(files.message().find("must overlap"), std::string::npos) << files.message();
}

TEST(IdentifyData, ACutOffFileIsSaidOnceWithWhatWasLeftOut) {
  Written files;
  std::string text = recording::read_text_file(files.folder / "l.sto");
  text.resize(text.size() - 200);
  recording::write_file(files.folder / "l.sto", text);
  (void)files.read();
  int said = 0;
  for (const std::string& remark : files.remarks)
    said += remark.find("l.sto") != std::string::npos &&
                    remark.find(recording::kLastRowLeftOut) != std::string::npos
                ? 1
                : 0;
  EXPECT_EQ(said, 1);
}

TEST(IdentifyData, ActivationsThatAreNamedTwiceAreRemarkedOf) {
  Written once;
  (void)once.read();
  EXPECT_TRUE(once.remarks.empty());
  Written twice;
  for (auto* files : {&twice.sources.activations, &twice.sources.lengths, &twice.sources.velocities,
                      &twice.sources.moment_arms, &twice.sources.torques})
    files->push_back(files->front());
  (void)twice.read();
  ASSERT_EQ(twice.remarks.size(), 1U);
  EXPECT_NE(twice.remarks[0].find("one effort counts twice"), std::string::npos)
      << twice.remarks[0];
}

TEST(IdentifyData, FilesThatDoNotMatchTheTrialsOrTheMusclesAreRefused) {
  Written two;
  two.sources.torques.push_back(two.sources.torques[0]);
  EXPECT_NE(two.message().find("--torques: 2 files for 1 trials"), std::string::npos);
  Written other;
  other.table.muscles[0].name = "SOL";
  EXPECT_NE(other.message().find("no column 'SOL'"), std::string::npos) << other.message();
  Written joint;
  joint.sources.coordinates = {"knee"};
  EXPECT_NE(joint.message().find("no column 'knee' or 'knee_moment'"), std::string::npos);
}

}  // namespace
}  // namespace myoid::pipeline
