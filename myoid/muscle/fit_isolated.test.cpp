#include "myoid/muscle/fit_isolated.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/small_muscle.h"

namespace myoid::muscle {
namespace {

std::vector<IsolatedRecording> recordings_of(const IsolatedModel& truth) {
  return test::swings(truth, {0.0008, 0.0016, 0.003});
}

TEST(FitIsolatedMuscle, FindsTheMuscleThatMadeTheForcesBehindItsElasticTendon) {
  IsolatedModel truth = test::small_muscle();
  truth.parameters.hill.max_isometric_force_n = 2.4;
  truth.parameters.hill.max_shortening_speed_mps = 0.09;
  truth.parameters.tendon_strain = 0.06;
  const IsolatedFit fit =
      fit_isolated_muscle(test::small_muscle(), recordings_of(truth),
                          {.parameters = {"max_isometric_force", "max_shortening_speed", "tendon_strain"}});
  ASSERT_EQ(fit.termination, math::Termination::converged) << fit.message;
  // The integrations' tolerance of 1e-7 of the force, of which slopes are of order one.
  EXPECT_NEAR(fit.estimates[0].value / 2.4, 1.0, 1e-4);
  EXPECT_NEAR(fit.estimates[1].value / 0.09, 1.0, 1e-4);
  EXPECT_NEAR(fit.estimates[2].value / 0.06, 1.0, 1e-4);
  EXPECT_EQ(fit.model.parameters.hill.max_isometric_force_n, fit.estimates[0].value);
  EXPECT_FALSE(fit.estimates[0].at_bound);
}

TEST(FitIsolatedMuscle, MovesThePlateauOfMillardsCurveWithTheParameter) {
  IsolatedModel truth = test::small_muscle();
  truth.millard.velocity.max_eccentric_multiplier = 1.6;
  const IsolatedFit fit =
      fit_isolated_muscle(test::small_muscle(), recordings_of(truth), {.parameters = {"eccentric_plateau"}});
  EXPECT_NEAR(fit.estimates[0].value, 1.6, 1e-3);
  EXPECT_EQ(fit.model.millard.velocity.max_eccentric_multiplier, fit.estimates[0].value);
}

TEST(FitIsolatedMuscle, MovesThePassiveStrainOfMillardsCurveWithTheParameter) {
  IsolatedModel truth = test::small_muscle();
  truth.millard.passive.strain_at_one = 0.55;
  truth.millard.passive.stiffness_at_one = 2.0 / 0.55;
  std::vector<IsolatedRecording> recordings = recordings_of(truth);
  for (IsolatedRecording& r : recordings) {
    r.input.length_m.array() += 0.006;  // on the passive limb
    r.force_n = isolated_force(truth, r);
  }
  const IsolatedFit fit = fit_isolated_muscle(test::small_muscle(), recordings, {.parameters = {"passive_strain"}});
  EXPECT_EQ(fit.estimates[0].start, 0.7);
  EXPECT_NEAR(fit.estimates[0].value, 0.55, 1e-3);
  EXPECT_TRUE(fit.estimates[0].told);
}

TEST(FitIsolatedMuscle, AParameterWithoutAnEffectHasNoStandardError) {
  // The exponent of the passive law is unused by Millard's curves: the derivative is 0, the standard error infinite.
  IsolatedModel truth = test::small_muscle();
  truth.parameters.hill.max_isometric_force_n = 2.4;
  const IsolatedFit fit = fit_isolated_muscle(test::small_muscle(), recordings_of(truth),
                                              {.parameters = {"max_isometric_force", "passive_shape"}});
  EXPECT_NEAR(fit.estimates[0].value / 2.4, 1.0, 1e-4);
  EXPECT_TRUE(fit.estimates[0].told);
  EXPECT_FALSE(fit.estimates[1].told);
  EXPECT_TRUE(std::isinf(fit.estimates[1].std_error));
}

TEST(FitIsolatedMuscle, FromASlackMuscleASearchElsewhereFindsTheMuscle) {
  // A tendon 6 mm longer than whole unit and fiber: slack at every length, no force, no derivative.
  const IsolatedModel truth = test::small_muscle();
  IsolatedModel slack = truth;
  slack.parameters.hill.tendon_slack_length_m = 0.046;
  const IsolatedFitOptions alone{.parameters = {"tendon_slack_length"}, .other_starts = 0};
  const IsolatedFit stuck = fit_isolated_muscle(slack, recordings_of(truth), alone);
  EXPECT_FALSE(stuck.moved);
  EXPECT_FALSE(stuck.estimates[0].told);
  const IsolatedFit fit = fit_isolated_muscle(slack, recordings_of(truth), {.parameters = {"tendon_slack_length"}});
  EXPECT_TRUE(fit.moved);
  EXPECT_TRUE(fit.from_elsewhere);
  EXPECT_NEAR(fit.estimates[0].value, 0.02, 2e-5);
}

TEST(FitIsolatedMuscle, FindsTheTimesOfTheActivation) {
  IsolatedModel truth = test::small_muscle();
  truth.response.activation.activation_time_s = 0.02;
  truth.response.delay_s = 0.012;
  IsolatedModel start = test::small_muscle();
  start.response.delay_s = 0.006;
  const IsolatedFit fit =
      fit_isolated_muscle(start, recordings_of(truth), {.parameters = {"activation_time", "excitation_delay"}});
  // One-sided differences of forces every 17 ms: the minimum is flat within some 1e-3.
  EXPECT_NEAR(fit.estimates[0].value / 0.02, 1.0, 2e-3);
  EXPECT_NEAR(fit.estimates[1].value / 0.012, 1.0, 2e-3);
  EXPECT_EQ(fit.model.response.delay_s, fit.estimates[1].value);
}

TEST(FitIsolatedMuscle, EachRecordingsOwnTendonDoesNotSpoilTheOtherNumbers) {
  IsolatedModel truth = test::small_muscle();
  truth.parameters.hill.max_isometric_force_n = 2.4;
  std::vector<IsolatedRecording> recordings;
  double softer = 0.8;
  for (IsolatedRecording& r : recordings_of(truth)) {
    truth.parameters.tendon_strain = 0.049 * softer;
    softer += 0.3;
    r.force_n = isolated_force(truth, r);
    recordings.push_back(r);
  }
  const std::vector<std::string> names{"max_isometric_force", "max_shortening_speed", "tendon_strain"};
  const IsolatedFit common = fit_isolated_muscle(test::small_muscle(), recordings, {.parameters = names});
  const IsolatedFit own =
      fit_isolated_muscle(test::small_muscle(), recordings, {.parameters = names, .own = {"tendon_strain"}});
  EXPECT_GT(std::abs(common.estimates[1].value / 0.12 - 1.0), 0.01);
  EXPECT_NEAR(own.estimates[1].value / 0.12, 1.0, 1e-3);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(own.of_recordings[i].parameters.tendon_strain, 0.049 * (0.8 + 0.3 * static_cast<double>(i)), 1e-4);
  EXPECT_GT(own.estimates[2].scatter, 0.1);
  EXPECT_EQ(own.estimates[0].scatter, 0.0);
}

TEST(FitIsolatedMuscle, AFitWithoutOneRecordingFindsTheSameMuscleFromExactForces) {
  IsolatedModel truth = test::small_muscle();
  truth.parameters.hill.max_isometric_force_n = 2.4;
  const std::vector<IsolatedRecording> recordings = recordings_of(truth);
  const IsolatedFitOptions options{.parameters = {"max_isometric_force", "tendon_strain"}};
  const IsolatedFit all = fit_isolated_muscle(test::small_muscle(), recordings, options);
  const std::vector<IsolatedFit> without = fit_without_each(test::small_muscle(), recordings, options, all);
  ASSERT_EQ(without.size(), 3U);
  for (const IsolatedFit& fit : without) {
    EXPECT_NEAR(fit.estimates[0].value / 2.4, 1.0, 1e-4);
    EXPECT_EQ(fit.of_recordings.size(), 2U);
  }
  EXPECT_TRUE(fit_without_each(test::small_muscle(), {recordings[0]}, options, all).empty());
}

TEST(FitIsolatedMuscle, AFitWithoutARecordingIsThatOfTheOthersAlone) {
  // Recordings that contradict each other, the last one by so much that its absence leads far away.
  std::vector<IsolatedRecording> recordings = recordings_of(test::small_muscle());
  recordings[1].force_n *= 1.02;
  recordings[2].force_n *= 1.5;
  const IsolatedFitOptions options{.parameters = {"max_isometric_force", "tendon_strain"}};
  const IsolatedFit all = fit_isolated_muscle(test::small_muscle(), recordings, options);
  const std::vector<IsolatedFit> without = fit_without_each(test::small_muscle(), recordings, options, all);
  ASSERT_EQ(without.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<IsolatedRecording> others = recordings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const IsolatedFit alone = fit_isolated_muscle(test::small_muscle(), others, options);
    for (std::size_t p = 0; p < 2; ++p)
      EXPECT_NEAR(without[i].estimates[p].value / alone.estimates[p].value, 1.0, 0.01) << i << " " << p;
  }
}

TEST(FitIsolatedMuscle, TheWidthOfTheForceLengthCurveFollowsTheOptimalLength) {
  IsolatedModel start = test::small_muscle();
  start.laws.length = LengthLaw::gaussian;
  IsolatedModel truth = start;
  truth.parameters.hill.optimal_fiber_length_m *= 1.1;
  truth.parameters.hill.force_length_width_m *= 1.1;
  const IsolatedFit fit = fit_isolated_muscle(start, recordings_of(truth), {.parameters = {"optimal_fiber_length"}});
  EXPECT_NEAR(fit.estimates[0].value / 0.022, 1.0, 1e-4);
  EXPECT_NEAR(fit.model.parameters.hill.force_length_width_m, 0.45 * fit.estimates[0].value, 1e-12);
}

/// A fit that found these values, each with this standard error from its residuals.
IsolatedFit fit_of(const std::vector<double>& values, double std_error) {
  IsolatedFit fit;
  for (const double value : values) fit.estimates.push_back({.parameter = "x", .value = value, .std_error = std_error});
  return fit;
}

TEST(FitIsolatedMuscle, WidensAStandardErrorToTheJackknifes) {
  IsolatedFit all = fit_of({10.0, 1.0}, 0.4);
  // Without one of the four: 11, 9, 10.4, 9.6. Their mean is 10, the sum of squares 2.32.
  const std::vector<IsolatedFit> without{fit_of({11.0, 1.1}, 0.5), fit_of({9.0, 0.9}, 0.5), fit_of({10.4, 1.0}, 0.5),
                                         fit_of({9.6, 1.0}, 0.5)};
  const std::vector<DecidedByOne> decided = widen_to_jackknife(all, without);
  EXPECT_NEAR(all.estimates[0].std_error, std::sqrt(0.75 * 2.32), 1e-12);
  EXPECT_EQ(all.estimates[1].std_error, 0.4);  // sqrt(0.75 * 0.02) is less
  ASSERT_EQ(decided.size(), 1U);
  EXPECT_EQ(decided[0].parameter, 0U);
  EXPECT_EQ(decided[0].recording, 0U);
  EXPECT_EQ(decided[0].without, 11.0);
  EXPECT_NEAR(decided[0].std_errors, 2.5, 1e-12);
  // One fit without a recording says nothing of their spread.
  IsolatedFit lonely = fit_of({10.0}, 0.4);
  EXPECT_TRUE(widen_to_jackknife(lonely, {fit_of({20.0}, 0.5)}).empty());
  EXPECT_EQ(lonely.estimates[0].std_error, 0.4);
}

TEST(FitIsolatedMuscle, RefusesWhatIsNoParameterOrCannotBeScaled) {
  const auto recordings = recordings_of(test::small_muscle());
  const IsolatedModel start = test::small_muscle();
  EXPECT_THROW((void)fit_isolated_muscle(start, recordings, {.parameters = {"strength"}}), InvalidInput);
  EXPECT_THROW((void)fit_isolated_muscle(start, recordings, {.parameters = {"pennation_at_optimal"}}), InvalidInput);
  EXPECT_THROW((void)fit_isolated_muscle(start, recordings, {.parameters = {}}), InvalidInput);
  EXPECT_THROW((void)fit_isolated_muscle(start, recordings, {.parameters = {"tendon_strain", "tendon_strain"}}),
               InvalidInput);
}

}  // namespace
}  // namespace myoid::muscle
