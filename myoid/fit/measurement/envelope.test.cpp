#include "myoid/fit/measurement/envelope.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

TEST(Envelope, ReadsTheSameHoweverItsPiecesLie) {
  Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(200, -1.0, 0.99);
  const auto u = [](double at) { return 1.0 + std::sin(9.0 * at) + 0.3 * std::cos(23.0 * at); };
  for (const double uneven_s : {0.0, 0.004}) {
    for (Eigen::Index i = 1; i < t.size(); i += 2) t[i] += uneven_s;
    const Eigen::VectorXd values = t.unaryExpr(u);
    const Envelope in_order(t, values);
    for (const Eigen::Index apart : {1, 4, 7, 199, 5000}) {
      const Envelope envelope(t, values, apart);
      for (double at = -1.01; at < 1.01; at += 0.0037) {
        EXPECT_EQ(envelope.at(at).value, in_order.at(at).value) << apart << " at " << at;
        EXPECT_EQ(envelope.at(at).slope, in_order.at(at).slope) << apart << " at " << at;
        const double inside = std::clamp(at, t[0], t[t.size() - 1]);
        EXPECT_NEAR(envelope.at(at).value, std::max(0.0, u(inside)), 5e-4) << apart << " at " << at;
      }
      for (Eigen::Index i = 0; i < t.size(); ++i)
        EXPECT_NEAR(envelope.at(t[i]).value, std::max(0.0, values[i]), 1e-13) << apart << " " << i;
    }
  }
}

/// A channel with this delay, else proportional.
ChannelValues with_delay(double delay_s) {
  ChannelValues c{};
  c[kDelay] = delay_s;
  c[kGain] = c[kExponent] = 1.0;
  return c;
}

// Lags forget the begin of a recording within two seconds, and polynomials its ends within half of one.
TEST(Envelope, APartReadsAsTheWholeDoesAlsoBehindLags) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(2001, 0.0, 20.0);
  const Eigen::VectorXd u = 0.4 + 0.3 * (5.0 * t.array()).sin() + 0.2 * (13.0 * t.array()).cos();
  const Envelope whole(t, u, 5), part = whole.within(8.0, 13.5);
  EXPECT_LT(part.time_s().size(), 560);
  EXPECT_EQ(whole.within(-1.0, 30.0).time_s().size(), t.size());
  const Eigen::VectorXd read = Eigen::VectorXd::LinSpaced(60, 10.2, 13.0);
  ChannelValues channel{};
  channel[kGain] = channel[kExponent] = 1.0;
  channel[kDelay] = 0.15;
  for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
    const std::vector<Activation> of_whole = activation(whole, read, channel, lag),
                                  of_part = activation(part, read, channel, lag);
    for (std::size_t i = 0; i < of_whole.size(); ++i) {
      EXPECT_NEAR(of_part[i].value, of_whole[i].value, 1e-8);
      EXPECT_NEAR(of_part[i].by_field[kDelay], of_whole[i].by_field[kDelay], 1e-6);
    }
  }
}

TEST(EmgLag, ASharedDelayIsTheMeanLagOfRiseAndFall) {
  // Behind a ramp the output of a lag stays by slope times tau: (10 + 40 + 15) / 82.5 of d on the
  // way up, (10 + 40 + 50) / 82.5 on the way down, d in the mean.
  constexpr double kDelay_s = 0.08;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(4001, 0.0, 4.0);
  const Eigen::VectorXd u = (1.0 - (t.array() - 2.0).abs() / 2.0).matrix();
  const Eigen::VectorXd at = Eigen::Vector2d(1.5, 3.5);
  const auto a = activation(Envelope(t, u), at, with_delay(kDelay_s), EmgLag::shared);
  const double up_s = 1.5 - 2.0 * a[0].value, down_s = 2.0 * a[1].value - 0.5;
  // Steps of 1 ms, held: h^2 / (12 tau) = 6e-6 s of the shortest.
  EXPECT_NEAR(up_s, kDelay_s * 65.0 / 82.5, 1e-5);
  EXPECT_NEAR(down_s, kDelay_s * 100.0 / 82.5, 1e-5);
  EXPECT_NEAR(0.5 * (up_s + down_s), kDelay_s, 1e-5);
  const auto pure = activation(Envelope(t, u), at, with_delay(kDelay_s), EmgLag::delay);
  EXPECT_NEAR(1.5 - 2.0 * pure[0].value, kDelay_s, 1e-12);
}

TEST(EmgLag, LagsWeakenWhatChangesFast) {
  // |H| = 1 / sqrt(1 + (2 pi f tau)^2) of the excitation; of the activation, which falls slower
  // than it rises, between those of 15 and 50 eighty-second-and-a-halfths of d.
  constexpr double kDelay_s = 0.0825, kHz = 2.0;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(8001, 0.0, 8.0);
  const Eigen::VectorXd u = (0.5 + 0.4 * (2.0 * M_PI * kHz * t.array()).sin()).matrix();
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(1001, 4.0, 5.0);
  double low = 1.0, high = 0.0;
  for (const Activation& a : activation(Envelope(t, u), at, with_delay(kDelay_s), EmgLag::shared)) {
    low = std::min(low, a.value);
    high = std::max(high, a.value);
  }
  const auto gain = [&](double tau_s) { return 1.0 / std::hypot(1.0, 2.0 * M_PI * kHz * tau_s); };
  EXPECT_LT((high - low) / 0.8, gain(0.040) * gain(0.015));
  EXPECT_GT((high - low) / 0.8, gain(0.040) * gain(0.050));
}

TEST(EmgLag, DerivativeByASharedDelayIsThatOfTheActivation) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(601, 0.0, 3.0);
  const Eigen::VectorXd u = (0.3 + 0.2 * (5.0 * t.array()).sin()).matrix();
  const Envelope envelope(t, u);
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(50, 0.4, 2.9);
  constexpr double kStep = 1e-6;
  for (const double delay_s : {0.03, 0.09}) {
    const auto a = activation(envelope, at, with_delay(delay_s), EmgLag::shared);
    const auto more = activation(envelope, at, with_delay(delay_s + kStep), EmgLag::shared);
    const auto less = activation(envelope, at, with_delay(delay_s - kStep), EmgLag::shared);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double slope = (more[i].value - less[i].value) / (2.0 * kStep);
      EXPECT_NEAR(a[i].by_field[kDelay], slope, 1e-6) << delay_s << " " << i;
      EXPECT_EQ(a[i].by_field[kExcitationTime], 0.0);
    }
  }
}

TEST(EmgLag, NoDelayIsNoLag) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(601, 0.0, 3.0);
  const Eigen::VectorXd u = (0.3 + 0.2 * (5.0 * t.array()).sin()).matrix();
  const auto a = activation(Envelope(t, u), t, with_delay(0.0), EmgLag::shared);
  // Held inputs, half a step late twice: 5 ms at a slope of at most 1/s.
  for (std::size_t i = 1; i < a.size(); ++i) EXPECT_NEAR(a[i].value, u[static_cast<Eigen::Index>(i)], 5.1e-3);
}

}  // namespace
}  // namespace myoid::fit
