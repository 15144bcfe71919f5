#include "myoid/math/zero_phase.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::math {
namespace {

std::vector<SecondOrderSection> low_pass() {
  return design_butterworth(FilterBand::low_pass, 2, 6.0, 100.0);
}

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
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = std::sin(2.0 * M_PI * f * static_cast<double>(i) / 100.0);
  const Eigen::VectorXd y = zero_phase(low_pass(), x);
  const double g = gain(low_pass(), f, 100.0);
  // Away from the ends; what is left of the end transients decays below 1e-6 within 3 s.
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
  EXPECT_LT((together - 2.0 * zero_phase(low_pass(), x) + 3.0 * zero_phase(low_pass(), y))
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
}

TEST(ZeroPhase, RefusesAGap) {
  Eigen::VectorXd x = noise(20);
  x[7] = std::nan("");
  EXPECT_THROW((void)zero_phase(low_pass(), x), InvalidInput);
}

}  // namespace
}  // namespace myoid::math
