#include "myoid/results/study_figures.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::results {
namespace {

/// One muscle of the study, moved from 0.10 to 0.16 m beyond its tendon of 0.2 m.
run::StudyResult one_muscle() {
  run::StudyResult result;
  fit::MuscleSetup setup;
  setup.name = "BIC";
  setup.start.optimal_fiber_length_m = 0.12;
  setup.start.force_length_width_m = 0.05;
  setup.start.tendon_slack_length_m = 0.2;
  setup.start.max_shortening_speed_mps = 1.2;
  result.fit_input.data.muscles = {setup};
  fit::TrialData trial;
  trial.name = "slow";
  trial.time_s = Eigen::VectorXd::LinSpaced(3, 0.0, 1.0);
  trial.length_m = Eigen::Vector3d(0.30, 0.33, 0.36);
  trial.velocity_mps = Eigen::Vector3d(0.1, 0.4, -0.2);
  trial.force_n = Eigen::Vector3d(10.0, 20.0, 30.0);
  result.fit_input.data.trials = {trial};
  return result;
}

fit::IdentificationResult found(const run::StudyResult& result) {
  fit::IdentificationResult method;
  method.method = fit::Method::torque;
  method.muscles = {result.fit_input.data.muscles[0].start};
  method.muscles[0].optimal_fiber_length_m = 0.14;
  fit::TrialFit fit;
  fit.trial = "slow";
  fit.force_fit_n = Eigen::Vector3d(13.0, 20.0, 26.0);
  fit.literature_force_n = Eigen::Vector3d(1.0, 2.0, 3.0);
  method.trials = {fit};
  return method;
}

const page::Series& series(const page::Panel& panel, const std::string& name) {
  for (const page::Series& s : panel.series) {
    if (s.name == name) return s;
  }
  throw std::runtime_error(name);
}

TEST(MuscleCurves, AreTheGaussiansOfEquationThreeOverTheFiberLength) {
  const run::StudyResult result = one_muscle();
  const page::Figure figure = muscle_curves(result, found(result), 0);
  ASSERT_EQ(figure.panels.size(), 2U);
  for (const auto& [name, optimum] : {std::pair{"literature", 0.12}, {"identified", 0.14}}) {
    const page::Series& s = series(figure.panels[0], name);
    for (std::size_t i = 0; i < s.x.size(); ++i)
      ASSERT_NEAR(s.y[i], std::exp(-std::pow((s.x[i] - optimum) / 0.05, 2)), 1e-12) << name;
  }
}

TEST(MuscleCurves, ShadeWhatTheRecordingVisited) {
  const run::StudyResult result = one_muscle();
  const page::Figure figure = muscle_curves(result, found(result), 0);
  const page::Series& lengths = series(figure.panels[0], "visited");
  EXPECT_NEAR(lengths.x.front(), 0.10, 1e-12);
  EXPECT_NEAR(lengths.x.back(), 0.16, 1e-12);
  EXPECT_NEAR(series(figure.panels[1], "visited").x.back(), 0.4, 1e-12);
}

TEST(ForceFigure, TellsTheDifferenceFromTheSharedForces) {
  const run::StudyResult result = one_muscle();
  const auto method = found(result);
  const page::Figure figure = force_figure(result, result.fit_input.data.trials[0], method);
  ASSERT_EQ(figure.panels.size(), 1U);
  // rms of 3, 0, -4 N
  EXPECT_EQ(figure.panels[0].title, "BIC: identified against shared 3 N rms");
}

}  // namespace
}  // namespace myoid::results
