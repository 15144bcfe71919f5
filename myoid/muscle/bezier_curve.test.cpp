#include "myoid/muscle/bezier_curve.h"

#include <array>
#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::muscle {
namespace {

/// A convex corner and a concave one, rising throughout.
BezierCurve sigmoid() {
  const std::array<CurveKnot, 3> knots{{{-1.0, 0.0, 0.1}, {0.0, 1.0, 3.0}, {1.0, 1.5, 0.2}}};
  const std::array<double, 2> curviness{0.6, 0.8};
  return BezierCurve(knots, curviness);
}

/// The same curve by de Casteljau's construction, with the parameter found by bisection: another
/// algorithm.
double by_casteljau(double x) {
  const auto corner = [](CurveKnot p, CurveKnot q, double c, double at) {
    const double cx = (q.y - p.y - q.x * q.slope + p.x * p.slope) / (p.slope - q.slope);
    const double cy = q.y + (cx - q.x) * q.slope;
    const auto point = [&](double u) {
      std::array<double, 6> px{p.x,
                               p.x + c * (cx - p.x),
                               p.x + c * (cx - p.x),
                               q.x + c * (cx - q.x),
                               q.x + c * (cx - q.x),
                               q.x};
      std::array<double, 6> py{p.y,
                               p.y + c * (cy - p.y),
                               p.y + c * (cy - p.y),
                               q.y + c * (cy - q.y),
                               q.y + c * (cy - q.y),
                               q.y};
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
  };
  return x < 0.0 ? corner({-1.0, 0.0, 0.1}, {0.0, 1.0, 3.0}, 0.6, x)
                 : corner({0.0, 1.0, 3.0}, {1.0, 1.5, 0.2}, 0.8, x);
}

TEST(BezierCurve, IsThatOfDeCasteljausConstruction) {
  const BezierCurve curve = sigmoid();
  for (double x = -0.99; x < 1.0; x += 0.07) {
    EXPECT_NEAR(curve(x).value, by_casteljau(x), 1e-14) << x;
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
    EXPECT_NEAR(curve(x).value, (curve.integral(x + h) - curve.integral(x - h)) / (2 * h), 1e-8)
        << x;
  }
  EXPECT_EQ(curve.integral(-1.0), 0.0);
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
