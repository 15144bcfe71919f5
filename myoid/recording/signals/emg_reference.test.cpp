#include "myoid/recording/signals/emg_reference.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/remark.h"
#include "myoid/recording/signals/emg_levels.h"

namespace myoid::recording {
namespace {

constexpr double kEnvelopeRate_hz = 1000.0;
constexpr double kRest_v = 2e-6;

/// A piece of an envelope: seconds and level [V].
using Piece = std::pair<double, double>;

TimeSeries envelope_of(const std::vector<Piece>& pieces) {
  std::vector<double> x;
  for (const auto& [seconds, level_v] : pieces)
    x.insert(x.end(), static_cast<std::size_t>(std::lround(seconds * kEnvelopeRate_hz)), level_v);
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::MatrixXd values = Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  return {
      Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / kEnvelopeRate_hz), {{"BIC", Unit::volt}}, values};
}

/// Twenty seconds with two efforts of 1.5 s at this level.
std::vector<Piece> efforts(double level_v) {
  return {{4.0, kRest_v}, {1.5, level_v}, {5.0, kRest_v}, {1.5, 0.9 * level_v}, {8.0, kRest_v}};
}

std::vector<Piece> with_start(double seconds, double level_v, double effort_v) {
  std::vector<Piece> pieces = efforts(effort_v);
  pieces.front().first -= seconds;
  pieces.insert(pieces.begin(), {seconds, level_v});
  return pieces;
}

TEST(EmgReference, ASwitchOnArtifactIsNoReferenceAndIsNamed) {
  // 0.2 s of 1.9 mV: the half second has a mean of 0.76 mV, 7.6 times the effort of 0.1 mV, which would read 0.13.
  const TimeSeries e = envelope_of(with_start(0.2, 1.9e-3, 1e-4));
  const std::vector<TrialEnvelope> trials{{"lift", false, &e}};
  const ChannelNormalisation n = find_normalisation(trials)[0];
  EXPECT_NEAR(n.reference_v, 1e-4, 0.02e-4);
  EXPECT_NEAR(n.source_time_s, 4.25, 0.6);
  const std::vector<Remark> remarks = check_emg_levels(trials);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0].code, RemarkCode::emg_over_reference);
  EXPECT_EQ(remarks[0].severity, Severity::warning);
  EXPECT_EQ(remarks[0].about, "BIC");
  EXPECT_NEAR(*remarks[0].value, (0.2 * 1.9e-3 + 0.3 * kRest_v) / (0.5 * 1e-4), 0.1);
  EXPECT_EQ(remarks[0].when->begin_s, 0.0);
}

TEST(EmgReference, ArtifactsAtTheEndsOfAllRecordingsDoNotConfirmEachOther) {
  const TimeSeries one = envelope_of(with_start(0.2, 6e-4, 1e-4)), two = envelope_of(with_start(0.2, 5e-4, 8e-5));
  const std::vector<TrialEnvelope> trials{{"one", false, &one}, {"two", true, &two}};
  EXPECT_NEAR(find_normalisation(trials)[0].reference_v, 1e-4, 0.02e-4);
  EXPECT_EQ(lone_peaks(trials, "BIC").size(), 2U);
}

TEST(EmgReference, APulledCableAmidARecordingIsNoReference) {
  std::vector<Piece> pieces = efforts(1e-4);
  pieces[2] = {2.0, kRest_v};
  pieces.insert(pieces.begin() + 3, {{0.3, 1e-3}, {2.7, kRest_v}});
  const TimeSeries e = envelope_of(pieces);
  const std::vector<TrialEnvelope> trials{{"lift", true, &e}};
  EXPECT_NEAR(find_normalisation(trials)[0].reference_v, 1e-4, 0.02e-4);
  const std::vector<LonePeak> found = lone_peaks(trials, "BIC");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].at_end);
  EXPECT_TRUE(found[0].replaced);
  EXPECT_LE(found[0].begin_s, 7.51);
  EXPECT_GE(found[0].end_s, 7.79);
}

TEST(EmgReference, AnEffortThatLastsOrComesAgainIsConfirmed) {
  // A contraction of 1.2 s that is five times the movements; an effort that lasts to the end; bursts of 0.3 s.
  const TimeSeries task = envelope_of(efforts(2e-5));
  const TimeSeries mvc = envelope_of({{2.0, kRest_v}, {1.2, 1e-4}, {2.0, kRest_v}});
  const TimeSeries to_the_end = envelope_of({{4.0, kRest_v}, {1.5, 1e-4}});
  const TimeSeries cycle = envelope_of({{0.25, 1e-4}, {0.6, kRest_v}, {0.25, 1e-4}});
  std::vector<Piece> bursts;
  for (int i = 0; i < 10; ++i) bursts.insert(bursts.end(), {{0.3, 1e-4}, {0.8, kRest_v}});
  const TimeSeries walk = envelope_of(bursts);
  for (const TimeSeries* second : {&mvc, &to_the_end, &walk}) {
    const std::vector<TrialEnvelope> trials{{"task", false, &task}, {"second", true, second}};
    EXPECT_TRUE(lone_peaks(trials, "BIC").empty());
    EXPECT_EQ(find_normalisation(trials)[0].source_trial, "second");
  }
  const std::vector<TrialEnvelope> cut{{"stride", false, &cycle}, {"next", false, &cycle}};
  EXPECT_TRUE(lone_peaks(cut, "BIC").empty());
}

TEST(EmgReference, TheOnlyEffortServesUnconfirmed) {
  const TimeSeries e = envelope_of({{4.0, kRest_v}, {0.4, 1e-4}, {5.0, kRest_v}});
  const std::vector<TrialEnvelope> trials{{"throw", false, &e}};
  const std::vector<LonePeak> found = lone_peaks(trials, "BIC");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].replaced);
  EXPECT_NEAR(find_normalisation(trials)[0].reference_v, 0.8e-4, 0.05e-4);
  EXPECT_EQ(check_emg_levels(trials).size(), 1U);
}

}  // namespace
}  // namespace myoid::recording
