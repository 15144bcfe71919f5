#include "myoid/study/checks/torque_sign.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

/// A flexor that works in the first half of a movement and an extensor in the second, by hand.
Eigen::MatrixXd two_muscles() {
  Eigen::MatrixXd torques = Eigen::MatrixXd::Zero(200, 2);
  for (Eigen::Index i = 0; i < 200; ++i) {
    const double s = std::sin(2.0 * M_PI * static_cast<double>(i) / 200.0);
    torques(i, 0) = std::max(0.0, s) + 0.3;
    torques(i, 1) = -std::max(0.0, -s) - 0.3;
  }
  return torques;
}

TEST(SignsExplained, AMuscleThatIsTooStrongTurnsNoSign) {
  const Eigen::MatrixXd muscles = two_muscles();
  const Eigen::VectorXd torque = muscles * Eigen::Vector2d(3.0, 0.5);
  // The torque seems reversed, because the extensor starts ten times as strong as the flexor.
  const Eigen::MatrixXd start = muscles * Eigen::Vector2d(1.0, 10.0).asDiagonal();
  EXPECT_LT(start.rowwise().sum().dot(torque), 0.0);
  const SignsExplained found = signs_explained(start, torque);
  EXPECT_NEAR(found.as_given, 1.0, 1e-9);
  EXPECT_LT(found.reversed, 0.5);
}

TEST(SignsExplained, AReversedTorqueIsExplainedByTheOtherSignAlone) {
  const Eigen::MatrixXd flexors = two_muscles().col(0);
  const SignsExplained found = signs_explained(flexors, -2.0 * flexors.col(0));
  EXPECT_EQ(found.as_given, 0.0);
  EXPECT_NEAR(found.reversed, 1.0, 1e-12);
}

TEST(SignsExplained, AgreesWithEveryPairOfStrengthsOnAGrid) {
  const Eigen::MatrixXd muscles = two_muscles();
  const Eigen::VectorXd torque = Eigen::VectorXd::LinSpaced(200, -1.0, 2.0) + muscles * Eigen::Vector2d(0.4, 1.3);
  double best = 0.0;
  for (double a = 0.0; a < 6.0; a += 0.01) {
    for (double b = 0.0; b < 6.0; b += 0.01)
      best = std::max(best, 1.0 - (muscles * Eigen::Vector2d(a, b) - torque).squaredNorm() / torque.squaredNorm());
  }
  EXPECT_NEAR(signs_explained(muscles, torque).as_given, best, 1e-4);
}

}  // namespace
}  // namespace myoid::study
