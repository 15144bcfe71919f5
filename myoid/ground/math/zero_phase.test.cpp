#include "myoid/ground/math/zero_phase.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

std::vector<SecondOrderSection> low_pass() { return design_butterworth(FilterBand::low_pass, 2, 6.0, 100.0); }

Eigen::VectorXd noise(Eigen::Index n) {
  std::mt19937_64 engine(7);
  Eigen::VectorXd x(n);
  for (double& v : x) v = static_cast<double>(engine() >> 11) * 0x1.0p-53 - 0.5;
  return x;
}

TEST(ZeroPhase, ReproducesAConstant) {
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(50, 3.7);
  EXPECT_LT((zero_phase(low_pass(), x) - x).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ZeroPhase, ASineKeepsItsPhaseAndHasTheSquaredGain) {
  const double f = 4.0;
  Eigen::VectorXd x(2000);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = std::sin(2.0 * M_PI * f * static_cast<double>(i) / 100.0);
  const Eigen::VectorXd y = zero_phase(low_pass(), x);
  const double g = gain(low_pass(), f, 100.0);
  // Away from the ends; end transients decay below 1e-6 within 3 s.
  EXPECT_LT((y - g * g * x).segment(300, 1400).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ZeroPhase, DoesNotCareForTheDirectionOfTime) {
  const Eigen::VectorXd x = noise(400);
  const Eigen::VectorXd reversed = zero_phase(low_pass(), x.reverse()).reverse();
  // Equal but for the order of the two passes at the ends, which the padding makes small.
  EXPECT_LT((zero_phase(low_pass(), x) - reversed).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ZeroPhase, IsLinear) {
  const Eigen::VectorXd x = noise(300);
  const Eigen::VectorXd y = x.array().square();
  const Eigen::VectorXd together = zero_phase(low_pass(), 2.0 * x - 3.0 * y);
  EXPECT_LT((together - 2.0 * zero_phase(low_pass(), x) + 3.0 * zero_phase(low_pass(), y)).cwiseAbs().maxCoeff(),
            1e-12);
}

TEST(ZeroPhase, WithEvenEndsTheSignalIsItsOwnMirrorImage) {
  // The same as the middle of a signal that was mirrored on both sides by hand, whose own ends are
  // 400 samples, seven time constants, away.
  const Eigen::VectorXd x = noise(401);
  Eigen::VectorXd longer(3 * 401 - 2);
  longer << x.reverse().head(400), x, x.reverse().tail(400);
  const Eigen::VectorXd y = zero_phase(low_pass(), longer).segment(400, 401);
  EXPECT_LT((zero_phase(low_pass(), x, Ends::even) - y).cwiseAbs().maxCoeff(), 1e-8);
  // A recording shorter than the filter's memory is reflected to and fro.
  const Eigen::VectorXd brief = Eigen::VectorXd::Constant(5, -2.5);
  EXPECT_LT((zero_phase(low_pass(), brief, Ends::even) - brief).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ZeroPhase, OfNoiseOddEndsReturnTheLastSampleAndEvenOnesAMean) {
  // Mean square at the first sample over that in the middle, of 2000 pieces of white noise: with
  // even ends every sample but the first counts twice, which by the impulse response h is
  // 2 - h_0^2 / sum h^2. (Chi-square with 2000 degrees: 3 % each.)
  const auto sections = low_pass();
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(201);
  impulse[100] = 1.0;
  const Eigen::VectorXd h = zero_phase(sections, impulse);
  double first = 0.0, middle = 0.0;
  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 2000; ++k) {
    Eigen::VectorXd x(201);
    for (double& v : x) v = normal(engine);
    const Eigen::VectorXd y = zero_phase(sections, x, Ends::even);
    first += y[0] * y[0];
    middle += y[100] * y[100];
    EXPECT_NEAR(zero_phase(sections, x, Ends::odd)[0], x[0], 1e-6);
  }
  EXPECT_NEAR(first / middle, 2.0 - h[100] * h[100] / h.squaredNorm(), 0.15);
}

TEST(ZeroPhase, RefusesAGap) {
  Eigen::VectorXd x = noise(20);
  x[7] = std::nan("");
  EXPECT_THROW((void)zero_phase(low_pass(), x), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
