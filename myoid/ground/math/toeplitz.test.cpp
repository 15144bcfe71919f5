#include "myoid/ground/math/toeplitz.h"

#include <gtest/gtest.h>

namespace myoid::inline ground::math {
namespace {

TEST(Toeplitz, RepeatsItsFirstColumnAlongTheDiagonals) {
  const Eigen::MatrixXd written{{1.0, 2.0, 3.0}, {2.0, 1.0, 2.0}, {3.0, 2.0, 1.0}};
  EXPECT_EQ(toeplitz(Eigen::Vector3d(1.0, 2.0, 3.0)), written);
}

// f = sum of by times the matrix: each number of the column stands on both of its diagonals.
TEST(Toeplitz, TheGradientByItsFirstColumnAddsBothDiagonals) {
  const Eigen::MatrixXd by{{1.0, 4.0, 6.0}, {4.0, 2.0, 5.0}, {6.0, 5.0, 3.0}};
  EXPECT_EQ(by_first_column(by), Eigen::Vector3d(6.0, 18.0, 12.0));
  const Eigen::Vector3d column(0.3, -1.0, 2.0);
  EXPECT_NEAR(by_first_column(by).dot(column), by.cwiseProduct(toeplitz(column)).sum(), 1e-14);
}

}  // namespace
}  // namespace myoid::inline ground::math
