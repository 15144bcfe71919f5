#include "myoid/fit/posterior/mode.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

TEST(Mode, IsWhereTheDensityIsFlatAndItsCovarianceIsTheCurvatureThere) {
  const test::ElbowStudy study = test::elbow_study(
      {.trials = 2, .seconds = 8.0, .emg_cv = 0.1, .torque_sd_nm = 0.5, .with_priors = true, .seed = 2});
  const Density density(study.data, {});
  Mode mode = find_mode(density, {.x = density.start()}, {});
  ASSERT_TRUE(mode.converged) << mode.message;
  add_curvature(density, true, mode, {});
  Eigen::VectorXd gradient;
  EXPECT_EQ(density.value(mode.x, gradient), mode.log_density);
  // A Newton step from there promises next to nothing.
  EXPECT_LT(gradient.dot(mode.covariance * gradient), 0.05);
  // Half of a standard deviation along any axis of the covariance costs some 1/8, which a cubic term changes.
  const Eigen::MatrixXd root = mode.covariance.llt().matrixL();
  for (Eigen::Index j = 0; j < mode.x.size(); j += 5) {
    const double fall =
        2.0 * mode.log_density - density.value(mode.x + 0.5 * root.col(j)) - density.value(mode.x - 0.5 * root.col(j));
    EXPECT_NEAR(fall, 0.25, 0.08) << j;
  }
  // Not exact, it is the inverse of Gauss and Newton's matrix, which these data do not leave far.
  const Eigen::MatrixXd exact = mode.covariance;
  add_curvature(density, false, mode, {});
  const Eigen::MatrixXd one = mode.covariance * density.gauss_newton(mode.x);
  EXPECT_LT((one - Eigen::MatrixXd::Identity(one.rows(), one.cols())).cwiseAbs().maxCoeff(), 1e-6);
  const Eigen::VectorXd ratio = mode.covariance.diagonal().cwiseQuotient(exact.diagonal()).cwiseSqrt();
  EXPECT_NEAR(ratio.mean(), 1.0, 0.2);
  EXPECT_GT((mode.covariance - exact).cwiseAbs().maxCoeff(), 0.0);
}

}  // namespace
}  // namespace myoid::fit
