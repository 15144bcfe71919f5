#include "myoid/body/model/wrap_contact.h"

#include <cmath>
#include <functional>
#include <optional>

#include <gtest/gtest.h>

#include "myoid/body/model/wrap_surfaces.h"

namespace myoid::body {
namespace {

TEST(WithinOneTurn, AddsWholeTurnsOnly) {
  EXPECT_NEAR(within_one_turn(-0.5), 2.0 * kPi - 0.5, 1e-15);
  EXPECT_NEAR(within_one_turn(7.0), 7.0 - 2.0 * kPi, 1e-15);
  EXPECT_EQ(within_one_turn(1.25), 1.25);
  // The derivative is that of the angle.
  EXPECT_EQ(within_one_turn(Jet6(-0.5, 2)).v[2], 1.0);
}

/// The tangents' and the arc's length together.
template <typename T>
T length_over(const ContactOf<T>& c, const Vector3<T>& p, const Vector3<T>& q) {
  return (c.first_W - p).norm() + c.arc_length_m + (q - c.second_W).norm();
}

/// The derivatives that an object's contact carries, against differences of its own length.
template <typename Wrap>
void expect_derivatives(const Wrap& wrap, const Vec3& p, const Vec3& q, const char* what) {
  Vector3<Jet6> pj, qj;
  for (int k = 0; k < 3; ++k) {
    pj[k] = Jet6(p[k], k);
    qj[k] = Jet6(q[k], k + 3);
  }
  const auto jets = wrap(pj, qj);
  ASSERT_TRUE(jets) << what;
  const Jet6 length = length_over<Jet6>(*jets, pj, qj);
  const auto plain = wrap(p, q);
  ASSERT_TRUE(plain) << what;
  EXPECT_DOUBLE_EQ(length.a, length_over<double>(*plain, p, q)) << what;
  const double h = 1e-6;
  for (int k = 0; k < 6; ++k) {
    const auto at = [&](double step) {
      Vec3 a = p, b = q;
      (k < 3 ? a[k] : b[k - 3]) += step;
      return length_over<double>(*wrap(a, b), a, b);
    };
    // Truncation h^2 times a third derivative of some 1e4 per m^2; round-off 1e-16 / h.
    EXPECT_NEAR(length.v[k], (at(h) - at(-h)) / (2.0 * h), 5e-8) << what << ", end " << k;
  }
}

TEST(WrapContact, CarriesTheDerivativesOfTheLengthOverEveryShape) {
  const Vec3 p(-0.09, 0.012, 0.03);
  const Vec3 q(0.08, 0.017, -0.02);
  for (const Quadrant quadrant : {0, 2, -2}) {
    expect_derivatives(
        [&](const auto& a, const auto& b) {
          using T = typename std::decay_t<decltype(a)>::Scalar;
          return wrap_cylinder<T>({.radius_m = 0.03, .length_m = 1.0}, quadrant, a, b);
        },
        p, q, "cylinder");
    expect_derivatives(
        [&](const auto& a, const auto& b) {
          using T = typename std::decay_t<decltype(a)>::Scalar;
          return wrap_sphere<T>({.radius_m = 0.03}, quadrant, a, b);
        },
        p, q, "sphere");
    for (const WrapMethod method : {WrapMethod::hybrid, WrapMethod::midpoint, WrapMethod::axial}) {
      expect_derivatives(
          [&](const auto& a, const auto& b) {
            using T = typename std::decay_t<decltype(a)>::Scalar;
            return wrap_ellipsoid<T>({Vec3(0.04, 0.03, 0.035)}, quadrant, method, a, b);
          },
          p, q, "ellipsoid");
    }
  }
  expect_derivatives(
      [&](const auto& a, const auto& b) {
        using T = typename std::decay_t<decltype(a)>::Scalar;
        return wrap_torus<T>({.inner_radius_m = 0.01, .outer_radius_m = 0.05}, 0, a, b);
      },
      Vec3(0.043, 0.01, -0.09), Vec3(0.047, -0.012, 0.08), "torus");
}

}  // namespace
}  // namespace myoid::body
