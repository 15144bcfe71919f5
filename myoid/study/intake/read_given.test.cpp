#include "myoid/study/intake/read_given.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/recording/series_file.h"
#include "myoid/study/study_model.h"

#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

/// A trial whose files give every stage of four muscles: lengths swing by 1 cm at 0.5 Hz.
struct GivenTrial {
  test::TemporaryFolder folder;
  Study study;
  TrialSpec spec;

  GivenTrial() {
    std::string text = "[model]\nbuiltin = \"none\"\ncoordinate = \"elbow\"\n[emg]\nkind = \"activation\"\n";
    for (const std::string& name : kMuscles)
      text += "[[muscle]]\nname = \"" + name + "\"\nemg = \"" + name +
              "\"\nstart = { max_isometric_force = 900, optimal_fiber_length = 0.1 }\n";
    text +=
        "[[trial]]\nname = \"t\"\nemg = \"e.sto\"\nlengths = \"l.sto\"\nmoment_arms = \"r.sto\"\ntorques = "
        "\"id.sto\"\n";
    study = parse_study(text, folder / "study.toml");
    spec = study.trials[0];
    const Eigen::VectorXd t = clock(0.0, 4.0);
    const Eigen::VectorXd swing = (kOmega * t).array().sin();
    write("e.sto", t, 0.1 + 0.05 * swing.array(), Unit::dimensionless);
    write("l.sto", t, 0.3 + 0.01 * swing.array(), Unit::meter);
    write("r.sto", t, 0.03 + 0.0 * swing.array(), Unit::meter);
    torque(t);
  }
  static Eigen::VectorXd clock(double begin_s, double end_s) {
    return Eigen::VectorXd::LinSpaced(std::lround(100.0 * (end_s - begin_s)) + 1, begin_s, end_s);
  }
  void write(const std::string& name, const Eigen::VectorXd& t, const Eigen::VectorXd& values, Unit unit) const {
    std::vector<Channel> channels;
    for (const std::string& muscle : kMuscles) channels.push_back({muscle, unit});
    recording::write_series(folder / name, {t, channels, values.replicate(1, std::ssize(kMuscles))}, name);
  }
  void torque(const Eigen::VectorXd& t) const {
    recording::write_series(folder / "id.sto", {t, {{"elbow_moment", Unit::newton_meter}}, 5.0 * t}, "torque");
  }
  [[nodiscard]] std::vector<TrialPart> read() const { return read_trial_parts(study, spec, load_model(study)); }

  static constexpr double kOmega = kPi;  // rad/s
  inline static const std::vector<std::string> kMuscles{"BIC", "BRA", "BRD", "TRI"};
};

TEST(ReadGiven, StagesAreReadAtTheTimesOfTheLengthsAndVelocitiesAreTheirRates) {
  const GivenTrial trial;
  const std::vector<TrialPart> parts = trial.read();
  ASSERT_EQ(parts.size(), 1U);
  const GivenStages& given = parts[0].input.given;
  ASSERT_TRUE(given.lengths && given.velocities && given.torques && !given.forces);
  ASSERT_EQ(given.moment_arms.size(), 1U);
  EXPECT_EQ(given.lengths->sample_count(), 401);
  EXPECT_EQ(given.torques->channels()[0].name, "elbow_moment");
  EXPECT_NEAR(given.torques->values()(300, 0), 15.0, 1e-9);
  // In the middle the quintic spline through a sine with 200 samples a period is exact to 1e-9 of the rate.
  for (Eigen::Index i = 100; i <= 300; ++i)
    EXPECT_NEAR(given.velocities->values()(i, 2), 0.01 * kPi * std::cos(kPi * given.lengths->time_s()[i]), 1e-8);
  // The motion has times alone.
  EXPECT_EQ(parts[0].input.motion->channel_count(), 0);
  EXPECT_EQ(parts[0].input.motion->sample_count(), 401);
}

TEST(ReadGiven, TimesThatAFileLacksAreLeftOutAndNamed) {
  const GivenTrial trial;
  trial.torque(GivenTrial::clock(0.5, 4.0));
  const std::vector<TrialPart> parts = trial.read();
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0].input.given.lengths->time_s()[0], 0.5, 0.005 + 1e-9);
  const Remark& most = parts[0].input.remarks.back();
  EXPECT_EQ(most.severity, Severity::note);
  EXPECT_NE(most.says.find("id.sto"), std::string::npos);
  // It is a warning where less than half is left, and an error where nothing is.
  trial.torque(GivenTrial::clock(2.5, 4.0));
  const std::vector<TrialPart> less = trial.read();
  EXPECT_EQ(less[0].input.remarks.back().severity, Severity::warning);
  trial.torque(GivenTrial::clock(5.0, 8.0));
  EXPECT_NE(message_of([&] { (void)trial.read(); }).find("id.sto"), std::string::npos);
}

TEST(ReadGiven, FasciclesOfAnotherTrialsTimesAreRefused) {
  GivenTrial trial;
  trial.spec.fascicles = trial.folder / "us.sto";
  trial.write("us.sto", GivenTrial::clock(1.0, 3.0), Eigen::VectorXd::Constant(201, 0.1), Unit::meter);
  EXPECT_EQ(trial.read().size(), 1U);
  trial.write("us.sto", GivenTrial::clock(11.0, 13.0), Eigen::VectorXd::Constant(201, 0.1), Unit::meter);
  EXPECT_THROW((void)trial.read(), ReadError);
}

TEST(ReadGiven, AGapOfAFileIsExcludedFromTheTrialWithItsSurroundings) {
  const GivenTrial trial;
  Eigen::VectorXd t = GivenTrial::clock(0.0, 3.0);
  for (double& time : t) time += time > 1.505 ? 1.0 : 0.0;
  for (const std::string file : {"r.sto", "e.sto"}) {
    trial.write(file, t, 0.03 + 0.0 * t.array(), file == "e.sto" ? Unit::dimensionless : Unit::meter);
    const std::vector<TrialPart> parts = trial.read();
    ASSERT_EQ(parts.size(), 1U) << "no part of a trial that is cut";
    const std::vector<Stretch>& windows = parts[0].spec.exclude.windows;
    ASSERT_EQ(windows.size(), file == "r.sto" ? 1U : 2U);
    for (const Stretch& window : windows) EXPECT_NEAR(window.begin_s, 1.5 - 0.1, 1e-9);
    // Torque lags behind EMG; of the other files the splines' ends reach 0.1 s.
    EXPECT_NEAR(windows.back().end_s, 2.51 + (file == "e.sto" ? 0.3 : 0.1), 1e-9);
  }
}

TEST(ReadGiven, AColumnThatLacksAndAnotherUnitAreRefusedWithTheFile) {
  const GivenTrial trial;
  const Eigen::VectorXd t = GivenTrial::clock(0.0, 4.0);
  recording::write_series(trial.folder / "l.sto", {t, {{"BIC", Unit::meter}}, 0.3 + 0.01 * t.array()}, "l");
  const std::string lacks = message_of([&] { (void)trial.read(); });
  EXPECT_NE(lacks.find("l.sto"), std::string::npos) << lacks;
  EXPECT_NE(lacks.find("BRA"), std::string::npos) << lacks;
  const GivenTrial volts;
  TrialSpec spec = volts.spec;
  spec.given.moment_arms = {volts.folder / "r.csv"};
  recording::write_series(volts.folder / "r.csv",
                          {t,
                           {{"BIC", Unit::volt}, {"BRA", Unit::volt}, {"BRD", Unit::volt}, {"TRI", Unit::volt}},
                           Eigen::MatrixXd::Constant(t.size(), 4, 0.03)},
                          "r");
  const std::string unit = message_of([&] { (void)read_trial_parts(volts.study, spec, load_model(volts.study)); });
  EXPECT_NE(unit.find("r.csv"), std::string::npos) << unit;
  spec.given.moment_arms = {volts.folder / "absent.sto"};
  EXPECT_NE(message_of([&] { (void)read_trial_parts(volts.study, spec, load_model(volts.study)); }).find("moment_arms"),
            std::string::npos);
}

}  // namespace
}  // namespace myoid::study
