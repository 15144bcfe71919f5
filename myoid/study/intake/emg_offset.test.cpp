#include "myoid/study/intake/emg_offset.h"

#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace myoid::study {
namespace {

/// Bursts of a walking muscle, one a second, over noise of a quiet electrode; 60 s at 100 Hz.
TimeSeries bursts(const std::string& channel, std::uint64_t seed, double constant) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd t(6000), e(6000);
  double noise = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    t[i] = 0.01 * static_cast<double>(i);
    noise += 0.1 * (normal(engine) - noise);
    const double burst = std::sin(2.0 * std::numbers::pi * t[i]);
    e[i] = constant + std::abs(0.002 + 0.001 * noise) + (burst > 0.3 ? 0.3 * (1.0 + 0.3 * noise) * (burst - 0.3) : 0.0);
  }
  return {t, {{channel, Unit::dimensionless}}, e};
}

Study study_of(EmgKind kind, std::size_t trials) {
  Study study;
  study.emg.kind = kind;
  study.muscles.push_back({.name = "SOL", .emg = "SOL"});
  for (std::size_t i = 0; i < trials; ++i) study.trials.push_back({.name = fmt::format("walk{}", i + 1)});
  return study;
}

std::vector<TrialInput> inputs_of(std::vector<TimeSeries> emg) {
  std::vector<TrialInput> inputs(emg.size());
  for (std::size_t i = 0; i < emg.size(); ++i) inputs[i].emg = std::move(emg[i]);
  return inputs;
}

TEST(EmgOffset, OfOneTrialIsTakenOff) {
  std::vector<TrialInput> inputs = inputs_of({bursts("SOL", 1, 0.0), bursts("SOL", 2, 0.06)});
  const std::vector<Remark> found = take_off_emg_offsets(study_of(EmgKind::envelope, 2), inputs);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, RemarkCode::emg_offset);
  EXPECT_EQ(found[0].where, "walk2");
  EXPECT_NEAR(*found[0].value, 0.062, 0.001);
  const Eigen::VectorXd left = inputs[1].emg->values().col(0) - bursts("SOL", 2, 0.0).values().col(0);
  EXPECT_LT(left.cwiseAbs().maxCoeff(), 0.004);
  EXPECT_EQ(inputs[0].emg->values(), bursts("SOL", 1, 0.0).values());
}

TEST(EmgOffset, OfAllTrialsIsNotTold) {
  std::vector<TrialInput> inputs = inputs_of({bursts("SOL", 1, 0.06), bursts("SOL", 2, 0.06)});
  EXPECT_TRUE(take_off_emg_offsets(study_of(EmgKind::envelope, 2), inputs).empty());
}

TEST(EmgOffset, HeldEffortsAndTensionAreActivity) {
  const TimeSeries walk = bursts("SOL", 1, 0.0);
  Eigen::VectorXd held = Eigen::VectorXd::Constant(6000, 0.3);  // one effort, as steady as can be
  held.head(500).setConstant(0.002);
  // A tense muscle: the mean of its rectified EMG over a pause varies by a sixth.
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  Eigen::VectorXd tense = bursts("SOL", 2, 0.0).values().col(0);
  double slow = 0.0;
  for (double& value : tense) {
    slow += 0.1 * (normal(engine) - slow);
    value += 0.06 * std::exp(0.16 * slow / std::sqrt(0.1 / 1.9));
  }
  std::vector<TrialInput> inputs =
      inputs_of({walk, {walk.time_s(), walk.channels(), held}, {walk.time_s(), walk.channels(), tense}});
  EXPECT_TRUE(take_off_emg_offsets(study_of(EmgKind::envelope, 3), inputs).empty());
}

TEST(EmgOffset, ActivationsAndRawEmgStay) {
  for (const EmgKind kind : {EmgKind::activation, EmgKind::raw}) {
    std::vector<TrialInput> inputs = inputs_of({bursts("SOL", 1, 0.0), bursts("SOL", 2, 0.06)});
    const std::size_t told = kind == EmgKind::activation ? 1 : 0;
    EXPECT_EQ(take_off_emg_offsets(study_of(kind, 2), inputs).size(), told);
    EXPECT_EQ(inputs[1].emg->values(), bursts("SOL", 2, 0.06).values());
  }
}

TEST(EmgOffset, ADeadChannelElsewhereTellsNothing) {
  TimeSeries dead = bursts("SOL", 1, 0.0);
  dead = {dead.time_s(), dead.channels(), Eigen::VectorXd::Zero(dead.sample_count())};
  std::vector<TrialInput> inputs = inputs_of({dead, bursts("SOL", 2, 0.06)});
  EXPECT_TRUE(take_off_emg_offsets(study_of(EmgKind::envelope, 2), inputs).empty());
}

}  // namespace
}  // namespace myoid::study
