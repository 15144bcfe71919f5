#include "myoid/posterior/posterior.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "myoid/core/error.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

const ParameterEstimate& find(const IdentificationResult& result,
                              const std::string& muscle,
                              const std::string& parameter) {
  for (const ParameterEstimate& e : result.estimates) {
    if (e.muscle == muscle && e.parameter == parameter) return e;
  }
  throw InvalidInput("no estimate " + muscle + "." + parameter);
}

ElbowStudy person(std::uint64_t seed) {
  ElbowStudy study = elbow_study({.trials = 3,
                                  .seconds = 10.0,
                                  .emg_cv = 0.1,
                                  .torque_sd_nm = 0.5,
                                  .truth_from_prior = true,
                                  .with_priors = true,
                                  .seed = seed});
  for (MuscleSetup& muscle : study.data.muscles) muscle.fixed = {"tendon_slack_length"};
  return study;
}

TEST(IdentifyByPosterior, IntervalsHoldThePersonAndThoseOfExactGeometryAreInside) {
  const ElbowStudy study = person(3);
  EstimatorOptions options;
  options.posterior_draws = 300;
  const IdentificationResult result = identify_by_posterior(study.data, options);
  ASSERT_EQ(result.termination, math::Termination::converged) << result.message;
  int held = 0, all = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    for (const char* name : {"max_isometric_force", "optimal_fiber_length"}) {
      const ParameterEstimate& e = find(result, study.data.muscles[k].name, name);
      const double truth = study.truth[k].*muscle::hill_field(name).member;
      ++all;
      held += truth >= *e.ci_low && truth <= *e.ci_high;
      ASSERT_EQ(e.routes.size(), 2U);
      EXPECT_LT(*e.routes[1].high - *e.routes[1].low, 1.05 * (*e.ci_high - *e.ci_low));
      if (e.parameter == "max_isometric_force") {
        // Moment arms of 10 % and a torque scale of 3 % are in the strength, whatever is recorded.
        EXPECT_GT(*e.ci_high - *e.ci_low, 1.2 * 1.96 * 0.1 * e.estimate);
      }
    }
  }
  EXPECT_GE(held, all - 1);
}

TEST(IdentifyByPosterior, OfANoiseThatIsNoMusclesNothingIsIdentified) {
  ElbowStudy study = person(4);
  test::StudyNoise noise(9);
  for (TrialData& trial : study.data.trials)
    trial.torque_nm = 10.0 * noise.band(trial.time_s.size(), 2.0, 100.0);
  EstimatorOptions options;
  options.posterior_draws = 0;
  const IdentificationResult result = identify_by_posterior(study.data, options);
  for (const ParameterEstimate& e : result.estimates)
    EXPECT_NE(e.verdict, Verdict::identified) << e.muscle << " " << e.parameter << ": " << e.reason;
}

TEST(IdentifyByPosterior, NeedsPriors) {
  EstimatorOptions options;
  options.priors = false;
  EXPECT_THROW((void)identify_by_posterior(person(5).data, options), InvalidInput);
}

}  // namespace
}  // namespace myoid::identification
