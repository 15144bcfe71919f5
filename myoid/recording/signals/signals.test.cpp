#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/butterworth.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/filter.h"

namespace myoid::recording {
namespace {

constexpr double kRate_hz = 1000.0;

/// White Gaussian noise (sum of twelve uniform numbers) of this standard deviation.
TimeSeries gaussian(Eigen::Index n, double sd_v, double offset_v = 0.0) {
  std::mt19937_64 engine(42);
  Eigen::MatrixXd x(n, 1);
  for (double& v : x.reshaped()) {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(engine() >> 11) * 0x1.0p-53;
    v = offset_v + sd_v * sum;
  }
  return {Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / kRate_hz), {{"m", Unit::volt}}, x};
}

TEST(ProcessEmg, OfGaussianNoiseTheEnvelopeIsItsMeanAbsoluteValue) {
  const EmgStages s = process_emg(gaussian(60000, 1e-4, 5e-4), {.highpass_hz = 1.0});
  // E|x| = sd sqrt(2/pi); the mean over 60 s of white noise at 1 kHz is good to 0.76/sqrt(60000) =
  // 0.3 %.
  EXPECT_NEAR(s.envelope.values().mean(), 1e-4 * std::sqrt(2.0 / M_PI), 0.01 * 1e-4);
}

TEST(ProcessEmg, TheEnvelopesSpreadIsThatOfRectifiedNoiseInItsBand) {
  const EmgStages s = process_emg(gaussian(120000, 1e-4), {.highpass_hz = 1.0});
  const Eigen::VectorXd e = s.envelope.values().col(0).segment(2000, 116000);
  const double cv = std::sqrt((e.array() - e.mean()).square().mean()) / e.mean();
  // White at 1 kHz: variance of the rectified noise times integral of the filter's power gain over half the rate.
  double integral = 0.0;
  const double design = math::two_pass_cutoff_hz(math::FilterBand::low_pass, 2, 6.0, kRate_hz);
  const auto sections = math::design_butterworth(math::FilterBand::low_pass, 2, design, kRate_hz);
  for (double f = 0.05; f < 500.0; f += 0.1) integral += 0.1 * std::pow(math::gain(sections, f, kRate_hz), 4);
  const double expected = std::sqrt((M_PI / 2.0 - 1.0) * integral / 500.0);
  EXPECT_NEAR(cv, expected, 0.08 * expected);  // some 1400 independent samples: 2 % and the tails
}

TEST(ProcessEmg, IsProportionalToTheEmg) {
  const TimeSeries one = gaussian(4000, 1e-4);
  const TimeSeries two(one.time_s(), one.channels(), 2.0 * one.values());
  EXPECT_LT((process_emg(two).envelope.values() - 2.0 * process_emg(one).envelope.values()).cwiseAbs().maxCoeff(),
            1e-15);
}

TEST(ProcessEmg, TakesMainsHumOutAndLeavesItsReportToTheCheckOfTheRawEmg) {
  TimeSeries x = gaussian(10000, 1e-5);
  Eigen::MatrixXd v = x.values();
  for (Eigen::Index i = 0; i < v.rows(); ++i) v(i, 0) += 2e-5 * std::sin(2.0 * M_PI * 50.0 * x.time_s()[i]);
  const EmgStages s = process_emg({x.time_s(), x.channels(), v});
  ASSERT_EQ(s.notches.size(), 1U);
  EXPECT_EQ(s.notches[0].lines_hz, std::vector<double>{50.0});
  EXPECT_TRUE(s.findings.empty()) << s.findings[0].says;
  EXPECT_TRUE(process_emg(x).notches.empty());
}

TEST(ProcessEmg, AnEnvelopeThatWouldBeNegativeIsSaid) {
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(4000, 1);
  x.middleRows(2000, 30).setConstant(1e-3);  // a burst: the low-pass rings below 0 on both sides
  const EmgStages s = process_emg({Eigen::VectorXd::LinSpaced(4000, 0.0, 3.999), {{"m", Unit::volt}}, x},
                                  {.highpass_hz = 1.0, .lowpass_hz = 20.0, .rectify = false});
  ASSERT_EQ(s.findings.size(), 1U);
  EXPECT_NE(s.findings[0].says.find("undershoots"), std::string::npos);
  EXPECT_EQ(s.envelope.values().minCoeff(), 0.0);
}

TEST(ProcessEmg, RefusesForcesForEmg) {
  const TimeSeries x = gaussian(1000, 1.0);
  EXPECT_THROW((void)process_emg({x.time_s(), {{"m", Unit::newton}}, x.values()}), InvalidInput);
}

TEST(ZeroPhaseFilter, AsPublishedItsRealCutOffIsBelowTheNominalOne) {
  // Designed at 6 Hz for one pass, two passes have -3 dB at 4.81 Hz.
  Eigen::MatrixXd x(8000, 1);
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(8000, 0.0, 7.999);
  for (Eigen::Index i = 0; i < 8000; ++i) x(i, 0) = std::sin(2.0 * M_PI * 4.81 * t[i]);
  const TimeSeries y = zero_phase_filter({t, {{"x"}}, x}, math::FilterBand::low_pass, 6.0, {.corrected = false});
  const double gain = y.values().col(0).segment(2000, 4000).dot(x.col(0).segment(2000, 4000)) /
                      x.col(0).segment(2000, 4000).squaredNorm();
  EXPECT_NEAR(gain, std::sqrt(0.5), 0.003);
}

TEST(ZeroPhaseFilter, RefusesAHoleInTheClock) {
  Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(100, 0.0, 0.99);
  t.tail(50).array() += 1.0;
  EXPECT_THROW((void)zero_phase_filter({t, {{"x"}}, Eigen::MatrixXd::Zero(100, 1)}, math::FilterBand::low_pass, 6.0),
               InvalidInput);
}

TimeSeries steps(std::initializer_list<double> levels) {
  Eigen::MatrixXd x(static_cast<Eigen::Index>(levels.size()) * 2000, 1);
  Eigen::Index row = 0;
  for (const double level : levels) {
    x.middleRows(row, 2000).setConstant(level);
    row += 2000;
  }
  return {
      Eigen::VectorXd::LinSpaced(x.rows(), 0.0, static_cast<double>(x.rows() - 1) / kRate_hz), {{"m", Unit::volt}}, x};
}

TEST(Normalisation, TakesTheMaximumOverTheStudyAndSaysWhereItStood) {
  const TimeSeries task = steps({1e-6, 2e-5, 1e-6});
  const TimeSeries mvc = steps({1e-6, 1.01e-4});
  const std::vector<TrialEnvelope> trials{{"task", false, &task}, {"mvc", true, &mvc}};
  const auto n = find_normalisation(trials);
  EXPECT_EQ(n[0].source_trial, "mvc");
  EXPECT_TRUE(n[0].from_mvc);
  // Seconds that reach slightly into the effort count if chance could explain their mean: some in thousands.
  EXPECT_NEAR(n[0].resting_level_v, 1e-6, 1e-9);
  // Powers add: 101^2 - 1 and 20^2 - 1, in millionths of a volt squared.
  // Windows that reach out of the effort by less than 1.5 spreads of 6 % count: 9 % of half a
  // second on one side of 1.5 s.
  EXPECT_NEAR(n[0].reference_v / (std::sqrt(10200.0) * 1e-6), 1.0, 2e-3);
  EXPECT_LT(n[0].reference_v, std::sqrt(10200.0) * 1e-6);
  EXPECT_NEAR(normalise(task, n).values()(3000, 0), std::sqrt(399.0) * 1e-6 / n[0].reference_v, 1e-5);
  EXPECT_EQ(normalise(task, n).values()(0, 0), 0.0);
}

TEST(Normalisation, FindsTheActivationUnderTheNoiseOfTheElectrode) {
  // Gaussian EMG of known amplitude and independent noise: the result is the amplitude. Means of 20
  // s at 1 kHz, white up to the filters' 20 Hz: 0.7555 / sqrt(2 x 480 Hz x 20 s) = 0.5 % of each
  // mean; there are four of them, and the means of rest and reference.
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  const Eigen::Index n = 60000;
  Eigen::MatrixXd x(n, 1);
  const auto amplitude = [n](Eigen::Index k) { return 3 * k < n ? 0.0 : 3 * k < 2 * n ? 0.05 : 1.0; };
  for (Eigen::Index k = 0; k < n; ++k) x(k, 0) = 1e-3 * (amplitude(k) * normal(engine) + 0.03 * normal(engine));
  const TimeSeries raw(Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / 1000.0), {{"m", Unit::volt}}, x);
  const TimeSeries envelope = process_emg(raw).envelope;
  const std::vector<TrialEnvelope> trials{{"a", true, &envelope}};
  const auto found = find_normalisation(trials, {.window_s = 10.0});
  const Eigen::VectorXd activation = normalise(envelope, found).values().col(0);
  // The spread of the envelope (14 %) bends the root by 1 %.
  EXPECT_NEAR(activation.segment(n / 3 + 1000, n / 3 - 2000).mean(), 0.05, 0.0012);
}

TEST(Normalisation, TheLowestOfManyNoisySecondsIsNotTaken) {
  // Rest for 200 s, an effort of 10 s. One second's mean of white noise from 20 to 500 Hz spreads
  // by 0.7555 / sqrt(2 x 480 Hz x 1 s) = 2.4 %, so that the lowest of 200 is 6 % low; the mean of
  // all is known to 0.2 %, and taking those below two spreads makes it 0.1 % lower.
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd x(210000, 1);
  for (Eigen::Index k = 0; k < x.rows(); ++k) x(k, 0) = (k < 200000 ? 3e-5 : 1e-3) * normal(engine);
  const EmgStages emg = process_emg(
      TimeSeries(Eigen::VectorXd::LinSpaced(x.rows(), 0.0, 209.999), {{"m", Unit::volt}}, x), {.whitening = false});
  const std::vector<TrialEnvelope> trials{{"a", true, &emg.envelope, emg.bandwidth_hz}};
  const auto found = find_normalisation(trials, {.window_s = 4.0});
  const double truth = emg.envelope.values().col(0).segment(1000, 198000).mean();
  EXPECT_NEAR(found[0].resting_level_v / truth, 1.0, 0.005);
  // At rest the root of the part that chance leaves above: 0.4 sqrt(2 x 0.08) of the noise.
  const Eigen::VectorXd activation = normalise(emg.envelope, found).values().col(0);
  EXPECT_LT(activation.segment(1000, 198000).mean(), 0.2 * 0.03);
}

TEST(Normalisation, BetweenTheBurstsOfAWalkTheMuscleRests) {
  // Bursts of 0.3 s every 1.1 s for a minute: no second is without one. Noise of 5 uV between them;
  // a pause's mean of white noise from 20 to 500 Hz spreads by 0.7555 / sqrt(2 x 480 Hz x 0.2 s)
  // = 5.5 %, and the mean of the lowest pauses lies a few per cent below the noise's.
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd x(60000, 1);
  for (Eigen::Index k = 0; k < x.rows(); ++k) x(k, 0) = (k % 1100 < 300 ? 1e-4 : 5e-6) * normal(engine);
  const EmgStages emg = process_emg(
      TimeSeries(Eigen::VectorXd::LinSpaced(x.rows(), 0.0, 59.999), {{"m", Unit::volt}}, x), {.whitening = false});
  const std::vector<TrialEnvelope> trials{{"walk", false, &emg.envelope, emg.bandwidth_hz}};
  const ChannelNormalisation n = find_normalisation(trials)[0];
  EXPECT_TRUE(n.rests);
  EXPECT_NEAR(n.resting_level_v / (5e-6 * std::sqrt(2.0 / kPi) * std::sqrt(0.96)), 1.0, 0.1);
}

TEST(Normalisation, AWindowLongerThanEveryRecordingIsRefused) {
  const TimeSeries task = steps({1e-6, 2e-5, 1e-6});  // 6 s
  const TimeSeries mvc = steps({1e-6, 1.01e-4});      // 4 s
  const std::vector<TrialEnvelope> trials{{"task", false, &task}, {"mvc", true, &mvc}};
  EXPECT_THROW((void)find_normalisation(trials, {.window_s = 100.0}), InvalidInput);
  // Between the two lengths, only the longer trial can have such a mean.
  EXPECT_EQ(find_normalisation(trials, {.window_s = 5.0})[0].source_trial, "task");
}

TEST(Normalisation, OfAnEffortThatIsHeldTheReferenceIsItsLevel) {
  // Gaussian noise of constant strength for 20 s; windows of 0.5 s. The true mean is sqrt(2 / pi),
  // of white noise above 20 Hz with 0.96 of the power. The largest of the means is 7 % above it.
  constexpr int kRecordings = 20;
  for (unsigned seed = 1; seed <= kRecordings; ++seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd x(20000, 1);
    for (double& v : x.reshaped()) v = 1e-3 * normal(engine);
    const EmgStages emg =
        process_emg(TimeSeries(Eigen::VectorXd::LinSpaced(20000, 0.0, 19.999), {{"m", Unit::volt}}, x));
    const std::vector<TrialEnvelope> trials{{"a", true, &emg.envelope, emg.bandwidth_hz}};
    const ChannelNormalisation n = find_normalisation(trials)[0];
    // The muscle never rests, so nothing is subtracted.
    EXPECT_FALSE(n.rests);
    EXPECT_EQ(n.resting_level_v, 0.0);
    // 20 s of 480 Hz: 0.5 %; leaving out a fifth of the windows costs as much again.
    EXPECT_NEAR(n.reference_v / (1e-3 * std::sqrt(2.0 / kPi) * std::sqrt(0.96)), 1.0, 0.02) << seed;
    EXPECT_LT(n.relative_sd, 0.01);
  }
}

TEST(Normalisation, RefusesAChannelThatNeverMoves) {
  for (const double level : {1e-6, 0.0}) {
    const TimeSeries flat = steps({level, level});
    const std::vector<TrialEnvelope> trials{{"a", false, &flat}};
    try {
      (void)find_normalisation(trials);
      FAIL() << level;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("electrode"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace myoid::recording
