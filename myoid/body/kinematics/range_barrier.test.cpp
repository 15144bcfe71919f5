#include "myoid/body/kinematics/range_barrier.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::body {
namespace {

/// Coordinates of ranges -1..3 (clamped), unclamped, 0..0.1 (clamped).
body::BodyModel three_coordinates() {
  body::BodyModel m;
  m.coordinates.resize(3);
  m.coordinates[0] = {.name = "a", .lower = -1.0, .upper = 3.0, .clamped = true};
  m.coordinates[1] = {.name = "b", .lower = -1.0, .upper = 1.0, .clamped = false};
  m.coordinates[2] = {.name = "c", .lower = 0.0, .upper = 0.1, .clamped = true};
  return m;
}

RangeBarrier barrier_of_all(double weight) {
  RangeBarrier barrier(three_coordinates(), {0, 1, 2});
  barrier.set_weight(weight);
  return barrier;
}

TEST(RangeBarrier, VanishesInTheMiddleAndIsInfiniteAtTheEnds) {
  const RangeBarrier barrier = barrier_of_all(0.5);
  EXPECT_NEAR(barrier.value(Eigen::Vector3d(1.0, 77.0, 0.05)), 0.0, 1e-15);
  // Three quarters of the way: 4 * 3/4 * 1/4 = 3/4.
  EXPECT_NEAR(barrier.value(Eigen::Vector3d(2.0, 77.0, 0.05)), -0.5 * std::log(0.75), 1e-15);
  EXPECT_TRUE(std::isinf(barrier.value(Eigen::Vector3d(3.0, 0.0, 0.05))));
  EXPECT_TRUE(std::isinf(barrier.value(Eigen::Vector3d(1.0, 0.0, -0.01))));
}

TEST(RangeBarrier, ItsDerivativesAreThoseOfItsValue) {
  const RangeBarrier barrier = barrier_of_all(0.3);
  const Eigen::Vector3d q(2.5, 0.0, 0.02);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(3);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(3, 3);
  barrier.add_derivatives(q, gradient, hessian);
  for (Eigen::Index k = 0; k < 3; ++k) {
    // Central differences over h: off by h^2 / 6 of the third derivative, 1e-12 * 0.3 * 2 / 0.02^3.
    const double h = 1e-6;
    Eigen::Vector3d up = q, down = q;
    up[k] += h;
    down[k] -= h;
    EXPECT_NEAR((barrier.value(up) - barrier.value(down)) / (2.0 * h), gradient[k], 1e-6);
    Eigen::VectorXd above = Eigen::VectorXd::Zero(3), below = above;
    Eigen::MatrixXd unused = Eigen::MatrixXd::Zero(3, 3);
    barrier.add_derivatives(up, above, unused);
    barrier.add_derivatives(down, below, unused);
    EXPECT_NEAR((above[k] - below[k]) / (2.0 * h), hessian(k, k), 1e-6 * (1.0 + hessian(k, k)));
  }
  EXPECT_EQ(gradient[1], 0.0) << "not clamped";
}

TEST(RangeBarrier, AStepGoesNinetyNineHundredthsOfTheWayToAnEnd) {
  const RangeBarrier barrier = barrier_of_all(1.0);
  const Eigen::Vector3d q(1.0, 0.0, 0.05);
  EXPECT_DOUBLE_EQ(barrier.longest_share(q, Eigen::Vector3d(1.0, 500.0, 0.01)), 1.0);
  EXPECT_DOUBLE_EQ(barrier.longest_share(q, Eigen::Vector3d(4.0, 0.0, 0.0)), 0.99 * 0.5);
  EXPECT_DOUBLE_EQ(barrier.longest_share(q, Eigen::Vector3d(0.0, 0.0, -0.1)), 0.99 * 0.5);
}

TEST(RangeBarrier, MovesInsideWhatIsOutside) {
  const RangeBarrier barrier = barrier_of_all(1.0);
  Eigen::VectorXd q = Eigen::Vector3d(9.0, 9.0, 0.0);
  barrier.move_inside(q, 0.01);
  EXPECT_DOUBLE_EQ(q[0], 2.96);
  EXPECT_EQ(q[1], 9.0);
  EXPECT_DOUBLE_EQ(q[2], 0.001);
}

}  // namespace
}  // namespace myoid::body
