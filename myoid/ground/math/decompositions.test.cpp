#include "myoid/ground/math/decompositions.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace myoid::inline ground::math {
namespace {

// Four numbers of order one, a handful of operations each: round-off stays below 1e-14.
constexpr double kFewOperations = 1e-14;

TEST(Decompositions, OfATwoByTwoMatrixAreThoseOfThePaperAndPencil) {
  // [[2, 1], [1, 2]]: 1 along (1, -1), 3 along (1, 1). The upper triangle is not read.
  const Eigen::MatrixXd matrix{{2.0, 7.0}, {1.0, 2.0}};
  const SymmetricEigen eigen = symmetric_eigen(matrix);
  EXPECT_NEAR(eigen.values[0], 1.0, kFewOperations);
  EXPECT_NEAR(eigen.values[1], 3.0, kFewOperations);
  EXPECT_NEAR(eigen.vectors(0, 0) + eigen.vectors(1, 0), 0.0, kFewOperations);
  EXPECT_NEAR(eigen.vectors(0, 1) - eigen.vectors(1, 1), 0.0, kFewOperations);
  EXPECT_NEAR(eigen.vectors.col(0).norm(), 1.0, kFewOperations);
  EXPECT_NEAR((symmetric_eigenvalues(matrix) - eigen.values).norm(), 0.0, kFewOperations);
}

TEST(Decompositions, TheInverseOfAPositiveMatrixIsEasedByItsDiagonal) {
  // [[2, 1], [1, 2]] with sides scaled by 1 and 1e-6: 1/3 [[2, -1], [-1, 2]].
  const Eigen::MatrixXd inverse = inverse_of_positive(Eigen::MatrixXd{{2.0, 1e-6}, {1e-6, 2e-12}});
  EXPECT_NEAR(inverse(0, 0), 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(inverse(0, 1) * 1e-6, -1.0 / 3.0, 1e-9);
  EXPECT_NEAR(inverse(1, 1) * 1e-12, 2.0 / 3.0, 1e-9);
  // A singular matrix has an inverse, as large as the ease lets it be.
  EXPECT_NEAR(inverse_of_positive(Eigen::MatrixXd::Ones(2, 2)).sum(), 1.0, 1e-5);
}

TEST(Decompositions, TheNearestSolutionOfALineIsTheRegression) {
  // Through (0, 1), (1, 3), (2, 2): mean 2 at 1, slope 1/2.
  const Eigen::MatrixXd a{{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}};
  const Eigen::VectorXd x = nearest_solution(a, Eigen::Vector3d(1.0, 3.0, 2.0));
  EXPECT_NEAR(x[0], 1.5, kFewOperations);
  EXPECT_NEAR(x[1], 0.5, kFewOperations);
}

TEST(Decompositions, TheShortestSolutionIsPerpendicularToTheNullSpace) {
  // x + 2 y + 2 z = 9: the foot of the perpendicular is (1, 2, 2).
  const Eigen::MatrixXd a{{1.0, 2.0, 2.0}};
  const Eigen::VectorXd x = shortest_solution(a, Eigen::VectorXd::Constant(1, 9.0));
  EXPECT_NEAR((x - Eigen::Vector3d(1.0, 2.0, 2.0)).norm(), 0.0, kFewOperations);
  const Eigen::MatrixXd free = null_space(a);
  ASSERT_EQ(free.cols(), 2);
  EXPECT_NEAR((a * free).norm(), 0.0, kFewOperations);
  EXPECT_NEAR((free.transpose() * free - Eigen::MatrixXd::Identity(2, 2)).norm(), 0.0, kFewOperations);
  EXPECT_NEAR((free.transpose() * x).norm(), 0.0, kFewOperations);
}

TEST(Decompositions, ThePseudoInverseOfAColumnIsTheRowOverItsSquare) {
  const Eigen::MatrixXd a{{3.0}, {4.0}};
  EXPECT_NEAR((pseudo_inverse(a) - Eigen::RowVector2d(3.0, 4.0) / 25.0).norm(), 0.0, kFewOperations);
}

TEST(Decompositions, TheNearestRotationIsTheTurnAndNeverAReflection) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 2) / 3.0).matrix();
  const Eigen::Vector3d size(3.0, 2.0, 1.0);
  EXPECT_NEAR((nearest_rotation(turn * size.asDiagonal()) - turn).norm(), 0.0, 1e-14);
  // A mirror image turns back about the axis of the smallest size.
  const Eigen::Vector3d mirrored(3.0, 2.0, -1.0);
  EXPECT_NEAR((nearest_rotation(turn * mirrored.asDiagonal()) - turn).norm(), 0.0, 1e-14);
}

TEST(Decompositions, ARowWithinTheThresholdOfAnotherDoesNotCount) {
  const Eigen::MatrixXd a{{1.0, 0.0, 0.0}, {1.0, 1e-12, 0.0}};
  EXPECT_EQ(null_space(a).cols(), 2);
  const Eigen::VectorXd x = shortest_solution(a, Eigen::Vector2d(1.0, 2.0), 1e-9);
  EXPECT_NEAR(x[0], 1.5, 1e-9);  // the mean of both: the second row's own direction is not used
  EXPECT_NEAR(x[1], 0.0, 1e-9);
}

}  // namespace
}  // namespace myoid::inline ground::math
