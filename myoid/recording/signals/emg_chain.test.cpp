#include "myoid/recording/signals/emg_chain.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::recording {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// 3 s of rest and 7 s of effort at 1 kHz in two channels, with 50 Hz in the first.
TimeSeries recording_with_hum() {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(10000, 0.0, 9.999);
  Eigen::MatrixXd x(10000, 2);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    for (const Eigen::Index c : {0, 1}) x(i, c) = (i < 3000 ? 2e-6 : 1e-4) * normal(engine);
    x(i, 0) += 5e-5 * std::sin(2.0 * kPi * 50.0 * t[i]);
  }
  return {t, {{"left", Unit::volt}, {"right=TA", Unit::volt}}, x};
}

struct Processed {
  EmgChain chain;
  std::vector<std::string> lines;
};

Processed processed(const EnvelopeOptions& options, bool is_mvc) {
  EmgStages stages = clean_emg(recording_with_hum(), options);
  const EmgStages* one = &stages;
  const Whitening whitening = find_whitening(std::span(&one, 1), options);
  add_envelope(stages, options, whitening);
  const std::vector<TrialEnvelope> trials{{"press", is_mvc, &stages.envelope, {}}};
  Processed result{.chain = envelope_chain(std::span(&one, 1), options, whitening), .lines = {}};
  add_normalisation(find_normalisation(trials), {}, result.chain);
  result.lines = header_lines(result.chain);
  return result;
}

TEST(EmgChain, NamesEveryStepWithItsNumbers) {
  const auto lines = processed({.highpass_hz = 25.0, .lowpass_hz = 4.0}, true).lines;
  EXPECT_THAT(lines, Contains(HasSubstr("high-pass filter 25 Hz")));
  EXPECT_THAT(lines, Contains(HasSubstr("left at 50 Hz")));
  EXPECT_THAT(lines, Contains(HasSubstr("no whitening of any channel: the statistical bandwidth")));
  EXPECT_THAT(lines, Contains(HasSubstr("full-wave rectification")));
  EXPECT_THAT(lines, Contains(HasSubstr("low-pass filter 4 Hz")));
  EXPECT_THAT(lines, Contains(HasSubstr("from press at")));
  EXPECT_THAT(lines, Contains(HasSubstr("maximal voluntary contractions (MVC)")));
  // In a storage file's header, "key=value" would be read as a key.
  for (const std::string& line : lines) EXPECT_THAT(line, Not(HasSubstr("="))) << line;
  EXPECT_THAT(lines, Contains(HasSubstr("right:TA")));
}

TEST(EmgChain, SaysThatAStepIsLeftOut) {
  const auto lines = processed({.notch = false, .whitening = false}, false).lines;
  EXPECT_THAT(lines, Contains(HasSubstr("no notch filter: switched off")));
  EXPECT_THAT(lines, Contains(HasSubstr("no whitening of any channel: not asked for")));
  EXPECT_THAT(lines, Contains(HasSubstr("largest effort recorded")));
  EXPECT_THAT(lines, Not(Contains(HasSubstr("during maximal voluntary"))));
  const auto published = processed({.as_published = true}, false).lines;
  EXPECT_THAT(published, Contains(HasSubstr("no high-pass filter")));
  EXPECT_THAT(published, Contains(HasSubstr("-3 dB of one pass")));
}

TEST(EmgChain, EnvelopesWithoutAUnitAreNoVolts) {
  const TimeSeries volts = clean_emg(recording_with_hum(), {}).filtered;
  for (const Unit unit : {Unit::volt, Unit::dimensionless}) {
    std::vector<Channel> channels = volts.channels();
    for (Channel& c : channels) c.unit = unit;
    const TimeSeries envelope(volts.time_s(), channels, volts.values().cwiseAbs());
    const std::vector<TrialEnvelope> trials{{"walk", false, &envelope, {}}};
    EmgChain chain;
    add_normalisation(find_normalisation(trials), {}, chain);
    const auto with_volts = testing::ContainsRegex("reference [^ ]+ V, .*; rest [^ ]+ V");
    if (unit == Unit::volt) {
      EXPECT_THAT(chain.steps, Contains(with_volts));
    } else {
      EXPECT_THAT(chain.steps, Not(Contains(HasSubstr(" V")))) << chain.steps.back();
    }
  }
}

TEST(EmgChain, AskedForWhitensAllChannels) {
  const Processed one = processed({.whitening = true}, true);
  EXPECT_THAT(one.lines, Contains(HasSubstr("whitening of all channels and trials: asked for")));
  EXPECT_THAT(one.chain.methods, Contains(HasSubstr("was whitened")));
  EXPECT_TRUE(header_lines({}).empty());
}

}  // namespace
}  // namespace myoid::recording
