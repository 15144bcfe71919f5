#include "myoid/ground/math/spline.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

Eigen::VectorXd uneven(Eigen::Index n) {
  std::mt19937_64 engine(11);
  Eigen::VectorXd t(n);
  double now = 0.0;
  for (double& v : t) {
    now += 0.01 * (0.4 + static_cast<double>(engine() >> 11) * 0x1.0p-53);
    v = now;
  }
  return t;
}

Eigen::VectorXd map(const Eigen::VectorXd& t, double (*f)(double)) {
  Eigen::VectorXd y(t.size());
  for (Eigen::Index i = 0; i < t.size(); ++i) y[i] = f(t[i]);
  return y;
}

TEST(Spline, PassesThroughItsPointsInEveryDegreeOnUnevenKnots) {
  const Eigen::VectorXd t = uneven(200);
  const Eigen::VectorXd y = map(t, [](double x) { return std::sin(7.0 * x) + 0.2 * std::cos(31.0 * x); });
  for (const int degree : {1, 3, 5}) {
    const Spline spline = Spline::interpolate(t, y, degree);
    // From the left as well as at the knot: the pieces meet there.
    for (Eigen::Index i = 1; i < t.size(); ++i) {
      EXPECT_NEAR(spline.at(t[i]).value, y[i], 1e-12);
      EXPECT_NEAR(spline.at(t[i] - 1e-13).value, y[i], 1e-10) << "degree " << degree << " knot " << i;
    }
  }
}

TEST(Spline, QuinticReproducesAParabolaAndItsDerivativesExactly) {
  const Eigen::VectorXd t = uneven(60);
  const Eigen::VectorXd y = map(t, [](double x) { return 1.0 - 2.0 * x + 3.0 * x * x; });
  const SplineValue v = Spline::interpolate(t, y, 5).at(0.2345);
  EXPECT_NEAR(v.value, 1.0 - 2.0 * 0.2345 + 3.0 * 0.2345 * 0.2345, 1e-12);
  EXPECT_NEAR(v.first, -2.0 + 6.0 * 0.2345, 1e-10);
  EXPECT_NEAR(v.second, 6.0, 1e-7);  // round-off over h^2
}

TEST(Spline, CubicIsTheClassicalNaturalSpline) {
  // Knots 0,1,2, values 0,1,0: moments M0 = M2 = 0, 4 M1 = 6 (0 - 2 + 0) so M1 = -3; s(1/2) = 1/2 + 3/16.
  const Spline spline = Spline::interpolate(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(0, 1, 0), 3);
  EXPECT_NEAR(spline.at(1.0).second, -3.0, 1e-12);
  EXPECT_NEAR(spline.at(0.5).value, 0.5 + 3.0 / 16.0, 1e-12);
}

TEST(Spline, QuinticSecondDerivativeConvergesWithTheFourthPowerOfTheInterval) {
  const auto error = [](double h) {
    const Eigen::Index n = static_cast<Eigen::Index>(std::lround(10.0 / h)) + 1;
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, 0.0, 10.0);
    const Spline spline = Spline::interpolate(t, t.array().sin(), 5);
    double worst = 0.0;
    for (double x = 4.5; x < 5.5; x += 0.0173) worst = std::max(worst, std::abs(spline.at(x).second + std::sin(x)));
    return worst;
  };
  const double ratio = error(0.1) / error(0.05);
  EXPECT_GT(ratio, 12.0);
  EXPECT_LT(ratio, 20.0);
}

TEST(Spline, DerivativesAreThoseOfTheValue) {
  const Eigen::VectorXd t = uneven(100);
  const Spline spline = Spline::interpolate(t, map(t, [](double x) { return std::exp(x) * std::sin(9.0 * x); }), 5);
  const double h = 1e-5;
  for (const double x : {0.1, 0.35, 0.52}) {
    EXPECT_NEAR(spline.at(x).first, (spline.at(x + h).value - spline.at(x - h).value) / (2.0 * h), 1e-6);
    EXPECT_NEAR(spline.at(x).second, (spline.at(x + h).first - spline.at(x - h).first) / (2.0 * h), 1e-4);
  }
}

TEST(Spline, SmoothingHasItsMinusThreeDecibelAtTheCutOff) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(2001, 0.0, 20.0);
  Eigen::VectorXd y(t.size());
  for (Eigen::Index i = 0; i < t.size(); ++i) y[i] = std::sin(2.0 * M_PI * 6.0 * t[i]);
  const Eigen::VectorXd s = Spline::smooth(t, y, {.cutoff_hz = 6.0}).evaluate(t).value;
  const double gain = s.segment(500, 1000).dot(y.segment(500, 1000)) / y.segment(500, 1000).squaredNorm();
  EXPECT_NEAR(gain, std::sqrt(0.5), 0.005);
}

TEST(Spline, SmoothingByTheNoiseLeavesThatMuchResidual) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1001, 0.0, 10.0);
  std::mt19937_64 engine(3);
  Eigen::VectorXd y(t.size());
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    double noise = -6.0;  // a sum of twelve uniform numbers: unit variance
    for (int k = 0; k < 12; ++k) noise += static_cast<double>(engine() >> 11) * 0x1.0p-53;
    y[i] = std::sin(3.0 * t[i]) + 0.01 * noise;
  }
  const SplineValues s = Spline::smooth(t, y, {.noise_sd = 0.01}).evaluate(t);
  EXPECT_NEAR(std::sqrt((s.value - y).squaredNorm() / 1001.0), 0.01, 1e-4);
  double error = 0.0;
  for (Eigen::Index i = 100; i < 900; ++i) error += std::pow(s.second[i] + 9.0 * std::sin(3.0 * t[i]), 2);
  EXPECT_LT(std::sqrt(error / 800.0),
            0.7);  // 9 peak; the raw second difference would be off by 0.01*sqrt(6)/h^2 = 245
}

TEST(Spline, ManySamplesDoNotSpoilIt) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(20001, 0.0, 100.0);
  const SplineValue v = Spline::interpolate(t, t.array().sin(), 5).at(50.0012);
  EXPECT_NEAR(v.second, -std::sin(50.0012),
              1e-8);  // round-off 1e-16/h^2 with h = 5 ms, times some hundred
}

TEST(Spline, RefusesTimeThatGoesBack) {
  EXPECT_THROW((void)Spline::interpolate(Eigen::Vector4d(0, 1, 1, 2), Eigen::Vector4d::Zero(), 3), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
