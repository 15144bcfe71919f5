// EMG that begins or ends at full effort, as in maximal contractions and treadmill trials.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/zero_phase.h"
#include "myoid/recording/signals/emg_envelope.h"

namespace myoid::recording {
namespace {

constexpr double kEdgeRate_hz = 2000.0;
constexpr Eigen::Index kEdgeSamples = 20000;  // 10 s
constexpr int kEdgeSeeds = 40;

enum class Held { first_seven_seconds, last_seven_seconds, throughout };

/// Noise of 150 uV between 20 and 450 Hz, a tenth of it outside of the effort, cut out of a longer
/// signal, so that its ends are like any other sample.
Eigen::VectorXd held_effort(Held held, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  constexpr Eigen::Index kMargin = 4000;
  Eigen::VectorXd x(kEdgeSamples + 2 * kMargin);
  for (double& v : x) v = normal(engine);
  const auto pass = [&](math::FilterBand band, double hz) {
    x = math::zero_phase(math::design_butterworth(band, 2, hz, kEdgeRate_hz), x);
  };
  pass(math::FilterBand::high_pass, 20.0);
  pass(math::FilterBand::low_pass, 450.0);
  Eigen::VectorXd emg = x.segment(kMargin, kEdgeSamples);
  emg *= 150e-6 / std::sqrt(emg.squaredNorm() / static_cast<double>(kEdgeSamples));
  if (held == Held::first_seven_seconds) emg.tail(6000) *= 0.1;
  if (held == Held::last_seven_seconds) emg.head(6000) *= 0.1;
  return emg;
}

struct Reading {
  double greatest = 0.0, plateau = 0.0;
};

Reading read_effort(Held held, const Eigen::VectorXd& emg, const EnvelopeOptions& options) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(kEdgeSamples, 0.0, (kEdgeSamples - 1) / kEdgeRate_hz);
  const EmgStages stages = process_emg(TimeSeries(t, {{"m", Unit::volt}}, emg), options);
  const std::vector<TrialEnvelope> trials{{"a", true, &stages.envelope, stages.bandwidth_hz}};
  const Eigen::VectorXd a = normalise(stages.envelope, find_normalisation(trials)).values().col(0);
  const Eigen::Index begin = held == Held::last_seven_seconds ? 6000 : 0;
  const Eigen::Index end = held == Held::first_seven_seconds ? 14000 : kEdgeSamples;
  return {a.maxCoeff(), a.segment(begin, end - begin).mean()};
}

constexpr Held kHeld[] = {Held::first_seven_seconds, Held::last_seven_seconds, Held::throughout};

TEST(EmgEdges, AnEffortAtTheFirstOrLastSampleReadsAsItDoesInside) {
  // Whitened noise of 700 Hz spreads by 7 %, at an end by 10 %: of 7 s, three seeds in a thousand come to 1.3.
  for (const Held held : kHeld) {
    for (unsigned seed = 1; seed <= kEdgeSeeds; ++seed) {
      const Reading found = read_effort(held, held_effort(held, seed), {});
      EXPECT_LT(found.greatest, 1.3) << static_cast<int>(held) << ' ' << seed;
      EXPECT_NEAR(found.plateau, 1.0, 0.05) << static_cast<int>(held) << ' ' << seed;
    }
  }
}

TEST(EmgEdges, SoItDoesInMainsHumWithANotch) {
  for (const Held held : kHeld) {
    for (unsigned seed = 1; seed <= kEdgeSeeds; ++seed) {
      Eigen::VectorXd emg = held_effort(held, seed);
      for (Eigen::Index i = 0; i < emg.size(); ++i)  // the mains are never at 50 Hz to the dot
        emg[i] += 1e-4 * std::sin(2.0 * kPi * 50.02 * static_cast<double>(i) / kEdgeRate_hz + seed);
      const Reading found = read_effort(held, emg, {});
      EXPECT_LT(found.greatest, 1.3) << static_cast<int>(held) << ' ' << seed;
      EXPECT_NEAR(found.plateau, 1.0, 0.05) << static_cast<int>(held) << ' ' << seed;
    }
  }
}

TEST(EmgEdges, NotWhitenedTheEndsAreNoWorseThanTheInside) {
  // 430 Hz spread by 9 to 10 %, at an end by 13 %: the greatest of 40 x 7 s is 1.43, inside.
  for (const bool published : {false, true}) {
    for (const Held held : kHeld) {
      for (unsigned seed = 1; seed <= kEdgeSeeds; ++seed) {
        const Reading found =
            read_effort(held, held_effort(held, seed), {.whitening = false, .as_published = published});
        EXPECT_LT(found.greatest, 1.5) << static_cast<int>(held) << ' ' << seed;
        EXPECT_NEAR(found.plateau, 1.0, 0.05) << static_cast<int>(held) << ' ' << seed;
      }
    }
  }
}

TEST(EmgEdges, AnOffsetAndADriftOfTheBaselineDoNotComeBackAtTheEnds) {
  // 5 mV and 2 mV/s, as of an electrode that settles, on 150 uV.
  for (const Held held : kHeld) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Eigen::VectorXd emg = held_effort(held, seed);
      for (Eigen::Index i = 0; i < emg.size(); ++i) emg[i] += 5e-3 + 2e-3 * static_cast<double>(i) / kEdgeRate_hz;
      const Reading found = read_effort(held, emg, {});
      EXPECT_LT(found.greatest, 1.3) << static_cast<int>(held) << ' ' << seed;
      EXPECT_NEAR(found.plateau, 1.0, 0.05) << static_cast<int>(held) << ' ' << seed;
    }
  }
}

}  // namespace
}  // namespace myoid::recording
