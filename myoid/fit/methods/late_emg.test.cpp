#include "myoid/fit/methods/late_emg.h"

#include <gtest/gtest.h>

#include "myoid/fit/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

/// A noisy recording whose EMG is stamped `late_s` after its own time; its muscles pull with the EMG.
StudyData recording(double late_s, std::uint64_t seed, std::size_t late_trials = 3) {
  test::ElbowStudyOptions options = test::noisy_person(seed);
  options.delay_s = 0.0;
  StudyData data = test::elbow_study(options).data;
  for (std::size_t i = 0; i < late_trials; ++i) test::delay_emg(data.trials[i], late_s);
  return data;
}

const ParameterEstimate& delay_of(const IdentificationResult& fit) {
  return *std::ranges::find(fit.estimates, std::string("emg_delay"), &ParameterEstimate::parameter);
}

TEST(LateEmg, OfAllTrialsOrOfOneIsNoAbsentDelay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const IdentificationResult all = identify_torque(recording(0.1, seed));
    const ParameterEstimate& delay = delay_of(all);
    EXPECT_EQ(delay.verdict, Verdict::not_identifiable) << seed << ": " << delay.estimate << ' ' << delay.reason;
    EXPECT_NE(delay.reason.find("late clock"), std::string::npos) << delay.reason;
    ASSERT_FALSE(all.warnings.empty());
    EXPECT_EQ(all.warnings.back().code, RemarkCode::late_emg);
    EXPECT_EQ(all.warnings.back().says, "emg_delay: " + delay.reason);
    const StudyData data = recording(0.3, seed, 1);
    const auto one = late_emg(data, identify_torque(data), 0.0);
    ASSERT_TRUE(one) << seed;
    EXPECT_EQ(one->trial, data.trials[0].name);
    EXPECT_NEAR(one->late_s, 0.3, 0.15);
  }
}

TEST(LateEmg, IsNoneWhereMusclesPullWithTheirEmg) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const StudyData data = recording(0.004, seed);  // within the error allowed to a delay
    const IdentificationResult fit = identify_torque(data);
    const ParameterEstimate& delay = delay_of(fit);
    EXPECT_EQ(delay.reason.find("late clock"), std::string::npos) << seed << ": " << delay.reason;
  }
}

}  // namespace
}  // namespace myoid::fit
