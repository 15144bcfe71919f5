#include "myoid/intervals/held_tendon.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "myoid/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

const std::string kSlackLength = "tendon_slack_length";

ElbowStudy noisy() { return elbow_study({.emg_cv = 0.04, .torque_sd_nm = 0.3, .with_priors = true, .seed = 4}); }

const ParameterEstimate& length_of(const IdentificationResult& result, const std::string& muscle) {
  for (const ParameterEstimate& e : result.estimates) {
    if (e.muscle == muscle && e.parameter == "optimal_fiber_length") return e;
  }
  throw std::runtime_error("no length of " + muscle);
}

TEST(HeldTendon, TheShiftIsThatOfAFitWithALongerTendon) {
  ElbowStudy study = noisy();
  constexpr double kSd_m = 0.002;
  study.data.muscles[0].priors[kSlackLength] = {.mean = 0.0, .sd = kSd_m};
  const EstimatorOptions options{.starts = 1};
  const Estimator estimator(study.data, options);
  const Estimator::Solution solution = estimator.solve(estimator.model().parameters().start());
  const Eigen::VectorXd shift = held_tendon_shift(estimator, solution, study.data).col(0);
  // The same weights, the tendon longer and shorter: the difference has no curvature.
  const auto refitted = [&](double by_m) {
    StudyData other = study.data;
    other.muscles[0].start.tendon_slack_length_m += by_m;
    const Estimator moved(other, options);
    return moved.search(solution.search.x, solution.weighting, 1e-10, 1e-13).x;
  };
  const Eigen::VectorXd difference = 0.5 * (refitted(kSd_m) - refitted(-kSd_m));
  for (Eigen::Index j = 0; j < shift.size(); ++j) {
    const Unknown& p = estimator.free()[static_cast<std::size_t>(j)];
    // Gauss and Newton's curvature leaves out second derivatives times residuals: a tenth, and
    // nothing beside what is known beforehand.
    EXPECT_NEAR(shift[j], difference[j], 0.1 * std::abs(difference[j]) + 0.01 * p.prior.sd + 1e-4) << p.label;
    if (p.label == "BIC.optimal_fiber_length") {
      EXPECT_NEAR(shift[j], -kSd_m, 0.1 * kSd_m);
    }
  }
}

TEST(HeldTendon, WhatNobodyMeasuredWidensTheIntervalOfTheOptimalLength) {
  ElbowStudy study = noisy();
  const IdentificationResult known = identify_torque(study.data, {.starts = 1});
  for (MuscleSetup& m : study.data.muscles) m.priors[kSlackLength] = literature_priors(m.start).at(kSlackLength);
  const IdentificationResult generic = identify_torque(study.data, {.starts = 1});
  const double slack_m = study.data.muscles[0].start.tendon_slack_length_m;
  const ParameterEstimate& narrow = length_of(known, "BIC");
  const ParameterEstimate& wide = length_of(generic, "BIC");
  EXPECT_EQ(wide.estimate, narrow.estimate);
  // A tenth of the tendon, and the noise of the fit beside it.
  const double half = 0.5 * (*wide.ci_high - *wide.ci_low);
  EXPECT_NEAR(half, std::hypot(1.96 * 0.10 * slack_m, 0.5 * (*narrow.ci_high - *narrow.ci_low)), 0.1 * half);
  EXPECT_EQ(narrow.verdict, Verdict::identified);
  EXPECT_NE(wide.verdict, Verdict::identified);
  EXPECT_NE(wide.reason.find("tendon slack length"), std::string::npos) << wide.reason;
  // A tendon of 5 cm leaves the brachialis a narrower one.
  EXPECT_LT(*length_of(generic, "BRA").std_error, *wide.std_error);
}

TEST(HeldTendon, IsKnownWhereTheStudySaysSo) {
  ElbowStudy study = noisy();
  MuscleSetup& biceps = study.data.muscles[0];
  biceps.priors[kSlackLength] = {.mean = 0.2, .sd = 0.02};
  EXPECT_EQ(held_slack_sd_m(study.data, 0), 0.02);
  EXPECT_EQ(held_slack_sd_m(study.data, 1), 0.0);
  ParameterRule rule;
  rule.parameter = kSlackLength;
  rule.owners = {"BIC"};
  rule.prior_sd = 0.004;
  study.data.rules = {rule};
  EXPECT_EQ(held_slack_sd_m(study.data, 0), 0.004);
  rule.prior_sd.reset();
  rule.value = 0.23;
  study.data.rules = {rule};
  EXPECT_EQ(held_slack_sd_m(study.data, 0), 0.0);
  study.data.rules.clear();
  biceps.fixed = {kSlackLength};
  EXPECT_EQ(held_slack_sd_m(study.data, 0), 0.0);
}

}  // namespace
}  // namespace myoid::identification
