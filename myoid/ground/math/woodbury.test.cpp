#include "myoid/ground/math/woodbury.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "myoid/ground/math/draws.h"

namespace myoid::inline ground::math {
namespace {

/// Blocks of 3, 1 and 4 rows, with right-hand sides of two columns.
struct Case {
  explicit Case(Eigen::Index columns) {
    const Eigen::MatrixXd draws =
        draw_normal(Eigen::VectorXd::Zero(8), Eigen::MatrixXd::Identity(8, 8), columns + 2, 5);
    u = draws.leftCols(columns);
    b = draws.rightCols(2);
    Eigen::Index first = 0;
    for (const Eigen::Index rows : {3, 1, 4}) {
      blocks.emplace_back(u.middleRows(first, rows));
      right.emplace_back(b.middleRows(first, rows));
      first += rows;
    }
    for (const Eigen::MatrixXd& block : blocks) pointers.push_back(&block);
  }
  Eigen::MatrixXd u, b;
  std::vector<Eigen::MatrixXd> blocks, right;
  Woodbury::Blocks pointers;
};

// Fewer columns than rows, as many, and more: the answers are those of the whole matrix G.
TEST(Woodbury, AnswersAsTheWholeMatrixDoes) {
  for (const Eigen::Index columns : {2, 8, 20}) {
    const Case of(columns);
    const Woodbury found(of.pointers, columns);
    const Eigen::MatrixXd g = Eigen::MatrixXd::Identity(columns, columns) + of.u.transpose() * of.u;
    const Eigen::MatrixXd inverse = g.inverse();
    ASSERT_TRUE(found.positive());
    EXPECT_NEAR(found.log_determinant(), std::log(g.determinant()), 1e-12 * static_cast<double>(columns));
    EXPECT_LT((found.project(of.right) - of.u.transpose() * of.b).norm(), 1e-13);
    EXPECT_LT((found.solve(of.right) - inverse * of.u.transpose() * of.b).norm(), 1e-12);
    EXPECT_LT((found.inverse() - inverse).norm(), 1e-12);
    const Woodbury::Left left = found.left();
    EXPECT_LT((left.blocks[2] - of.blocks[2] * inverse).norm(), 1e-12);
    EXPECT_LT((left.diagonal - inverse.diagonal()).norm(), 1e-12);
  }
}

TEST(Woodbury, MultipliesEachColumnByItsFactor) {
  for (const Eigen::Index columns : {3, 15}) {
    const Case of(columns);
    const Eigen::VectorXd factors = Eigen::VectorXd::LinSpaced(columns, 0.5, 2.0);
    const Eigen::MatrixXd scaled = of.u * factors.asDiagonal();
    const Eigen::MatrixXd g = Eigen::MatrixXd::Identity(columns, columns) + scaled.transpose() * scaled;
    const Eigen::MatrixXd found = Woodbury(of.pointers, columns).solve(of.right, factors);
    EXPECT_LT((found - g.inverse() * scaled.transpose() * of.b).norm(), 1e-12);
  }
}

TEST(Woodbury, RefusesBlocksThatAreNotFinite) {
  Case of(3);
  of.blocks[1](0, 1) = std::nan("");
  EXPECT_FALSE(Woodbury(of.pointers, 3).positive());
}

}  // namespace
}  // namespace myoid::inline ground::math
