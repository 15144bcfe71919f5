#include "myoid/fit/intervals/signatures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "myoid/fit/methods/paper.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::fit {
namespace {

/// One flexor at 1 Hz, as science's table of single errors has it: what it is taken to be is true.
struct OneMuscle {
  muscle::HillParameters<double> truth;
  StudyData data;
};

/// Activations that make `force_n` at every time, told to the fit `lead_s` too early.
OneMuscle one_hertz(double lead_s) {
  OneMuscle study;
  muscle::HillParameters<double>& p = study.truth;
  p.max_isometric_force_n = 900.0;
  p.optimal_fiber_length_m = 0.122;
  p.force_length_width_m = 0.055;
  p.concentric_curvature = 0.3;
  p.eccentric_curvature_product = 0.12;
  p.eccentric_plateau = 1.4;
  p.max_shortening_speed_mps = 1.22;
  p.tendon_slack_length_m = 0.0;
  MuscleSetup setup;
  setup.name = setup.emg_channel = "M";
  setup.start = p;
  setup.start.concentric_curvature = 0.28;
  setup.start.eccentric_curvature_product = 0.1;
  setup.start.eccentric_plateau = 1.35;
  study.data.muscles.push_back(setup);
  constexpr Eigen::Index kSamples = 2000;
  const double w = 2.0 * kPi;
  TrialData trial;
  trial.name = "1 Hz";
  trial.time_s = Eigen::VectorXd::LinSpaced(kSamples, 0.0, 10.0);
  const auto at = [&](const auto& f) {
    return Eigen::VectorXd(trial.time_s.unaryExpr([&](double t) { return f(t); }));
  };
  const auto force = [&](double t) { return std::max(40.0 * std::sin(w * t) + 5.0, 3.0); };
  const auto length = [&](double t) { return 0.122 + 0.025 * std::sin(w * t); };
  const auto speed = [&](double t) { return 0.025 * w * std::cos(w * t); };
  const auto activation = [&](double t) { return force(t) / muscle::hill_force(1.0, length(t), speed(t), p); };
  trial.length_m = at(length);
  trial.velocity_mps = at(speed);
  trial.moment_arm_m = Eigen::MatrixXd::Ones(kSamples, 1);
  trial.force_n = at(force);
  trial.torque_nm = trial.force_n.col(0);
  trial.activation = TimeSeries(trial.time_s, {{"M", Unit::dimensionless}},
                                Eigen::MatrixXd(at([&](double t) { return activation(t + lead_s); })));
  study.data.trials.push_back(std::move(trial));
  return study;
}

bool named(const IdentificationResult& result, RemarkCode signature) {
  return std::ranges::find(result.diagnoses, signature, &Remark::code) != result.diagnoses.end();
}

TEST(Signatures, ADelayIsNamedThoughTheFullStepsFindNoMinimum) {
  const IdentificationResult fit = identify_paper(one_hertz(0.03).data);
  EXPECT_NE(fit.termination, math::Termination::converged);
  EXPECT_TRUE(named(fit, RemarkCode::emg_delay_ignored));
  EXPECT_EQ(fit.diagnoses.size(), 1U);
}

TEST(Signatures, CoContractionSetToZeroIsNamed) {
  StudyData data = one_hertz(0.0).data;
  for (TrialData& trial : data.trials) trial.force_n = (trial.force_n.array() - 12.0).max(0.0);
  const IdentificationResult fit = identify_paper(data);
  EXPECT_TRUE(named(fit, RemarkCode::co_contraction_zeroed));
  EXPECT_FALSE(named(fit, RemarkCode::emg_delay_ignored));
}

TEST(Signatures, AStrengthFourTimesTooHighIsNamed) {
  StudyData data = one_hertz(0.0).data;
  data.muscles[0].start.max_isometric_force_n *= 4.0;
  data.muscles[0].fixed = {"optimal_fiber_length", "force_length_width"};
  const IdentificationResult fit = identify_paper(data);
  EXPECT_TRUE(named(fit, RemarkCode::gain_mismatch));
  EXPECT_EQ(fit.diagnoses.size(), 1U);
}

TEST(Signatures, OfDataWithoutAnErrorNoneIsNamedWhereverTheSearchEnds) {
  int lost = 0;
  for (int s = 0; s < 8; ++s) {
    OneMuscle study = one_hertz(0.0);
    muscle::HillParameters<double>& start = study.data.muscles[0].start;
    start.optimal_fiber_length_m *= (s & 1) != 0 ? 1.15 : 0.87;
    start.force_length_width_m *= (s & 2) != 0 ? 1.15 : 0.87;
    start.eccentric_plateau = (s & 4) != 0 ? 1.6 : 1.25;
    const IdentificationResult fit = identify_paper(study.data);
    for (const PublishedSearch& search : fit.published) lost += search.plain == math::Termination::converged ? 0 : 1;
    EXPECT_TRUE(fit.diagnoses.empty()) << s << ": " << fit.diagnoses.front().says;
  }
  EXPECT_GT(lost, 0);  // else nothing is shown
}

TEST(Signatures, WhatIsMostlyThePriorsIsNoSign) {
  ParameterEstimate straight;
  straight.muscle = "M";
  straight.parameter = "concentric_curvature";
  straight.initial = 0.3;
  straight.estimate = 5.0;
  EXPECT_EQ(signatures({straight}).size(), 1U);
  straight.shrinkage = 0.1;
  EXPECT_TRUE(signatures({straight}).empty());
  straight.shrinkage.reset();
  straight.estimate = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(signatures({straight}).empty());
}

}  // namespace
}  // namespace myoid::fit
