#include "myoid/run/other_choice.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/fit/methods/cross_validation.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/fit/posterior/exploration.h"

#include "tests/support/elbow_study.h"

namespace myoid::run {
namespace {

using fit::WithoutEmg;

/// Three trials of the elbow, whose second muscle has no EMG.
fit::StudyData hidden(WithoutEmg by) {
  fit::StudyData data =
      test::elbow_study({.trials = 3, .seconds = 10.0, .torque_sd_nm = 0.2, .with_priors = true}).data;
  data.muscles[1].unseen = fit::UnseenActivation{.by = by, .parts = {}};
  data.muscles[1].emg_channel = "without EMG";
  fit::expect_activations(data);
  return data;
}

fit::EstimatorOptions elbow_options() {
  fit::EstimatorOptions options = fit::estimator_options({}, {}, {});
  options.choose_lag = false;
  return options;
}

// The mode of the other choice, searched for from the start and not from the first choice's answer, lies where the
// numbers are said to move to.
TEST(OtherChoice, MovesNumbersAsAFitOfTheOtherChoiceDoes) {
  const fit::EstimatorOptions options = elbow_options();
  const fit::StudyData data = hidden(WithoutEmg::unseen);
  const fit::IdentificationResult torque = fit::identify_torque(data, options);
  const std::optional<OtherChoice> found = other_choice(data, options, torque);
  ASSERT_TRUE(found);
  const auto log_force = [&](const fit::StudyData& of, std::size_t muscle) {
    const fit::Exploration explored = fit::explore(of, fit::of_a_fold(options));
    const fit::Candidate& best = explored.modes.front();
    const fit::ParameterMap& map = best.density->parameters();
    return best.density->z_of(best.mode.x)[map.find(fit::Scope::muscle, fit::kMaxForce, static_cast<int>(muscle))];
  };
  const fit::StudyData synergies = hidden(WithoutEmg::synergies);
  for (const std::size_t muscle : {0U, 1U, 3U}) {
    const std::string& name = data.muscles[muscle].name;
    const auto row = std::ranges::find_if(torque.estimates, [&](const fit::ParameterEstimate& e) {
      return e.muscle == name && e.parameter == "max_isometric_force";
    });
    ASSERT_NE(row, torque.estimates.end());
    const OtherChoice::Number* number = found->of(*row);
    ASSERT_NE(number, nullptr);
    const double moved = std::exp(log_force(synergies, muscle)) - std::exp(log_force(data, muscle));
    EXPECT_NEAR(number->other - row->estimate, moved, 0.02 * row->estimate) << name;
    EXPECT_EQ(number->outside(), number->other < *row->ci_low || number->other > *row->ci_high) << name;
  }
}

TEST(OtherChoice, IsNoneWhereEveryMuscleHasEmg) {
  const fit::StudyData data = test::elbow_study({.trials = 1, .seconds = 4.0, .with_priors = true}).data;
  EXPECT_FALSE(other_choice(data, elbow_options(), {}));
}

}  // namespace
}  // namespace myoid::run
