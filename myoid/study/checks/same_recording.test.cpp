#include "myoid/study/checks/same_recording.h"

#include <random>

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

/// Two channels of noise in steps of a converter; `from` is the number of the first sample.
TimeSeries noise(std::uint64_t seed, Eigen::Index from = 0, Eigen::Index count = 4000) {
  std::mt19937_64 engine(seed);
  Eigen::MatrixXd values(count, 2);
  for (Eigen::Index i = 0; i < from; ++i) (void)engine();
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::uint64_t bits = engine();
    values(i, 0) = 1e-6 * static_cast<double>(bits % 7);
    values(i, 1) = 1e-6 * static_cast<double>(bits / 7 % 1000);
  }
  const Eigen::VectorXd time =
      Eigen::VectorXd::LinSpaced(count, 1e-3 * static_cast<double>(from), 1e-3 * static_cast<double>(from + count - 1));
  return {time, {{"a", Unit::volt}, {"b", Unit::volt}}, values};
}

TrialPrint print(const std::string& name, std::uint64_t emg, std::uint64_t motion, Use use = Use::calibration) {
  return {.trial = name,
          .use = use,
          .emg_file = name + ".sto",
          .motion_file = name + ".mot",
          .emg = stretches_of(noise(emg)),
          .movement = stretches_of(noise(1000 + motion))};
}

std::vector<Severity> levels(const std::vector<TrialPrint>& trials) {
  std::vector<Severity> result;
  for (const Remark& f : same_recordings(trials)) result.push_back(f.severity);
  return result;
}

TEST(CommonShare, IsOneOfTheSameSamplesAndNoneOfOthers) {
  EXPECT_EQ(common_share(stretches_of(noise(1)), stretches_of(noise(1))), 1.0);
  EXPECT_EQ(common_share(stretches_of(noise(1)), stretches_of(noise(2))), 0.0);
}

TEST(CommonShare, IsOfTheSamplesOfAllChannelsWhateverTheClock) {
  const TimeSeries whole = noise(1);
  const TimeSeries later(whole.time_s().array() + 5.0, whole.channels(), whole.values());
  EXPECT_EQ(common_share(stretches_of(whole), stretches_of(later)), 1.0);
  // The 31 stretches across the window's edge belong to the other trial.
  EXPECT_NEAR(common_share(stretches_of(whole), stretches_of(noise(1, 2000, 4000))), 0.5, 0.03);
  EXPECT_EQ(common_share(stretches_of(whole), stretches_of(noise(1, 4000, 4000))), 0.0);
  Eigen::MatrixXd mixed = whole.values();
  mixed.col(1) = noise(2).values().col(1);
  const TimeSeries half(whole.time_s(), whole.channels(), mixed);
  EXPECT_EQ(common_share(stretches_of(whole), stretches_of(half)), 0.0);
}

TEST(CommonShare, OfWhatDoesNotChangeIsNone) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(1000, 0.0, 1.0);
  const TimeSeries still(time, {{"q", Unit::radian}}, Eigen::MatrixXd::Constant(1000, 1, 1.2));
  EXPECT_EQ(common_share(stretches_of(still), stretches_of(still)), 0.0);
}

TEST(SameRecordings, OneEmgWithTwoMovementsIsAnError) {
  const std::vector<Remark> found = same_recordings({print("a", 1, 1), print("b", 2, 2), print("c", 1, 3)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_EQ(found[0].where, "c");
  EXPECT_NE(found[0].says.find("'a' (a.sto)"), std::string::npos) << found[0].says;
}

TEST(SameRecordings, OneRecordingTwiceIsAnErrorAndDifferentOnesAreNone) {
  EXPECT_EQ(levels({print("a", 1, 1), print("b", 1, 1)}), std::vector{Severity::error});
  EXPECT_EQ(levels({print("a", 1, 1), print("b", 2, 2)}), std::vector<Severity>{});
}

TEST(SameRecordings, OneMovementWithTwoEmgsIsAWarning) {
  EXPECT_EQ(levels({print("a", 1, 1), print("b", 2, 1)}), std::vector{Severity::warning});
}

TEST(SameRecordings, AMaximalContractionThatIsATrialOnceMoreIsAWarning) {
  EXPECT_EQ(levels({print("a", 1, 1), print("m", 1, 2, Use::mvc)}), std::vector{Severity::warning});
  EXPECT_EQ(levels({print("m", 1, 1, Use::mvc), print("n", 1, 1, Use::mvc)}), std::vector<Severity>{});
}

TEST(SameRecordings, WindowsOfOneFileThatMeetAreTwoTrials) {
  const auto window = [](Eigen::Index from) {
    TrialInput input;
    input.motion = noise(7, from, 4000);
    input.emg = noise(3, std::max<Eigen::Index>(0, from - 500), from > 0 ? 4500 : 4000);
    return input;
  };
  TrialSpec first, second;
  first.name = "a";
  second.name = "b";
  EXPECT_EQ(levels({print_of(first, window(0)), print_of(second, window(4000))}), std::vector<Severity>{});
  EXPECT_EQ(levels({print_of(first, window(0)), print_of(second, window(3000))}), std::vector{Severity::error});
}

}  // namespace
}  // namespace myoid::study
