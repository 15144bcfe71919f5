// The data that `identify` fits: those that `run` makes of its study.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/commands/identify_study.h"
#include "myoid/recording/series_file.h"
#include "myoid/recording/tables/storage_writer.h"
#include "myoid/run/run_study.h"

#include "tests/support/elbow_study.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

/// A made-up trial of four muscles, in files.
struct Written {
  test::TemporaryFolder folder;
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 5.0});
  run::MuscleTable table;
  IdentifyOptions options;
  run::IdentifySources& sources = options.files;
  std::vector<std::string> remarks;  ///< Warnings.
  std::vector<std::string> notes;

  Written() {
    table.muscles = study.data.muscles;
    const fit::TrialData& trial = study.data.trials[0];
    options.muscles = folder / "muscles.csv";
    write_file(options.muscles, "muscle\n");
    recording::write_series(folder / "a.sto", trial.activation, "activation");
    write("l.sto", trial.length_m, Unit::meter);
    write("v.sto", trial.velocity_mps, Unit::meter_per_second);
    write("r.sto", trial.moment_arm_m, Unit::meter);
    recording::write_series(folder / "id.sto", {trial.time_s, {{"elbow_moment", Unit::newton_meter}}, trial.torque_nm},
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
  fit::StudyData read_all() {
    Remarks of_options(options.call);
    const run::StudyResult result =
        run::study_data(identify_study(options, table, of_options), {.share_forces = false});
    for (const run::TrialResult& trial : result.trials) {
      for (std::string& text : sentences(trial.remarks, Severity::warning)) remarks.push_back(std::move(text));
      for (std::string& text : sentences(trial.remarks, Severity::note)) notes.push_back(std::move(text));
    }
    return result.fit_input.data;
  }
  fit::TrialData read() { return read_all().trials.at(0); }
  std::string message() {
    return test::message_of([&] { (void)read(); });
  }
};

TEST(IdentifyData, ColumnsComeBackByNameOnTheClockOfTheLengths) {
  Written files;
  const fit::TrialData& truth = files.study.data.trials[0];
  const fit::TrialData trial = files.read();
  EXPECT_EQ(trial.time_s, truth.time_s);
  EXPECT_EQ(trial.length_m, truth.length_m);
  EXPECT_EQ(trial.moment_arm_m, truth.moment_arm_m);
  EXPECT_EQ(trial.torque_nm, truth.torque_nm);
  EXPECT_TRUE(files.remarks.empty());
}

TEST(IdentifyData, ABrokenChannelThatNoMuscleTakesIsNoFault) {
  Written files;
  const TimeSeries& emg = files.study.data.trials[0].activation;
  const auto with = [&](const std::string& broken) {
    // CSV, because the writer of storage files refuses numbers that are none.
    std::string text = "time," + broken;
    for (const Channel& channel : emg.channels()) text += "," + channel.name;
    for (Eigen::Index i = 0; i < emg.sample_count(); ++i) {
      text += fmt::format("\n{:.17g},{}", emg.time_s()[i], i == 7 ? "NaN" : "0.1");
      for (Eigen::Index c = 0; c < emg.channel_count(); ++c) text += fmt::format(",{:.17g}", emg.values()(i, c));
    }
    write_file(files.folder / "a.csv", text + "\n");
    files.sources.activations = {files.path("a.csv")};
  };
  with("glutmax");
  EXPECT_EQ(files.read().activation.channel_count(), emg.channel_count());
  files.table.muscles[0].emg_channel = "glutmax";
  EXPECT_NE(files.message().find("channel 'glutmax' is not a number"), std::string::npos) << files.message();
}

TEST(IdentifyData, WithoutVelocitiesTheyAreTheRatesOfTheLengths) {
  Written files;
  files.sources.velocities.clear();
  const fit::TrialData& truth = files.study.data.trials[0];
  // Movements below 2 Hz at 100 Hz; the spline is least good at the ends, where it has one side.
  EXPECT_LT((files.read().velocity_mps - truth.velocity_mps).cwiseAbs().maxCoeff(),
            1e-3 * truth.velocity_mps.cwiseAbs().maxCoeff());
}

TEST(IdentifyData, OnlyTheTimeThatAllFilesCoverIsTaken) {
  Written files;
  const fit::TrialData& truth = files.study.data.trials[0];
  recording::write_series(
      files.folder / "id.sto",
      TimeSeries(truth.time_s, {{"elbow_moment", Unit::newton_meter}}, truth.torque_nm).slice(1.0, 4.0), "torque");
  const fit::TrialData trial = files.read();
  EXPECT_NEAR(trial.time_s[0], 1.0, 1e-9);
  EXPECT_NEAR(trial.time_s[trial.time_s.size() - 1], 4.0, 1e-9);
  EXPECT_TRUE(files.remarks.empty());  // most of the trial is used
  files.options.call.start_s = 4.5;
  EXPECT_NE(files.message().find("must overlap"), std::string::npos) << files.message();
}

TEST(IdentifyData, AFileThatLeavesOutMostOfATrialIsNamed) {
  Written files;
  const fit::TrialData& truth = files.study.data.trials[0];
  recording::write_series(
      files.folder / "id.sto",
      TimeSeries(truth.time_s, {{"elbow_moment", Unit::newton_meter}}, truth.torque_nm).slice(0.0, 1.3), "torque");
  EXPECT_NEAR(files.read().time_s.maxCoeff(), 1.3, 1e-9);
  ASSERT_EQ(files.remarks.size(), 1U);
  EXPECT_NE(files.remarks[0].find("1.3 of 5 s are used"), std::string::npos) << files.remarks[0];
  EXPECT_NE(files.remarks[0].find("id.sto 0 to 1.3 s"), std::string::npos);
  // Part of a trial that is asked for is not a part that is missing.
  files.remarks.clear();
  files.options.call.end_s = 1.0;
  (void)files.read();
  EXPECT_TRUE(files.remarks.empty());
}

TEST(IdentifyData, ACutOffFileIsSaidOnceWithWhatWasLeftOut) {
  Written files;
  std::string text = read_text_file(files.folder / "l.sto");
  text.resize(text.size() - 200);
  write_file(files.folder / "l.sto", text);
  (void)files.read();
  int said = 0;
  for (const std::string& remark : files.remarks)
    said += remark.find("l.sto") != std::string::npos && remark.find(kLastRowLeftOut) != std::string::npos ? 1 : 0;
  EXPECT_EQ(said, 1);
}

TEST(IdentifyData, WhereAFileHasNoSamplesNothingIsFittedAndThatIsSaid) {
  const auto without_a_second = [](const TimeSeries& series) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < series.sample_count(); ++i) {
      if (series.time_s()[i] <= 2.0 || series.time_s()[i] >= 3.0) rows.push_back(i);
    }
    return TimeSeries(series.time_s()(rows), series.channels(), series.values()(rows, Eigen::all));
  };
  for (const std::string name : {"a.sto", "l.sto", "v.sto", "r.sto", "id.sto"}) {
    SCOPED_TRACE(name);
    Written files;
    recording::write_series(files.folder / name, without_a_second(recording::read_series(files.path(name)).data), name);
    const fit::TrialData trial = files.read();
    ASSERT_EQ(trial.excluded.size(), 1U);
    EXPECT_NEAR(trial.excluded[0].begin_s, 1.9, 0.02);
    EXPECT_NEAR(trial.excluded[0].end_s, name == "a.sto" ? 3.3 : 3.1, 0.02);
    ASSERT_EQ(files.remarks.size(), 1U) << fmt::format("{}", fmt::join(files.remarks, "; "));
    EXPECT_NE(files.remarks[0].find(name), std::string::npos) << files.remarks[0];
    EXPECT_NE(files.remarks[0].find("no samples from 2.0"), std::string::npos) << files.remarks[0];
    // The true muscles make the torque but for the splines' errors beside the gap; within it they do not.
    const auto worst_error = [&](const fit::TrialData& fitted) {
      const Eigen::VectorXd made =
          fit::predict(files.study.data, fitted, files.study.truth, files.study.delay_s).torque_nm;
      const std::vector<Eigen::Index> rows = fit::included_rows(fitted);
      return (made - fitted.torque_nm)(rows).cwiseAbs().maxCoeff() / fitted.torque_nm.cwiseAbs().maxCoeff();
    };
    fit::TrialData whole = trial;
    whole.excluded.clear();
    EXPECT_LT(worst_error(trial), 0.015);
    // Without rows of its own a gap of the lengths makes nothing up.
    if (name != "l.sto") {
      EXPECT_GT(worst_error(whole), 2.0 * worst_error(trial));
    }
  }
}

TEST(IdentifyData, ATorqueOfNothingIsRefused) {
  Written files;
  const Eigen::VectorXd& time_s = files.study.data.trials[0].time_s;
  recording::write_series(
      files.folder / "id.sto",
      TimeSeries(time_s, {{"elbow_moment", Unit::newton_meter}}, Eigen::MatrixXd::Zero(time_s.size(), 1)), "torque");
  EXPECT_NE(files.message().find("id.sto: the torque 'joint' is 0 in all trials"), std::string::npos)
      << files.message();
}

TEST(IdentifyData, AnEffortThatIsAlwaysTheGreatestIsNoDeadElectrode) {
  Written files;
  const TimeSeries& activation = files.study.data.trials[0].activation;
  for (const double level : {1.0, 0.01}) {
    Eigen::MatrixXd values = activation.values();
    values.col(1).setConstant(level);
    recording::write_series(files.folder / "a.sto", TimeSeries(activation.time_s(), activation.channels(), values),
                            "a");
    files.remarks.clear();
    (void)files.read();
    const auto dead = std::ranges::count_if(
        files.remarks, [](const std::string& text) { return text.find("never changes") != std::string::npos; });
    EXPECT_EQ(dead, level < 0.5 ? 1 : 0) << level;
  }
}

TEST(IdentifyData, AnElectrodeThatSaysNothingOrTheSameAsAnotherIsRemarkedOf) {
  Written files;
  const TimeSeries& activation = files.study.data.trials[0].activation;
  Eigen::MatrixXd values = activation.values();
  values.col(1).setZero();
  values.col(3) = values.col(0);
  recording::write_series(files.folder / "a.sto", TimeSeries(activation.time_s(), activation.channels(), values), "a");
  (void)files.read();
  ASSERT_EQ(files.remarks.size(), 2U);
  EXPECT_NE(files.remarks[0].find("'BRA' never changes"), std::string::npos) << files.remarks[0];
  EXPECT_NE(files.remarks[1].find("'BIC' and 'TRI' are the same"), std::string::npos) << files.remarks[1];
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
  EXPECT_NE(twice.remarks[0].find("one effort would count twice"), std::string::npos) << twice.remarks[0];
}

TEST(IdentifyData, ViscosityInertiaAndStiffnessComeBackFromTheJointsMotion) {
  Written files;
  // T = sum r F - B qdot - J qddot - k q of an angle whose derivatives are known.
  constexpr double kViscosity = 0.31, kInertia = 0.012, kStiffness = 1.7;
  const fit::TrialData& truth = files.study.data.trials[0];
  const Eigen::ArrayXd t = truth.time_s.array();
  const Eigen::VectorXd q = 1.1 + 0.7 * (3.1 * t).sin() + 0.3 * (7.3 * t).cos();
  const Eigen::VectorXd qdot = 0.7 * 3.1 * (3.1 * t).cos() - 0.3 * 7.3 * (7.3 * t).sin();
  const Eigen::VectorXd qddot = -0.7 * 3.1 * 3.1 * (3.1 * t).sin() - 0.3 * 7.3 * 7.3 * (7.3 * t).cos();
  recording::write_series(files.folder / "id.sto",
                          {truth.time_s,
                           {{"elbow_moment", Unit::newton_meter}},
                           truth.torque_nm - kViscosity * qdot - kInertia * qddot - kStiffness * q},
                          "torque");
  recording::write_storage(files.folder / "q.mot", {truth.time_s, {{"elbow", Unit::radian}}, q},
                           {.title = "Coordinates", .angles_in_degrees = true});
  files.sources.motions = {files.path("q.mot")};
  const fit::TrialData trial = files.read();
  // The natural quintic, away from its ends: (h w)^6 and less.
  const Eigen::Index margin = 30, n = q.size() - 2 * margin;
  EXPECT_LT((trial.angle_rad - q).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((trial.velocity_radps - qdot).segment(margin, n).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((trial.acceleration_radps2 - qddot).segment(margin, n).cwiseAbs().maxCoeff(), 1e-3);
  fit::StudyData data{.muscles = files.table.muscles, .trials = {trial}, .rules = {}};
  for (const char* name : {"joint_viscosity", "joint_inertia", "joint_stiffness"})
    data.rules.push_back({.parameter = name, .free = true});
  // The spline errs near its ends, over 5 s: the data are near the model, not on it.
  for (fit::MuscleSetup& muscle : data.muscles) muscle.priors = fit::literature_priors(muscle.start);
  const std::optional<fit::IdentificationResult> exact = fit::identify_exactly(data, {});
  ASSERT_TRUE(exact);
  const fit::IdentificationResult& fit = *exact;
  ASSERT_EQ(fit.values.joints.size(), 1u);
  const auto& joint = fit.values.joints[0];
  // What the spline errs by near its ends, over 5 s.
  EXPECT_NEAR(joint[fit::kViscosity], kViscosity, 1e-3);
  EXPECT_NEAR(joint[fit::kInertia], kInertia, 1e-4);
  EXPECT_NEAR(joint[fit::kStiffness], kStiffness, 1e-2);
}

TEST(IdentifyData, AMotionThatIsNotTheJointsOrNoAngleIsRefused) {
  Written files;
  const fit::TrialData& truth = files.study.data.trials[0];
  const auto motion = [&](const std::vector<Channel>& channels, double value) {
    recording::write_storage(
        files.folder / "q.mot",
        {truth.time_s, channels,
         Eigen::MatrixXd::Constant(truth.time_s.size(), static_cast<Eigen::Index>(channels.size()), value)},
        {.title = "Coordinates"});
    files.sources.motions = {files.path("q.mot")};
    return files.message();
  };
  EXPECT_NE(motion({{"a", Unit::radian}, {"b", Unit::radian}}, 1.0).find("--coordinate"), std::string::npos);
  EXPECT_NE(motion({{"a", Unit::radian}}, 95.0).find("these are degrees"), std::string::npos);
  // The only column is the only joint's angle.
  EXPECT_EQ(motion({{"a", Unit::radian}}, 1.0), "(no error)");
}

TEST(IdentifyData, AFileAtAnotherRateIsNamedWithBothDurations) {
  for (const double factor : {0.5, 2.0}) {
    Written files;
    const fit::TrialData& trial = files.study.data.trials[0];
    const TimeSeries slow(factor * trial.time_s, {{"elbow_moment", Unit::newton_meter}}, trial.torque_nm);
    recording::write_series(files.folder / "id.sto", slow, "torque");
    (void)files.read();
    ASSERT_FALSE(files.remarks.empty()) << factor;
    const std::string& said = files.remarks.front();
    for (const std::string& part : {files.path("id.sto") + ": lasts", fmt::format("{:.4g} s", factor * 5.0),
                                    files.path("l.sto") + " 5 s", fmt::format("{:g} times", factor)})
      EXPECT_NE(said.find(part), std::string::npos) << part << " in: " << said;
    for (const std::string& remark : files.remarks) EXPECT_EQ(remark.find("are used"), std::string::npos) << remark;
  }
}

TEST(IdentifyData, FilesThatDoNotMatchTheTrialsOrTheMusclesAreRefused) {
  Written two;
  two.sources.torques.push_back(two.sources.torques[0]);
  EXPECT_NE(two.message().find("--torques: 2 files for 1 of --lengths"), std::string::npos);
  Written other;
  other.table.muscles[0].name = "SOL";
  EXPECT_NE(other.message().find("no column 'SOL'"), std::string::npos) << other.message();
  Written joint;
  joint.sources.coordinates = {"knee", "elbow"};
  joint.sources.moment_arms.push_back(joint.sources.moment_arms[0]);
  EXPECT_NE(joint.message().find("no column 'knee' or 'knee_moment'"), std::string::npos) << joint.message();
}

TEST(IdentifyData, AFewRowsASecondAreData) {
  Written files;
  const fit::TrialData& truth = files.study.data.trials[0];
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < truth.time_s.size(); i += 25) rows.push_back(i);  // below 5 Hz
  const auto thin = [&](const std::string& name) {
    const TimeSeries whole = recording::read_series(files.path(name)).data;
    recording::write_series(files.folder / name,
                            {whole.time_s()(rows), whole.channels(), whole.values()(rows, Eigen::all)}, name);
  };
  for (const char* name : {"l.sto", "v.sto", "r.sto", "id.sto"}) thin(name);
  const fit::TrialData trial = files.read();
  EXPECT_EQ(trial.length_m, truth.length_m(rows, Eigen::all));
  EXPECT_EQ(trial.torque_nm, truth.torque_nm(rows));
  EXPECT_TRUE(trial.excluded.empty());
}

}  // namespace
}  // namespace myoid::program
