#include "myoid/muscle/scalar.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

TEST(Scalar, ValueOfReachesThroughNestedDerivatives) {
  using Jet = ceres::Jet<double, 2>;
  using Nested = ceres::Jet<Jet, 1>;
  EXPECT_EQ(value_of(3.5), 3.5);
  EXPECT_EQ(value_of(Jet(2.5, 1)), 2.5);
  EXPECT_EQ(value_of(Nested(Jet(1.5, 0), 0)), 1.5);
}

TEST(Scalar, LinearizedIsTheValueWithTheSlopeTimesTheDerivatives) {
  using Jet = ceres::Jet<double, 1>;
  EXPECT_EQ(linearized(2.0, 7.0, 3.0), 7.0);
  const Jet y = linearized(Jet(2.0, 0) * Jet(5.0), 7.0, 3.0);
  EXPECT_EQ(y.a, 7.0);
  EXPECT_EQ(y.v[0], 15.0);
}

}  // namespace
}  // namespace myoid::muscle
