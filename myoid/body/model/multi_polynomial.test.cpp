#include "myoid/body/model/multi_polynomial.h"

#include <gtest/gtest.h>

namespace myoid::body {
namespace {

TEST(MultiPolynomial, HasAsManyTermsAsThereAreMonomials) {
  EXPECT_EQ(term_count(1, 3), 4.0);
  EXPECT_EQ(term_count(2, 2), 6.0);
  EXPECT_EQ(term_count(3, 2), 10.0);
  EXPECT_EQ(term_count(4, 0), 1.0);
}

// Written out by hand: 1, z, z^2, y, y z, y^2, x, x z, x y, x^2.
TEST(MultiPolynomial, TheLastVariableChangesFastest) {
  const MultiPolynomial f{3, 2, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0}, 2.0};
  const double x = 0.3, y = -1.2, z = 2.5;
  const MultiPolynomialValue v = evaluate(f, Eigen::Vector3d(x, y, z));
  EXPECT_NEAR(v.value,
              2.0 * (1.0 + 2.0 * z + 3.0 * z * z + 4.0 * y + 5.0 * y * z + 6.0 * y * y + 7.0 * x + 8.0 * x * z +
                     9.0 * x * y + 10.0 * x * x),
              1e-13);
  EXPECT_NEAR(v.gradient[0], 2.0 * (7.0 + 8.0 * z + 9.0 * y + 20.0 * x), 1e-13);
  EXPECT_NEAR(v.gradient[1], 2.0 * (4.0 + 5.0 * z + 12.0 * y + 9.0 * x), 1e-13);
  EXPECT_NEAR(v.gradient[2], 2.0 * (2.0 + 6.0 * z + 5.0 * y + 8.0 * x), 1e-13);
}

TEST(MultiPolynomial, OfOneVariableHasTheLowestPowerFirst) {
  const MultiPolynomial f{1, 3, {1.0, -2.0, 0.5, 3.0}, 1.0};
  const MultiPolynomialValue v = evaluate(f, Eigen::VectorXd::Constant(1, 2.0));
  EXPECT_NEAR(v.value, 1.0 - 4.0 + 2.0 + 24.0, 1e-13);
  EXPECT_NEAR(v.gradient[0], -2.0 + 2.0 + 36.0, 1e-13);
}

}  // namespace
}  // namespace myoid::body
