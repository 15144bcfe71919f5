#include "myoid/run/study_phases.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/random.h"
#include "myoid/ground/math/zero_phase.h"
#include "myoid/run/study_result.h"

#include "tests/support/elbow_study.h"

namespace myoid::run {
namespace {

constexpr double kTired_s = 36.0;
constexpr double kEmgRate_hz = 1000.0;

/// A minute of an elbow that swings; from 36 s on the muscles make three quarters of their force,
/// and the EMG's frequencies are a fifth lower.
struct Tiring {
  StudyResult result;

  explicit Tiring(double seconds = 60.0) {
    test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = seconds, .delay_s = 0.05});
    for (std::size_t k = 0; k < 4; ++k) study.data.muscles[k].start = study.truth[k];
    fit::TrialData& trial = study.data.trials[0];
    trial.velocity_radps = -trial.velocity_mps.col(0).cwiseQuotient(trial.moment_arm_m.col(0));
    for (Eigen::Index i = 0; i < trial.time_s.size(); ++i)
      trial.torque_nm[i] *= trial.time_s[i] > kTired_s ? 0.75 : 1.0;
    result.fit_input.data = study.data;
    result.trials.resize(1);
    result.trials[0].spec.name = trial.name;
  }
  [[nodiscard]] fit::TrialData& trial() { return result.fit_input.data.trials[0]; }

  /// Noise of each muscle below 150 Hz, then below 120 Hz.
  void record_emg() {
    const TimeSeries& activation = trial().activation;
    const double begin_s = activation.time_s()[0];
    const auto n = static_cast<Eigen::Index>(std::lround((activation.time_s().tail(1)[0] - begin_s) * kEmgRate_hz));
    const auto fresh = static_cast<Eigen::Index>(std::lround((kTired_s - begin_s) * kEmgRate_hz));
    math::Random random(11, 0);
    Eigen::MatrixXd volts(n, 4);
    for (Eigen::Index k = 0; k < 4; ++k) {
      Eigen::VectorXd noise(n);
      for (double& v : noise) v = 1e-4 * random.normal();
      const auto below = [&](double hz) {
        return math::zero_phase(math::design_butterworth(math::FilterBand::low_pass, 4, hz, kEmgRate_hz), noise);
      };
      volts.col(k) << below(150.0).head(fresh), below(120.0).tail(n - fresh);
    }
    recording::EmgStages& emg = result.trials[0].emg.stages.emplace();
    emg.raw = TimeSeries(clock(begin_s, n), channels(), volts);
  }
  /// After `record_emg`. What the envelope without whitening comes from: every muscle's activation
  /// as it was, on a carrier whose magnitude is 1.
  void keep_carrier() {
    const TimeSeries& activation = trial().activation;
    const double begin_s = activation.time_s()[0];
    const Eigen::Index step = 10;  // of the carrier per sample of the activation
    const Eigen::Index n = step * (activation.sample_count() - 1);
    Eigen::MatrixXd volts(n, 4);
    for (Eigen::Index i = 0; i < n; ++i) volts.row(i) = (i % 2 == 0 ? 1e-4 : -1e-4) * activation.values().row(i / step);
    result.trials[0].emg.stages.value().filtered = TimeSeries(clock(begin_s, n), channels(), volts);
    // Ten seconds in which nobody moves: the level of rest.
    TrialResult& rest = result.trials.emplace_back();
    rest.spec.name = "rest";
    recording::EmgStages& quiet = rest.emg.stages.emplace();
    quiet.raw = quiet.filtered = TimeSeries(clock(0.0, 10000), channels(), 1e-6 * volts.topRows(10000));
  }
  [[nodiscard]] const study::Phase* found(study::PhaseKind kind) {
    result.source.study.trials.resize(result.trials.size());
    fit::EstimatorOptions options;
    options.delay_s = 0.05;
    phases = study_phases(fit_source(result), result.fit_input.data, options);
    const auto& list = phases.at(0).phases;
    const auto it = std::find_if(list.begin(), list.end(), [&](const study::Phase& p) { return p.kind == kind; });
    return it == list.end() ? nullptr : &*it;
  }
  std::vector<study::TrialPhases> phases;

 private:
  static Eigen::VectorXd clock(double begin_s, Eigen::Index n) {
    return Eigen::VectorXd::LinSpaced(n, begin_s, begin_s + static_cast<double>(n - 1) / kEmgRate_hz);
  }
  [[nodiscard]] std::vector<Channel> channels() {
    std::vector<Channel> volts = trial().activation.channels();
    for (Channel& channel : volts) channel.unit = Unit::volt;
    return volts;
  }
};

TEST(StudyPhases, FatigueIsWhereTorqueAndFrequencyFall) {
  Tiring tiring;
  tiring.record_emg();
  const study::Phase* tired = tiring.found(study::PhaseKind::fatigued);
  ASSERT_NE(tired, nullptr);
  // A block is a swing or more, some 3 s.
  EXPECT_NEAR(tired->begin_s, kTired_s, 3.0);
  EXPECT_NEAR(tired->end_s, 60.0, 1e-9);
  EXPECT_NEAR(tired->gain.value_or(0.0), 0.75, 0.03);
  EXPECT_NEAR(tired->frequency.value_or(0.0), 0.8, 0.03);
  ASSERT_EQ(tiring.phases[0].trial, "trial1");
  EXPECT_EQ(tiring.phases[0].phases[0].kind, study::PhaseKind::regular);
}

TEST(StudyPhases, WithoutRawEmgTheTorqueAloneSpeaks) {
  Tiring tiring;
  const study::Phase* tired = tiring.found(study::PhaseKind::fatigued);
  ASSERT_NE(tired, nullptr);
  EXPECT_FALSE(tired->frequency);
  EXPECT_NEAR(tired->begin_s, kTired_s, 3.0);
}

TEST(StudyPhases, AreFoundWithoutTheWhiteningThatHidesFatigue) {
  // Whitened by the fresh muscle's filter, the envelope falls as the torque does.
  Tiring tiring;
  tiring.record_emg();
  tiring.keep_carrier();
  Eigen::MatrixXd whitened = tiring.trial().activation.values();
  for (Eigen::Index i = 0; i < whitened.rows(); ++i) {
    if (tiring.trial().activation.time_s()[i] > kTired_s) whitened.row(i) *= 0.75;
  }
  tiring.trial().activation =
      TimeSeries(tiring.trial().activation.time_s(), tiring.trial().activation.channels(), whitened);
  EXPECT_EQ(tiring.found(study::PhaseKind::fatigued), nullptr);
  tiring.result.emg.whitening.applied = true;
  const study::Phase* tired = tiring.found(study::PhaseKind::fatigued);
  ASSERT_NE(tired, nullptr);
  EXPECT_NEAR(tired->begin_s, kTired_s, 3.0);
  EXPECT_NEAR(tired->gain.value_or(0.0), 0.75, 0.05);
}

TEST(StudyPhases, AShortTrialHasOnePhase) {
  Tiring brief(15.0);
  EXPECT_NE(brief.found(study::PhaseKind::regular), nullptr);
  EXPECT_EQ(brief.phases[0].phases.size(), 1U);
}

std::vector<study::TrialPhases> phases_of_one_trial() {
  return {{"a",
           {{.kind = study::PhaseKind::isometric, .begin_s = 0.0, .end_s = 6.0},
            {.kind = study::PhaseKind::regular, .begin_s = 6.0, .end_s = 40.0},
            {.kind = study::PhaseKind::fatigued, .begin_s = 40.0, .end_s = 60.0, .frequency = 0.85}}}};
}

TEST(ExcludePhases, TakesWhatTheRuleNames) {
  fit::StudyData data;
  data.trials.resize(1);
  auto phases = phases_of_one_trial();
  exclude_phases({study::PhaseKind::isometric, study::PhaseKind::fatigued}, phases, data);
  ASSERT_EQ(data.trials[0].excluded.size(), 2u);
  EXPECT_EQ(data.trials[0].excluded[1].begin_s, 40.0);
  EXPECT_TRUE(phases[0].phases[0].excluded);
  EXPECT_FALSE(phases[0].phases[1].excluded);
}

TEST(ExcludePhases, KeepsFatigueThatOnlyTheTorqueShows) {
  fit::StudyData data;
  data.trials.resize(1);
  auto phases = phases_of_one_trial();
  phases[0].phases[2].frequency.reset();
  exclude_phases({study::PhaseKind::fatigued}, phases, data);
  EXPECT_TRUE(data.trials[0].excluded.empty());
}

}  // namespace
}  // namespace myoid::run
