#include "myoid/fit/methods/torque.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/muscle_activation.h"
#include "myoid/fit/measurement/nuisances.h"
#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/core/error.h"

#include "tests/support/elbow_study.h"
#include "tests/support/swing.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;

/// What a study holds on an estimate.
double true_value(const ElbowStudy& study, const ParameterEstimate& e) {
  if (e.parameter == "emg_delay") return study.delay_s;
  if (e.parameter == "emg_gain") return 1.0;
  for (std::size_t k = 0; k < study.data.muscles.size(); ++k) {
    if (study.data.muscles[k].name == e.muscle) return study.truth[k].*muscle::hill_field(e.parameter).member;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

const ParameterEstimate& find(const IdentificationResult& result,
                              const std::string& muscle,
                              const std::string& parameter) {
  for (const ParameterEstimate& e : result.estimates) {
    if (e.muscle == muscle && e.parameter == parameter) return e;
  }
  throw InvalidInput("no estimate " + muscle + "." + parameter);
}

/// The exact fit of data without noise.
IdentificationResult exactly(const StudyData& data, const EstimatorOptions& options = {}) {
  std::optional<IdentificationResult> fit = identify_exactly(data, options);
  if (!fit) throw InvalidInput("no exact fit");
  return std::move(*fit);
}

TEST(IdentifyTorque, FindsTheTruthWithoutNoise) {
  const ElbowStudy study = elbow_study();
  const IdentificationResult result = exactly(study.data);
  EXPECT_EQ(result.termination, math::Termination::converged) << result.message;
  ASSERT_EQ(result.estimates.size(), 25U);
  for (const ParameterEstimate& e : result.estimates) {
    const double truth = true_value(study, e);
    EXPECT_NEAR(e.estimate, truth, 1e-6 * truth) << e.muscle << " " << e.parameter;
    EXPECT_GT(std::abs(e.initial - truth), 0.02 * truth) << "the start was the truth already";
    EXPECT_EQ(e.verdict, Verdict::identified) << e.muscle << " " << e.parameter << ": " << e.reason;
  }
  for (const TrialFit& fit : result.trials) EXPECT_GT(fit.score.r2(), 1.0 - 1e-10);
}

TEST(IdentifyTorque, WhatTheJointMakesByItselfIsNoMusclesForce) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0});
  for (TrialData& trial : study.data.trials) {
    // Stretched tissue pulls out of both ends of the range: 4 N m there.
    const Eigen::VectorXd x = (trial.length_m.col(0).array() - trial.length_m.col(0).mean()) / 0.02;
    trial.resting_nm = x.array().cube();
    trial.torque_nm += trial.resting_nm;
  }
  const IdentificationResult with = exactly(study.data);
  for (const ParameterEstimate& e : with.estimates) {
    const double truth = true_value(study, e);
    EXPECT_NEAR(e.estimate, truth, 1e-6 * truth) << e.muscle << " " << e.parameter;
  }
  for (const TrialFit& fit : with.trials) EXPECT_GT(fit.score.r2(), 1.0 - 1e-10);
  for (TrialData& trial : study.data.trials) trial.resting_nm.resize(0);
  EXPECT_FALSE(identify_exactly(study.data)) << "the torque was too small to matter";
}

TEST(IdentifyTorque, FindsTheTruthWithoutNoiseFromTwentyStarts) {
  // Each number of each muscle begins up to two spreads of people away from the truth, either way.
  const ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0});
  const double spread[] = {0.25, 0.10, 0.25, 0.30, 0.50, 0.10};
  test::StudyNoise random(5);
  for (int start = 0; start < 20; ++start) {
    StudyData data = study.data;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t f = 0; f < 6; ++f) {
        double& value = data.muscles[k].start.*muscle::kHillFields[f].member;
        value =
            study.truth[k].*muscle::kHillFields[f].member * std::exp(2.0 * spread[f] * (2.0 * random.uniform() - 1.0));
        value =
            std::clamp(value, 1.01 * muscle::kHillFields[f].bounds.lower, 0.99 * muscle::kHillFields[f].bounds.upper);
      }
    }
    const IdentificationResult result = exactly(data, {.predictions = false});
    ASSERT_EQ(result.estimates.size(), 25U);
    for (const ParameterEstimate& e : result.estimates) {
      const double truth = true_value(study, e);
      EXPECT_NEAR(e.estimate, truth, 1e-6 * truth) << "start " << start << ": " << e.muscle << " " << e.parameter;
    }
  }
}

TEST(IdentifyTorque, ForceAndDelayComeOutOfNoisyRecordings) {
  const ElbowStudy study =
      elbow_study({.delay_s = 0.08, .emg_cv = 0.1, .torque_sd_nm = 1.0, .with_priors = true, .seed = 3});
  const IdentificationResult result = identify_torque(study.data);
  EXPECT_NEAR(result.delay_s, 0.08, 0.012);
  for (std::size_t k = 0; k < 4; ++k) {
    const double truth = study.truth[k].max_isometric_force_n;
    EXPECT_NEAR(result.muscles[k].max_isometric_force_n, truth, 0.2 * truth) << study.data.muscles[k].name;
    EXPECT_NEAR(result.muscles[k].optimal_fiber_length_m, study.truth[k].optimal_fiber_length_m,
                0.1 * study.truth[k].optimal_fiber_length_m);
  }
}

TEST(IdentifyTorque, NoMuscleIsIdentifiedWhereTheMotionAloneTellsTheTorque) {
  ElbowStudy study = elbow_study({.emg_cv = 0.05, .torque_sd_nm = 0.2, .with_priors = true});
  const auto identified = [&](const IdentificationResult& result) {
    return std::count_if(result.estimates.begin(), result.estimates.end(),
                         [](const auto& e) { return e.parameter != "emg_delay" && e.verdict == Verdict::identified; });
  };
  EXPECT_GT(identified(identify_torque(study.data, {})), 0);
  for (TrialData& trial : study.data.trials) {
    trial.angle_rad = 0.05 * trial.torque_nm;  // a spring
    trial.velocity_radps.setZero(trial.torque_nm.size());
    trial.acceleration_radps2.setZero(trial.torque_nm.size());
  }
  const IdentificationResult result = identify_torque(study.data, {});
  EXPECT_EQ(identified(result), 0);
  EXPECT_NE(result.warnings.back().says.find("100.0 % of the torque"), std::string::npos);
}

TEST(IdentifyTorque, TwiceTheSameInputIsTwiceTheSameResult) {
  const ElbowStudy study =
      elbow_study({.trials = 2, .seconds = 8.0, .emg_cv = 0.1, .torque_sd_nm = 1.0, .with_priors = true});
  const IdentificationResult first = identify_torque(study.data);
  const IdentificationResult second = identify_torque(study.data);
  for (std::size_t j = 0; j < first.estimates.size(); ++j)
    EXPECT_EQ(first.estimates[j].estimate, second.estimates[j].estimate);
}

TEST(IdentifyTorque, AWrongTendonLengthGoesIntoTheOptimalFiberLengthAlone) {
  // f_l depends on l_mt - l_ts - l0: with a rigid tendon l_ts and l0 are one parameter.
  ElbowStudy study = elbow_study({.trials = 2});
  study.data.muscles[0].start.tendon_slack_length_m += 0.004;
  const IdentificationResult result = exactly(study.data);
  for (const ParameterEstimate& e : result.estimates) {
    const double shift = e.muscle == "BIC" && e.parameter == "optimal_fiber_length" ? -0.004 : 0.0;
    EXPECT_NEAR(e.estimate, true_value(study, e) + shift, 1e-6) << e.muscle << " " << e.parameter;
  }
}

TEST(IdentifyTorque, TwoMusclesOnOneSignalAndOnePathAreNotToldApart) {
  ElbowStudy study = elbow_study({.trials = 2});
  MuscleSetup twin = study.data.muscles[0];
  twin.name = "TWIN";
  study.data.muscles.push_back(twin);
  for (TrialData& trial : study.data.trials) {
    for (Eigen::MatrixXd* m : {&trial.length_m, &trial.velocity_mps, &trial.moment_arm_m, &trial.force_n}) {
      m->conservativeResize(m->rows(), 5);
      m->col(4) = m->col(0);
    }
  }
  const IdentificationResult result = exactly(study.data);
  for (const char* muscle : {"BIC", "TWIN"}) {
    const ParameterEstimate& e = find(result, muscle, "max_isometric_force");
    EXPECT_EQ(e.verdict, Verdict::not_identifiable);
    EXPECT_FALSE(e.std_error);
  }
  EXPECT_EQ(find(result, "TRI", "max_isometric_force").verdict, Verdict::identified);
}

TEST(IdentifyTorque, ATrialOnlyInLengtheningSaysNothingAboutShortening) {
  // Only the stretches in which BIC lengthens: V_sh does not act there, P and V_ml do.
  ElbowStudy study = elbow_study({.trials = 1, .seconds = 60.0});
  study.data.muscles.resize(1);
  TrialData& trial = study.data.trials[0];
  const Eigen::Index n = trial.time_s.size();
  for (Eigen::MatrixXd* m : {&trial.length_m, &trial.velocity_mps, &trial.moment_arm_m, &trial.force_n}) {
    m->conservativeResize(n, 1);
  }
  trial.velocity_mps = trial.velocity_mps.cwiseAbs();
  Eigen::MatrixXd activation = muscle_activation(study.data, trial, study.delay_s);
  for (Eigen::Index i = 0; i < n; ++i) {
    trial.torque_nm[i] =
        trial.moment_arm_m(i, 0) * muscle::hill_force(activation(i, 0),
                                                      trial.length_m(i, 0) - study.truth[0].tendon_slack_length_m,
                                                      trial.velocity_mps(i, 0), study.truth[0]);
  }
  const IdentificationResult result = exactly(study.data);
  const ParameterEstimate& shortening = find(result, "BIC", "concentric_curvature");
  EXPECT_EQ(shortening.verdict, Verdict::not_identifiable);
  EXPECT_EQ(shortening.estimate, shortening.initial);
  for (const char* parameter : {"eccentric_curvature_product", "eccentric_plateau"}) {
    const ParameterEstimate& e = find(result, "BIC", parameter);
    EXPECT_NEAR(e.estimate, true_value(study, e), 1e-5) << parameter;
    EXPECT_EQ(e.verdict, Verdict::identified) << e.reason;
  }
}

TEST(IdentifyTorque, HowFarAMuscleLeftTheLiteratureIsSaidOfItAlone) {
  ElbowStudy study = elbow_study({.torque_sd_nm = 0.5, .with_priors = true});
  const IdentificationResult near = identify_torque(study.data);
  ASSERT_EQ(near.prior_distances.size(), 4U);
  for (const PriorDistance& d : near.prior_distances) EXPECT_LT(d.distance, 3.0) << d.muscle;
  // A literature that is sure of another BIC: none of the other muscles can do its work.
  for (const auto& [name, factor] : {std::pair{"optimal_fiber_length", 2.0}, {"force_length_width", 0.4}}) {
    Prior& prior = study.data.muscles[0].priors.at(name);
    prior.mean *= factor;
    prior.sd = 0.03 * prior.mean;
  }
  const IdentificationResult far = identify_torque(study.data);
  EXPECT_GT(far.prior_distances[0].distance, 3.0);
  EXPECT_EQ(far.prior_distances[0].muscle, "BIC");
  EXPECT_LT(far.prior_distances[3].distance, 3.0);
  const auto distance = [](const ParameterEstimate& e) { return e.muscle == "BIC" ? e.prior_distance.value_or(0) : 0; };
  const ParameterEstimate& farthest = *std::ranges::max_element(far.estimates, {}, distance);
  EXPECT_NEAR(*farthest.prior_distance, far.prior_distances[0].farthest_distance, 1e-9);
  EXPECT_GT(*farthest.prior_distance, 3.0);
  EXPECT_NE(farthest.verdict, Verdict::identified);
  EXPECT_NE(farthest.reason.find("standard deviations away"), std::string::npos) << farthest.reason;
  EXPECT_TRUE(std::any_of(far.warnings.begin(), far.warnings.end(),
                          [](const Remark& w) { return w.code == RemarkCode::far_from_prior && w.about == "BIC"; }));
}

TEST(IdentifyTorque, HeldParametersStayAndOthersTakeTheirBounds) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0, .with_priors = true});
  study.data.muscles[1].fixed = {"concentric_curvature", "force_length_width"};
  study.data.muscles[2].bounds["optimal_fiber_length"] = {0.165, 0.175};
  EstimatorOptions options;
  options.muscles = {"BRA", "BRD"};
  options.delay_s = 0.05;
  const IdentificationResult result = identify_torque(study.data, options);
  EXPECT_EQ(result.free_parameters.size(), 4U + 6U);
  EXPECT_EQ(result.muscles[0].max_isometric_force_n, study.data.muscles[0].start.max_isometric_force_n);
  EXPECT_EQ(result.muscles[1].concentric_curvature, study.data.muscles[1].start.concentric_curvature);
  EXPECT_GE(result.muscles[2].optimal_fiber_length_m, 0.165);
  EXPECT_LE(result.muscles[2].optimal_fiber_length_m, 0.175);
  EXPECT_EQ(result.delay_s, 0.05);
}

TEST(IdentifyTorque, RefusesWhatDoesNotFitTogether) {
  ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0});
  {
    StudyData data = study.data;
    data.trials[0].length_m.conservativeResize(10, 4);
    EXPECT_THROW((void)identify_torque(data), InvalidInput);
  }
  {
    StudyData data = study.data;
    data.muscles[2].emg_channel = "nowhere";
    EXPECT_THROW((void)identify_torque(data), InvalidInput);
  }
  {
    StudyData data = study.data;
    data.trials[0].torque_nm[7] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)identify_torque(data), InvalidInput);
  }
  {
    StudyData data = study.data;
    data.trials[0].calibration = false;
    EXPECT_THROW((void)identify_torque(data), InvalidInput);
  }
}

TEST(IdentifyExactly, FreesTheSpeedOnlyIfTheDataAreMetOnlyThen) {
  ElbowStudy study = elbow_study({.trials = 3});
  free_speeds(study.data, {"BIC", "BRA", "BRD", "TRI"});
  const std::optional<IdentificationResult> held = identify_exactly(study.data);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->solution.size(), 25);
  for (MuscleSetup& setup : study.data.muscles) setup.start.max_shortening_speed_mps *= 1.2;
  const std::optional<IdentificationResult> freed_speed = identify_exactly(study.data);
  ASSERT_TRUE(freed_speed);
  EXPECT_EQ(freed_speed->solution.size(), 29);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(freed_speed->muscles[k].max_shortening_speed_mps, study.truth[k].max_shortening_speed_mps,
                1e-6 * study.truth[k].max_shortening_speed_mps);
}

TEST(IdentifyExactly, GivesTheDataBackBesideNuisances) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0, .with_priors = true});
  EstimatorOptions options;
  options.unseen = {};
  for (const MuscleSetup& muscle : study.data.muscles) options.state(muscle.emg_channel).gain_sd = 0.1;
  study.data.rules = nuisance_rules(study.data, true);
  const std::optional<IdentificationResult> result = identify_exactly(study.data, options);
  ASSERT_TRUE(result);
  int compared = 0;
  for (const ParameterEstimate& e : result->estimates) {
    ASSERT_TRUE(e.given_estimate);
    EXPECT_EQ(*e.given_estimate, e.estimate);
    for (std::size_t k = 0; k < 4; ++k) {
      if (e.muscle != study.data.muscles[k].name ||
          std::ranges::count(muscle::kHillFields, e.parameter, &muscle::HillField::name) == 0)
        continue;
      const double truth = study.truth[k].*muscle::hill_field(e.parameter).member;
      EXPECT_NEAR(e.estimate, truth, 1e-9 * truth) << e.muscle << " " << e.parameter;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 4 * 6);
}

/// The study at one joint angle: muscles that do not move.
ElbowStudy at_one_angle(ElbowStudy study) {
  test::StudyNoise noise(8);
  for (TrialData& trial : study.data.trials) {
    const Eigen::Index n = trial.time_s.size();
    trial.length_m = study.data.trials[0].length_m.row(0).replicate(n, 1).eval();
    trial.moment_arm_m = study.data.trials[0].moment_arm_m.row(0).replicate(n, 1).eval();
    trial.velocity_mps.setZero();
    trial.torque_nm =
        predict(study.data, trial, study.truth, study.delay_s).torque_nm + 0.5 * noise.band(n, 6.0, 100.0);
  }
  return study;
}

TEST(IdentifyTorque, OneJointAngleTellsNothingOfTheForceLengthCurve) {
  int judged = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const ElbowStudy study =
        at_one_angle(elbow_study({.seconds = 10.0, .emg_cv = 0.05, .with_priors = true, .seed = seed}));
    const IdentificationResult result = identify_torque(study.data);
    for (const ParameterEstimate& e : result.estimates) {
      if (e.parameter != "optimal_fiber_length" && e.parameter != "force_length_width") continue;
      ++judged;
      EXPECT_EQ(e.verdict, Verdict::prior_dominated) << e.muscle << " " << e.parameter << ": " << e.reason;
    }
  }
  EXPECT_EQ(judged, 2 * 8);
}

TEST(MotionAlone, WarnsWhereASpringAndAnInertiaTellTheTorque) {
  StudyData data;
  data.trials = {test::swing(0.0), test::swing(0.0)};
  data.muscles.push_back({.name = "BIC"});
  IdentificationResult result;
  result.estimates.push_back({.muscle = "BIC", .verdict = Verdict::identified});
  result.estimates.push_back({.muscle = "subject", .verdict = Verdict::identified});  // the delay
  fit::apply(caps_of_torque(data, {.predictions = false}, result), result);
  EXPECT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.estimates[0].verdict, Verdict::weak);
  EXPECT_EQ(result.estimates[1].verdict, Verdict::weak);
}

TEST(MotionAlone, SaysNothingOfAnEffortBesideTheMotion) {
  StudyData data;
  data.trials = {test::swing(2.0)};
  IdentificationResult result;
  EXPECT_TRUE(caps_of_torque(data, {.predictions = false}, result).empty());
  EXPECT_TRUE(result.warnings.empty());
}

/// Takes the muscle out of the study, and leaves its torque in.
StudyData without_muscle(StudyData data, std::size_t k) {
  std::vector<Eigen::Index> others;
  for (std::size_t i = 0; i < data.muscles.size(); ++i)
    if (i != k) others.push_back(static_cast<Eigen::Index>(i));
  data.muscles.erase(data.muscles.begin() + static_cast<std::ptrdiff_t>(k));
  for (TrialData& trial : data.trials) {
    for (Eigen::MatrixXd* of : {&trial.length_m, &trial.velocity_mps, &trial.moment_arm_m, &trial.force_n})
      *of = (*of)(Eigen::all, others).eval();
  }
  return data;
}

/// The number of muscles with EMG whose intervals of F_max hold the truth, and the sum of the widths over the truth.
struct Strengths {
  int held = 0;
  double widths = 0.0;
};
Strengths strengths_of(const ElbowStudy& study, const StudyData& data) {
  Strengths found;
  for (const ParameterEstimate& e : identify_torque(data).estimates) {
    if (e.parameter != "max_isometric_force" || e.muscle == study.data.muscles[1].name) continue;
    const double truth = true_value(study, e);
    found.held += *e.ci_low <= truth && truth <= *e.ci_high ? 1 : 0;
    found.widths += (*e.ci_high - *e.ci_low) / truth;
  }
  return found;
}

/// Three muscles with EMG, and BRA without, which acts half as much.
ElbowStudy with_hidden_brachialis(WithoutEmg by) {
  ElbowStudy study =
      elbow_study({.trials = 2, .seconds = 10.0, .emg_cv = 0.05, .torque_sd_nm = 0.3, .with_priors = true});
  constexpr std::size_t kHidden = 1;
  for (TrialData& trial : study.data.trials)
    trial.torque_nm -= 0.5 * trial.moment_arm_m.col(kHidden).cwiseProduct(trial.force_n.col(kHidden));
  MuscleSetup& hidden = study.data.muscles[kHidden];
  hidden.emg_channel = hidden.name + " without EMG";
  hidden.unseen = UnseenActivation{.by = by, .parts = {}};
  expect_activations(study.data);
  return study;
}

TEST(WithoutEmg, IntervalsOfTheOtherMusclesHoldTheTruthAndAreWiderThanWithoutTheMuscle) {
  const ElbowStudy study = with_hidden_brachialis(WithoutEmg::unseen);
  const double left_out = strengths_of(study, without_muscle(study.data, 1)).widths;
  for (const WithoutEmg by : {WithoutEmg::unseen, WithoutEmg::synergies}) {
    const Strengths found = strengths_of(study, with_hidden_brachialis(by).data);
    EXPECT_EQ(found.held, 3) << choice_name(by);
    EXPECT_GT(found.widths, left_out) << choice_name(by);
  }
}

TEST(WithoutEmg, NoNumberOfTheMuscleIsIdentifiedAndItsStrengthIsNotTold) {
  const ElbowStudy study = with_hidden_brachialis(WithoutEmg::unseen);
  const IdentificationResult result = identify_torque(study.data);
  const std::string& name = study.data.muscles[1].name;
  for (const ParameterEstimate& e : result.estimates)
    EXPECT_FALSE(e.muscle == name && e.verdict == Verdict::identified) << e.parameter;
  const ParameterEstimate& strength = find(result, name, "max_isometric_force");
  EXPECT_EQ(strength.verdict, Verdict::not_identifiable);
  EXPECT_EQ(strength.reason, without_emg_says(name));
}

TEST(WithoutEmg, NumbersOfTheMusclesThatPullWithItRestOnItUnlessItIsSmall) {
  ElbowStudy study = with_hidden_brachialis(WithoutEmg::unseen);
  const auto caps = [&] {
    EstimatorOptions options;
    options.predictions = false;
    IdentificationResult result;
    return caps_of_torque(study.data, options, result);
  };
  const Eigen::RowVectorXd arm = study.data.trials[0].moment_arm_m.colwise().mean();
  std::vector<std::string> pull;
  for (std::size_t k = 0; k < study.data.muscles.size(); ++k)
    if (k != 1 && arm[static_cast<Eigen::Index>(k)] * arm[1] > 0.0) pull.push_back(study.data.muscles[k].name);
  ASSERT_EQ(pull.size(), 2U);
  const std::size_t count = caps().size();
  EXPECT_EQ(caps().back().owners, pull);
  EXPECT_TRUE(caps().back().parameters.empty());
  study.data.muscles[1].start.max_isometric_force_n *= 0.01;
  EXPECT_EQ(caps().size(), count - 1);
}

}  // namespace
}  // namespace myoid::fit
