#include "myoid/fit/posterior/voluntary_torque.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/fit/posterior/posterior.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/force_length.h"

#include "tests/support/elbow_study.h"
#include "tests/support/exact_sensors.h"
#include "tests/support/leg_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;
using testing::HasSubstr;
using testing::Not;

constexpr double kArm_m = 0.04, kForce_n = 800.0, kLength_m = 0.12, kSlack_m = 0.2, kOptimum_rad = 1.2;

/// One muscle with a constant moment arm, which is at its optimal length at kOptimum_rad, recorded from `low` to
/// `high`.
StudyData one_muscle(double low_rad, double high_rad) {
  MuscleSetup setup;
  setup.name = setup.emg_channel = "BIC";
  setup.start = {.max_isometric_force_n = kForce_n,
                 .optimal_fiber_length_m = kLength_m,
                 .force_length_width_m = 0.5 * kLength_m,
                 .concentric_curvature = 0.25,
                 .eccentric_curvature_product = 0.1,
                 .eccentric_plateau = 1.4,
                 .max_shortening_speed_mps = 1.2,
                 .tendon_slack_length_m = kSlack_m};
  setup.fixed = {"tendon_slack_length"};
  for (const char* name : {"max_isometric_force", "optimal_fiber_length"})
    setup.priors[name] = *literature_prior(name, setup.start.*muscle::hill_field(name).member, kLength_m);
  TrialData trial;
  trial.name = "trial";
  trial.joint = "elbow";
  constexpr Eigen::Index kSamples = 2001;
  trial.time_s = Eigen::VectorXd::LinSpaced(kSamples, 0.0, 20.0);
  const Eigen::ArrayXd t = trial.time_s.array();
  const double middle = 0.5 * (low_rad + high_rad), half = 0.5 * (high_rad - low_rad);
  trial.angle_rad = middle + half * (1.7 * t).sin();
  trial.velocity_radps = half * 1.7 * (1.7 * t).cos();
  trial.acceleration_radps2 = -half * 1.7 * 1.7 * (1.7 * t).sin();
  trial.length_m = kSlack_m + kLength_m - kArm_m * (trial.angle_rad.array() - kOptimum_rad);
  trial.velocity_mps = -kArm_m * trial.velocity_radps;
  trial.moment_arm_m = Eigen::MatrixXd::Constant(kSamples, 1, kArm_m);
  const Eigen::VectorXd effort = 0.4 + 0.25 * (0.9 * t).sin() + 0.1 * (2.3 * t).sin();
  trial.activation = TimeSeries(trial.time_s, {{"BIC", Unit::dimensionless}}, effort);
  trial.torque_nm.resize(kSamples);
  for (Eigen::Index i = 0; i < kSamples; ++i)
    trial.torque_nm[i] =
        kArm_m * muscle::hill_force(effort[i], trial.length_m(i, 0) - kSlack_m, trial.velocity_mps(i, 0), setup.start);
  return {.muscles = {setup}, .trials = {trial}, .rules = {}};
}

/// The options under which everything but the muscle is exact.
EstimatorOptions exact_sensors() {
  EstimatorOptions options;
  options.delay_s = 0.0;
  options.unseen = test::no_unseen_errors();
  options.state("BIC").bandwidth_hz = 1e5;
  return options;
}

VoluntaryTorques at_the_truth(const StudyData& data, const EstimatorOptions& options) {
  const Likelihood likelihood(data, options);
  const Eigen::VectorXd z = likelihood.parameters().start();
  NoiseValues noise = NoiseValues::Zero(kNoiseFieldCount + likelihood.trial_count());
  noise[kTorqueSd] = std::log(0.1);
  noise[kTorqueTime] = std::log(0.3);
  noise[kModelErrorSize] = std::log(1e-4);
  const LinearReading reading{likelihood, z, noise, noise, 1e-8 * Eigen::MatrixXd::Identity(z.size(), z.size())};
  return voluntary_torques(data, options, reading, reading, {});
}

const ParameterEstimate& find(const std::vector<ParameterEstimate>& estimates,
                              const std::string& owner,
                              const std::string& parameter) {
  for (const ParameterEstimate& e : estimates)
    if (e.muscle == owner && e.parameter == parameter) return e;
  throw InvalidInput("no estimate " + owner + "." + parameter);
}

TEST(VoluntaryTorque, OfAConstantMomentArmIsTheForceLengthCurve) {
  const StudyData data = one_muscle(0.3, 2.0);
  const VoluntaryTorques found = at_the_truth(data, exact_sensors());
  ASSERT_EQ(found.curves.size(), 2U);  // the muscle's and the joint's
  const VoluntaryCurve& curve = found.curves[0];
  ASSERT_GT(curve.angle_rad.size(), 20);
  for (Eigen::Index i = 0; i < curve.angle_rad.size(); ++i) {
    const double length_m = kLength_m - kArm_m * (curve.angle_rad[i] - kOptimum_rad);
    const double force_n = muscle::hill_force(1.0, length_m, 0.0, data.muscles[0].start);
    EXPECT_NEAR(curve.torque_nm[i], kArm_m * force_n, 0.005 * kArm_m * kForce_n) << curve.angle_rad[i];
    EXPECT_LE(curve.low_nm[i], curve.torque_nm[i]);
    EXPECT_GE(curve.high_nm[i], curve.torque_nm[i]);
  }
  const ParameterEstimate& torque = find(found.estimates, "BIC", "voluntary_torque");
  EXPECT_NEAR(torque.estimate, kArm_m * kForce_n, 0.005 * kArm_m * kForce_n);
  EXPECT_NEAR(torque.initial, kArm_m * kForce_n, 0.005 * kArm_m * kForce_n);
  EXPECT_EQ(torque.verdict, Verdict::identified) << torque.reason;
  const ParameterEstimate& angle = find(found.estimates, "BIC", "voluntary_torque_angle");
  EXPECT_NEAR(angle.estimate, kOptimum_rad, 1.0 * kDegree);
  EXPECT_EQ(angle.verdict, Verdict::identified) << angle.reason;
  // The joint has one muscle.
  EXPECT_DOUBLE_EQ(find(found.estimates, "elbow", "voluntary_torque_positive").estimate, torque.estimate);
  // 60 deg/s are recorded, 120 are not.
  const double speed = 60.0 * kDegree;
  EXPECT_NEAR(find(found.estimates, "BIC", "voluntary_power_60").estimate,
              speed * kArm_m * muscle::hill_force(1.0, kLength_m, -kArm_m * speed, data.muscles[0].start),
              0.01 * speed * kArm_m * kForce_n);
  EXPECT_THROW((void)find(found.estimates, "BIC", "voluntary_power_120"), InvalidInput);
}

TEST(VoluntaryTorque, AnOptimumAtTheEndOfTheRangeMayLieBeyond) {
  const VoluntaryTorques found = at_the_truth(one_muscle(0.2, 0.9), exact_sensors());
  const ParameterEstimate& angle = find(found.estimates, "BIC", "voluntary_torque_angle");
  EXPECT_NEAR(angle.estimate, 0.9, 4.0 * kDegree);
  EXPECT_EQ(angle.verdict, Verdict::weak);
  EXPECT_THAT(angle.reason, HasSubstr("or beyond"));
  EXPECT_THAT(find(found.estimates, "BIC", "voluntary_torque").reason, HasSubstr("greatest of the recorded range"));
}

TEST(VoluntaryTorque, WithoutAMaximalContractionItIsThatOfTheLargestEmg) {
  const StudyData data = one_muscle(0.3, 2.0);
  EstimatorOptions options = exact_sensors();
  options.from_mvc = false;
  const ParameterEstimate torque = find(at_the_truth(data, options).estimates, "BIC", "voluntary_torque");
  const double largest = data.trials[0].activation.column("BIC").maxCoeff();
  EXPECT_NEAR(torque.estimate, largest * kArm_m * kForce_n, 0.02 * kArm_m * kForce_n);
  EXPECT_THAT(torque.reason, HasSubstr("no maximal contraction was recorded"));
  options.from_mvc = true;
  EXPECT_THAT(find(at_the_truth(data, options).estimates, "BIC", "voluntary_torque").reason,
              Not(HasSubstr("no maximal contraction")));
}

TEST(VoluntaryTorque, WithoutAnglesIsOverTheMusclesLength) {
  StudyData data = one_muscle(0.3, 2.0);
  for (Eigen::VectorXd* of : {&data.trials[0].angle_rad, &data.trials[0].velocity_radps}) of->resize(0);
  data.trials[0].acceleration_radps2.resize(0);
  const VoluntaryTorques found = at_the_truth(data, exact_sensors());
  ASSERT_EQ(found.curves.size(), 1U);
  EXPECT_EQ(found.curves[0].angle_rad.size(), 0);
  EXPECT_GT(found.curves[0].length_m.size(), 20);
  ASSERT_EQ(found.estimates.size(), 1U);
  EXPECT_NEAR(found.estimates[0].estimate, kArm_m * kForce_n, 0.005 * kArm_m * kForce_n);
}

TEST(VoluntaryTorque, TheScaleOfTheTorqueStaysOnlyOfThePerson) {
  const StudyData data = one_muscle(0.3, 2.0);
  EstimatorOptions options = exact_sensors();
  options.unseen.torque_scale = 0.03;
  options.unseen.effort = 0.15;
  const ParameterEstimate torque = find(at_the_truth(data, options).estimates, "BIC", "voluntary_torque");
  // Data tell the product of scale and effort, so that the torque is known as well as the scale.
  EXPECT_LT(*torque.ci_high / torque.estimate - 1.0, 1.3 * 1.96 * 0.03);
  EXPECT_GT(*torque.ci_high / torque.estimate - 1.0, 0.7 * 1.96 * 0.03);
}

/// The greatest torque of a muscle of the study over the recorded angles [N m].
double true_greatest_nm(const ElbowStudy& study, std::size_t k, double arm_scale) {
  const body::PlanarElbow elbow = body::planar_elbow();
  double greatest = 0.0;
  for (const TrialData& trial : study.data.trials) {
    for (const double q : trial.angle_rad) {
      const body::MuscleTravel own = test::scaled_travel(elbow.muscles[k], q, arm_scale);
      greatest = std::max(greatest, std::abs(own.moment_arm_m) *
                                        muscle::hill_force(1.0, own.length_m - study.truth[k].tendon_slack_length_m,
                                                           0.0, study.truth[k]));
    }
  }
  return greatest;
}

// The person's moment arms are 15 % larger than the study's. The muscles' strength given the study's arms is wrong by
// as much, and the torque is not.
TEST(VoluntaryTorque, HoldsThePersonWhereMomentArmsAreWrong) {
  constexpr double kScale = 1.15;
  test::ElbowStudyOptions made = test::noisy_person(3);
  made.emg_cv = 0.03;
  made.torque_sd_nm = 0.2;
  made.with_motion = true;
  made.true_arm_scale = kScale;
  ElbowStudy study = elbow_study(made);
  for (MuscleSetup& muscle : study.data.muscles) muscle.fixed = {"tendon_slack_length"};
  const IdentificationResult result = identify_by_posterior(study.data, {});
  ASSERT_EQ(result.termination, math::Termination::converged) << result.message;
  int held = 0, given_held = 0, narrower = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string& name = study.data.muscles[k].name;
    const ParameterEstimate& torque = find(result.estimates, name, "voluntary_torque");
    const ParameterEstimate& force = find(result.estimates, name, "max_isometric_force");
    const double truth_nm = true_greatest_nm(study, k, kScale), truth_n = study.truth[k].max_isometric_force_n;
    held += *torque.ci_low <= truth_nm && truth_nm <= *torque.ci_high;
    given_held += *force.given_ci_low <= truth_n && truth_n <= *force.given_ci_high;
    narrower += *torque.ci_high / *torque.ci_low < *force.ci_high / *force.ci_low;
    EXPECT_NEAR(torque.estimate, truth_nm, 0.12 * truth_nm)
        << name << ": " << truth_nm << " " << *torque.ci_low << " " << *torque.ci_high << ", " << truth_n << " "
        << *force.given_ci_low << " " << *force.given_ci_high << ", " << *force.ci_low << " " << *force.ci_high;
  }
  EXPECT_EQ(held, 4);
  EXPECT_EQ(given_held, 0);
  EXPECT_EQ(narrower, 4);
  EXPECT_EQ(&find(result.estimates, study.data.muscles[0].name, "voluntary_torque"), &result.estimates.front());
}

TEST(VoluntaryTorque, AMuscleOfTwoJointsHasOneAtEach) {
  const ElbowStudy study = test::leg_study({.seconds = 12.0, .torque_sd_nm = 0.2});
  EstimatorOptions options;
  options.unseen = exact_sensors().unseen;
  for (const MuscleSetup& muscle : study.data.muscles) options.state(muscle.emg_channel).bandwidth_hz = 5000.0;
  const IdentificationResult result = identify_by_posterior(study.data, options);
  const auto count = [&](const std::string& owner) {
    return std::count_if(result.voluntary.begin(), result.voluntary.end(),
                         [&](const VoluntaryCurve& curve) { return curve.owner == owner; });
  };
  EXPECT_EQ(count("GAS"), 2);
  EXPECT_EQ(count("SOL"), 1);
}

}  // namespace
}  // namespace myoid::fit
