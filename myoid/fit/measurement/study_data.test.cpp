#include "myoid/fit/measurement/study_data.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/methods/cross_validation.h"
#include "myoid/fit/methods/force.h"
#include "myoid/fit/methods/paper.h"
#include "myoid/fit/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(IncludedRows, LeaveOutTheIntervalsWithTheirEnds) {
  TrialData trial;
  trial.time_s = Eigen::VectorXd::LinSpaced(11, 0.0, 10.0);
  EXPECT_EQ(included_rows(trial).size(), 11u);
  trial.excluded = {{-1.0, 1.0}, {4.0, 5.5}};
  EXPECT_EQ(included_rows(trial), (std::vector<Eigen::Index>{2, 3, 6, 7, 8, 9, 10}));
}

/// Torque and forces are wrong by a factor in a stretch that the study leaves out.
ElbowStudy spoiled_study(bool excluded) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 20.0, .rate_hz = 50.0});
  for (TrialData& trial : study.data.trials) {
    for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
      if (trial.time_s[i] < 6.0 || trial.time_s[i] > 9.0) continue;
      trial.torque_nm[i] *= 0.5;
      trial.force_n.row(i) *= 0.5;
    }
    if (excluded) trial.excluded = {{5.99, 9.01}};
  }
  return study;
}

double worst_error(const ElbowStudy& study, const IdentificationResult& result) {
  double worst = 0.0;
  for (std::size_t m = 0; m < study.truth.size(); ++m) {
    for (std::size_t f = 0; f < 6; ++f) {
      const auto member = muscle::kHillFields[f].member;
      worst = std::max(worst, std::abs(result.muscles[m].*member / (study.truth[m].*member) - 1.0));
    }
  }
  return worst;
}

TEST(ExcludedIntervals, DoNotTouchTheEstimates) {
  EXPECT_FALSE(identify_exactly(spoiled_study(false).data));
  const ElbowStudy excluded = spoiled_study(true);
  const std::optional<IdentificationResult> result = identify_exactly(excluded.data);
  ASSERT_TRUE(result);
  EXPECT_LT(worst_error(excluded, *result), 1e-6);
  // Scored without it too: the prediction is right wherever it counts.
  for (const TrialFit& fit : result->trials) EXPECT_LT(fit.score.rmse_nm(), 1e-5);
}

TEST(ExcludedIntervals, AreNeitherScoredInFoldsNorSampledByThePaper) {
  const ElbowStudy excluded = spoiled_study(true);
  const auto exactly = [](StudyData& split, EstimatorOptions& options) { return *identify_exactly(split, options); };
  for (const Fold& fold : cross_validate(excluded.data, exactly, {}, {})) {
    EXPECT_EQ(fold.time_s.size(), 1001 - 151);
    EXPECT_LT(fold.identified.rmse_nm(), 0.01);
  }
  const ElbowStudy whole = elbow_study({.trials = 2, .seconds = 20.0, .rate_hz = 50.0});
  EXPECT_LT(identify_paper(excluded.data, {}).samples_used, identify_paper(whole.data, {}).samples_used);
}

/// One flexor's own force, below noisy EMG; its v_max begins 25 % too high, 1.1 spreads of what is known of it.
StudyData force_of_wrong_speed(const ElbowStudy& study) {
  StudyData data = force_study(study.data, 0);
  data.muscles[0].start.max_shortening_speed_mps *= 1.25;
  data.muscles[0].priors = literature_priors(data.muscles[0].start);
  return data;
}

const ParameterEstimate& of(const IdentificationResult& result, const std::string& parameter) {
  for (const ParameterEstimate& e : result.estimates) {
    if (e.parameter == parameter) return e;
  }
  throw std::runtime_error("no " + parameter);
}

TEST(FreeSpeeds, CarryIntoTheIntervalsWhatIsNotKnownOfVmax) {
  const ElbowStudy study = elbow_study({.trials = 2, .rate_hz = 50.0, .emg_cv = 0.04});
  const StudyData held = force_of_wrong_speed(study);
  StudyData freed = held;
  free_speeds(freed, unstated_speeds(freed));
  // ln 0.3, and ln 0.2 along d ln V_sh = -(1 + V_sh) d ln v_max.
  const double shape = held.muscles[0].start.concentric_curvature;
  EXPECT_NEAR(freed.muscles[0].priors.at("concentric_curvature").sd, std::hypot(0.3, 0.2 * (1.0 + shape)), 1e-12);
  const double truth = study.truth[0].concentric_curvature;
  const EstimatorOptions options{.predictions = false};
  // Held, its error goes into V_sh, which is then claimed to be known better.
  const ParameterEstimate wrong = of(identify_torque(held, options), "concentric_curvature");
  const IdentificationResult fit = identify_torque(freed, options);
  const ParameterEstimate& right = of(fit, "concentric_curvature");
  EXPECT_LT(*right.ci_low, truth);
  EXPECT_GT(*right.ci_high, truth);
  EXPECT_LT(std::abs(right.estimate - truth), std::abs(wrong.estimate - truth));
  EXPECT_GT(*right.ci_high - *right.ci_low, 1.3 * (*wrong.ci_high - *wrong.ci_low));
  EXPECT_TRUE(of(fit, "max_shortening_speed").prior_sd);
}

TEST(FreeSpeeds, AreThoseThatNobodyStates) {
  StudyData data = elbow_study({.trials = 1, .seconds = 2.0}).data;
  data.muscles[1].fixed = {"max_shortening_speed"};
  EXPECT_EQ(unstated_speeds(data), (std::vector<std::string>{"BIC", "BRD", "TRI"}));
  EXPECT_EQ(unstated_speeds(data, {"BRA", "TRI"}), std::vector<std::string>{"TRI"});
  // A rule of the study comes later, and wins. A speed beyond any person's is free about itself.
  data.rules = {{.parameter = "max_shortening_speed", .owners = {"BRD"}, .free = false}};
  data.muscles[3].start.max_shortening_speed_mps = 20.0;
  free_speeds(data, unstated_speeds(data));
  const ParameterMap map(data, {});
  std::vector<std::string> free;
  for (const Unknown& p : map.free()) {
    if (p.field->name != "max_shortening_speed") continue;
    free.push_back(p.owner);
    if (p.owner != "TRI") continue;
    EXPECT_NEAR(p.to_value(p.bounds.lower), 20.0 / 3.0, 1e-9);
    EXPECT_NEAR(p.to_value(p.bounds.upper), 3.0 * 20.0, 1e-9);
  }
  EXPECT_EQ(free, (std::vector<std::string>{"BIC", "TRI"}));
}

TEST(TrialRows, EveryNumberOfASampleGoesWithIt) {
  // Column c of sample i is 10 i + c; the second joint's is less by 100.
  TrialData trial;
  const Eigen::VectorXd sample = Eigen::VectorXd::LinSpaced(6, 0.0, 50.0);
  const auto of_two = [&](double more) {
    return (Eigen::MatrixXd(6, 2) << sample.array() + more, sample.array() + more + 1.0).finished();
  };
  trial.time_s = sample;
  trial.length_m = of_two(0.0);
  trial.velocity_mps = of_two(2.0);
  trial.moment_arm_m = of_two(4.0);
  trial.torque_nm = trial.angle_rad = trial.resting_nm = sample;
  JointData joint;
  joint.moment_arm_m = of_two(-100.0);
  joint.torque_nm = sample.array() - 100.0;
  trial.more_joints.push_back(joint);
  const TrialData two = at_rows(trial, {1, 4});
  for (const Eigen::Index i : {0, 1}) {
    const double t = i == 0 ? 10.0 : 40.0;
    EXPECT_EQ(two.time_s[i], t);
    EXPECT_EQ(two.length_m.row(i), Eigen::RowVector2d(t, t + 1.0));
    EXPECT_EQ(two.velocity_mps.row(i), Eigen::RowVector2d(t + 2.0, t + 3.0));
    EXPECT_EQ(two.moment_arm_m.row(i), Eigen::RowVector2d(t + 4.0, t + 5.0));
    EXPECT_EQ(Eigen::Vector3d(two.torque_nm[i], two.angle_rad[i], two.resting_nm[i]), Eigen::Vector3d::Constant(t));
    EXPECT_EQ(two.more_joints[0].moment_arm_m.row(i), Eigen::RowVector2d(t - 100.0, t - 99.0));
    EXPECT_EQ(two.more_joints[0].torque_nm[i], t - 100.0);
  }
  EXPECT_EQ(two.torque_nm.size(), 2);
  EXPECT_EQ(two.force_n.size(), 0) << "no forces were given";
}

}  // namespace
}  // namespace myoid::fit
