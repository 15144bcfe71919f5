#include "myoid/muscle/bezier_curve.h"

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

/// A convex corner and a concave one, rising throughout.
BezierCurve sigmoid() {
  const std::array<CurveKnot, 3> knots{{{-1.0, 0.0, 0.1}, {0.0, 1.0, 3.0}, {1.0, 1.5, 0.2}}};
  const std::array<double, 2> curviness{0.6, 0.8};
  return BezierCurve(knots, curviness);
}

/// A corner by de Casteljau's construction, with the parameter found by bisection: another algorithm.
double by_casteljau(const CurveKnot& p, const CurveKnot& q, double c, double at) {
  const double cx = (q.y - p.y - q.x * q.slope + p.x * p.slope) / (p.slope - q.slope);
  const double cy = q.y + (cx - q.x) * q.slope;
  const auto point = [&](double u) {
    std::array<double, 6> px{
        p.x, p.x + c * (cx - p.x), p.x + c * (cx - p.x), q.x + c * (cx - q.x), q.x + c * (cx - q.x), q.x};
    std::array<double, 6> py{
        p.y, p.y + c * (cy - p.y), p.y + c * (cy - p.y), q.y + c * (cy - q.y), q.y + c * (cy - q.y), q.y};
    for (std::size_t n = 5; n > 0; --n) {
      for (std::size_t i = 0; i < n; ++i) {
        px[i] += u * (px[i + 1] - px[i]);
        py[i] += u * (py[i + 1] - py[i]);
      }
    }
    return std::pair(px[0], py[0]);
  };
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double u = 0.5 * (low + high);
    (point(u).first < at ? low : high) = u;
  }
  return point(low).second;
}

TEST(BezierCurve, IsThatOfDeCasteljausConstruction) {
  const BezierCurve curve = sigmoid();
  for (double x = -0.99; x < 1.0; x += 0.07) {
    const double expected = x < 0.0 ? by_casteljau({-1.0, 0.0, 0.1}, {0.0, 1.0, 3.0}, 0.6, x)
                                    : by_casteljau({0.0, 1.0, 3.0}, {1.0, 1.5, 0.2}, 0.8, x);
    EXPECT_NEAR(curve(x).value, expected, 1e-14) << x;
  }
}

TEST(BezierCurve, IsFoundInCornersOfAnySharpness) {
  std::mt19937_64 random(311);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 300; ++k) {
    const double meet = 0.02 + 0.96 * share(random);
    const CurveKnot p{0.0, 0.0, 4.0 * share(random)};
    const double steep = p.slope + std::pow(10.0, 3.0 * share(random));
    const CurveKnot q{1.0, p.slope * meet + steep * (1.0 - meet), steep};
    const double c = 0.1 + 0.9 * share(random);
    const BezierCurve curve(std::array{p, q}, std::array{c});
    for (int i = 0; i < 30; ++i) {
      const double x = share(random);
      EXPECT_NEAR(curve(x).value, by_casteljau(p, q, c, x), 1e-13 * (1.0 + steep))
          << "corner " << k << ", c " << c << ", tangents meet at " << meet;
    }
  }
}

TEST(BezierCurve, PassesItsKnotsWithTheirSlopesAndGoesOnStraight) {
  const BezierCurve curve = sigmoid();
  EXPECT_NEAR(curve(0.0).value, 1.0, 1e-15);
  EXPECT_NEAR(curve(0.0).slope, 3.0, 1e-13);
  EXPECT_NEAR(curve(-1.5).value, -0.05, 1e-15);
  EXPECT_NEAR(curve(3.0).value, 1.9, 1e-15);
  EXPECT_EQ(curve(3.0).slope, 0.2);
}

TEST(BezierCurve, SlopeAndIntegralBelongToTheValue) {
  const BezierCurve curve = sigmoid();
  const double h = 1e-5;  // truncation h^2 f''' / 6, f''' below 1e3: 2e-8
  for (double x = -1.3; x < 1.4; x += 0.0713) {
    EXPECT_NEAR(curve(x).slope, (curve(x + h).value - curve(x - h).value) / (2 * h), 3e-8) << x;
    EXPECT_NEAR(curve(x).value, (curve.integral(x + h) - curve.integral(x - h)) / (2 * h), 1e-8) << x;
  }
  EXPECT_EQ(curve.integral(-1.0), 0.0);
  // Across the knots: midpoint sums, wrong by h^2 / 24 times the rise of the slope, 3: 5e-8.
  for (const double end : {-0.4, 0.6, 1.4}) {
    const double cell = (end + 1.0) / 4000;
    double sum = 0.0;
    for (int k = 0; k < 4000; ++k) sum += cell * curve(-1.0 + (k + 0.5) * cell).value;
    EXPECT_NEAR(curve.integral(end), sum, 1e-7) << end;
  }
}

TEST(BezierCurve, DerivativesOfTheArgumentGoThrough) {
  using Jet = ceres::Jet<double, 1>;
  const BezierCurve curve = sigmoid();
  const auto point = curve(Jet(0.3, 0) * Jet(2.0));
  EXPECT_EQ(point.value.a, curve(0.6).value);
  EXPECT_NEAR(point.value.v[0], 2.0 * curve(0.6).slope, 1e-15);
  EXPECT_NEAR(curve.integral(Jet(0.6, 0)).v[0], curve(0.6).value, 1e-15);
}

TEST(BezierCurve, SolveInvertsTheLoadedCurveOnAllItsParts) {
  const BezierCurve curve = sigmoid();
  for (const double strength : {1e-3, 0.4, 2.0}) {
    for (const double damping : {0.0, 1e-3, 0.5}) {
      for (double x = -3.0; x < 4.0; x += 0.0917) {
        const double force = strength * curve(x).value + damping * x;
        EXPECT_NEAR(curve.solve(strength, damping, force), x, 1e-12) << strength << ' ' << damping;
      }
    }
  }
}

TEST(BezierCurve, RefusesCornersThatAreNone) {
  const std::array<double, 1> c{0.5};
  const std::array<CurveKnot, 2> s_shaped{{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.5}}};
  EXPECT_THROW(BezierCurve(s_shaped, c), InvalidInput);
  const std::array<CurveKnot, 2> fine{{{0.0, 0.0, 0.0}, {1.0, 1.0, 2.0}}};
  EXPECT_NO_THROW(BezierCurve(fine, c));
  const std::array<double, 1> too_curved{1.5};
  EXPECT_THROW(BezierCurve(fine, too_curved), InvalidInput);
  const std::array<double, 2> too_many{0.5, 0.5};
  EXPECT_THROW(BezierCurve(fine, too_many), InvalidInput);
}

}  // namespace
}  // namespace myoid::muscle
