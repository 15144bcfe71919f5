#include "myoid/fit/posterior/drive.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "myoid/ground/math/random.h"

namespace myoid::fit {
namespace {

constexpr double kCutoff_hz = 6.0, kRate_hz = 100.0;

/// A drive and its envelope: times 1 + white noise behind the filter.
struct MadeEnvelope {
  Eigen::VectorXd time, drive, values;
};

MadeEnvelope envelope_of(const std::function<double(double)>& drive,
                         double noise_sd,
                         double seconds,
                         std::uint64_t seed) {
  const auto n = static_cast<Eigen::Index>(seconds * kRate_hz) + 1;
  MadeEnvelope r{Eigen::VectorXd::LinSpaced(n, 0.0, seconds), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  math::Random random(seed);
  const Eigen::VectorXd h = EnvelopeError(kCutoff_hz, {0.0, 0.0}).from_white(1.0 / kRate_hz);
  const Eigen::Index reach = h.size() / 2;
  Eigen::VectorXd white(n + 2 * reach);
  for (Eigen::Index i = 0; i < white.size(); ++i)
    white[i] = random.normal() * drive(static_cast<double>(i - reach) / kRate_hz);
  for (Eigen::Index i = 0; i < n; ++i) {
    r.drive[i] = drive(r.time[i]);
    r.values[i] = std::max(0.0, r.drive[i] + noise_sd * h.dot(white.segment(i, h.size())));
  }
  return r;
}

/// A drive of sines below 1.5 Hz.
MadeEnvelope made_envelope(double noise_sd, double seconds = 20.0, double middle_hz = 0.6) {
  const auto drive = [&](double t) {
    return 0.3 * (1.0 + 0.5 * std::sin(2.0 * std::numbers::pi * middle_hz * t) +
                  0.3 * std::sin(2.0 * std::numbers::pi * 1.3 * t + 1.0));
  };
  return envelope_of(drive, noise_sd, seconds, 5);
}

/// Root mean square of the relative error, two seconds from the ends.
double error_of(const MadeEnvelope& of, const Envelope& envelope) {
  double sum = 0.0, count = 0.0;
  for (Eigen::Index i = 0; i < of.time.size(); ++i) {
    if (of.time[i] < 2.0 || of.time[i] > of.time[of.time.size() - 1] - 2.0) continue;
    sum += std::pow(envelope.at(of.time[i]).value / of.drive[i] - 1.0, 2);
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

TEST(Drive, OfAnEnvelopeThatNeverChangesIsTheEnvelope) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(2001, 0.0, 20.0);
  for (const double level : {0.0, 0.05}) {
    const Envelope envelope(time, Eigen::VectorXd::Constant(2001, level));
    const EnvelopeError error(kCutoff_hz, {0.0, 0.0});
    const Drive drive = drive_behind(envelope, 0.15, 0.0, error, kCutoff_hz);
    EXPECT_EQ(drive.envelope.at(7.3).value, level);
    EXPECT_EQ(drive.left.minCoeff(), 1.0);
  }
}

TEST(DriveMemory, FindsADriveOnceForEachEnvelopeAndNoise) {
  const MadeEnvelope of = made_envelope(0.15);
  const EnvelopeError error(kCutoff_hz, {0.0, 0.0});
  Eigen::MatrixXd both(of.time.size(), 2);
  both << of.values, of.drive;
  const TimeSeries series(of.time, {{.name = "BIC"}, {.name = "TRI"}}, both);
  DriveMemory memory;
  const auto first = memory.behind(series, "BIC", 0.15, 0.0, error, kCutoff_hz);
  EXPECT_EQ(memory.behind(series, "BIC", 0.15, 0.0, error, kCutoff_hz), first);
  EXPECT_NE(memory.behind(series, "BIC", 0.2, 0.0, error, kCutoff_hz), first);
  EXPECT_NE(memory.behind(series, "TRI", 0.15, 0.0, error, kCutoff_hz), first);
  const Drive alone = drive_behind(Envelope(of.time, of.values), 0.15, 0.0, error, kCutoff_hz);
  EXPECT_EQ(first->left, alone.left);
  EXPECT_EQ(first->envelope.at(7.3).value, alone.envelope.at(7.3).value);
}

TEST(Drive, IsNearerThanTheEnvelopeAndKnowsItsError) {
  for (const double noise_sd : {0.1, 0.15, 0.25}) {
    const MadeEnvelope of = made_envelope(noise_sd);
    const EnvelopeError error(kCutoff_hz, {0.0, 0.0});
    const Envelope envelope(of.time, of.values);
    const Drive drive = drive_behind(envelope, noise_sd, 0.0, error, kCutoff_hz);
    EXPECT_LT(error_of(of, drive.envelope), 0.75 * error_of(of, envelope)) << noise_sd;
    const double said = noise_sd * std::sqrt(error.behind(drive.left).share());
    EXPECT_NEAR(said / error_of(of, drive.envelope), 1.0, 0.3) << noise_sd;
  }
}

TEST(Drive, OfBurstsIsAsLargeAsTheBursts) {
  // A lift every four seconds. Over 20 recordings chance moves the size by 0.4 %.
  const auto bursts = [](double t) { return 0.02 + 0.8 * std::exp(-std::pow((std::fmod(t, 4.0) - 2.0) / 0.4, 2)); };
  const EnvelopeError error(kCutoff_hz, {0.0, 0.0});
  for (const double noise_sd : {0.1, 0.2}) {
    double along = 0.0, size = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const MadeEnvelope of = envelope_of(bursts, noise_sd, 20.0, seed);
      const Drive drive = drive_behind(Envelope(of.time, of.values), noise_sd, 0.0, error, kCutoff_hz);
      for (Eigen::Index i = 0; i < of.time.size(); ++i) {
        const double found = drive.envelope.at(of.time[i]).value;
        along += found * of.drive[i];
        size += found * found;
      }
    }
    EXPECT_NEAR(along / size, 1.0, 0.01) << noise_sd;
  }
}

/// The error that is expected of a planned movement is the error that its recording leaves.
TEST(Drive, OfACleanEnvelopeIsTheEnvelopeAndItsErrorThatOfARecording) {
  for (const double noise_sd : {0.1, 0.15, 0.25}) {
    const MadeEnvelope of = made_envelope(noise_sd);
    const EnvelopeError error(kCutoff_hz, {0.0, 0.0});
    const Envelope clean(of.time, of.drive);
    const Drive planned = drive_of_clean(clean, noise_sd, 0.0, error, kCutoff_hz, 1.0);
    EXPECT_EQ(planned.envelope.samples(), of.drive);
    const Drive found = drive_behind(Envelope(of.time, of.values), noise_sd, 0.0, error, kCutoff_hz);
    const double said = noise_sd * std::sqrt(error.behind(planned.left).share());
    EXPECT_NEAR(said / error_of(of, found.envelope), 1.0, 0.3) << noise_sd;
    // Twice the noise leaves more of its power, and less than twice.
    const double more = error.behind(drive_of_clean(clean, noise_sd, 0.0, error, kCutoff_hz, 2.0).left).share(),
                 less = error.behind(planned.left).share();
    EXPECT_GT(more, less) << noise_sd;
    EXPECT_LT(more, 2.0 * less) << noise_sd;
  }
}

TEST(Drive, ASmoothEnvelopeIsLeftAlone) {
  // The noise is believed to be there, and is not: it is lowered to what is recorded.
  const MadeEnvelope of = made_envelope(0.0);
  const EnvelopeError error(kCutoff_hz, {0.0, 0.0});
  const Drive drive = drive_behind(Envelope(of.time, of.values), 0.15, 0.0, error, kCutoff_hz);
  EXPECT_LT(error_of(of, drive.envelope), 0.03);
}

TEST(Drive, WithoutNoiseOrOfAShortRecordingItIsTheEnvelope) {
  const MadeEnvelope of = made_envelope(0.1, 1.0);
  const EnvelopeError error(kCutoff_hz, {0.0, 0.0});
  const Envelope envelope(of.time, of.values);
  for (const double noise_sd : {0.0, 0.1}) {
    const Drive drive = drive_behind(envelope, noise_sd, 0.0, error, kCutoff_hz);
    EXPECT_EQ(drive.envelope.samples(), of.values);
    EXPECT_EQ(drive.left, Eigen::VectorXd::Ones(drive.left.size()));
  }
}

TEST(NoiseOverEnvelope, IsThatOfTheStandardDeviationAndHasItsSlope) {
  constexpr double kSd = 0.15, kRest = 0.02, kLeast = 1e-4 * kRest;
  for (const double u : {1e-7, kLeast, 1e-4, 0.003, 0.0077, 0.0078, 0.05, 0.8}) {
    const NoiseOverEnvelope noise = noise_over_envelope(u, kSd, kRest);
    EXPECT_NEAR(noise.value, envelope_sd_at(u, kSd, kRest) / (kSd * std::sqrt(u * u + kLeast * kLeast)),
                1e-12 * noise.value);
    const double h = 1e-7 * u;
    const double slope =
        (noise_over_envelope(u + h, kSd, kRest).value - noise_over_envelope(u - h, kSd, kRest).value) / (2.0 * h);
    EXPECT_NEAR(noise.slope, slope, 1e-5 * (1.0 + std::abs(slope)));
  }
  // The slope has no jump where chance makes u, nor at the least drive: over a millionth of u it
  // changes by a few millionths. A jump would end a search for the mode.
  for (const double at : {kRest * std::sqrt(kSd), kLeast}) {
    const double below = noise_over_envelope(at * (1.0 - 1e-6), kSd, kRest).slope,
                 above = noise_over_envelope(at * (1.0 + 1e-6), kSd, kRest).slope;
    EXPECT_NEAR(above / below, 1.0, 1e-5);
  }
  // Without rest the noise is in proportion.
  EXPECT_EQ(noise_over_envelope(0.1, kSd, 0.0).value, 1.0);
}

}  // namespace
}  // namespace myoid::fit
