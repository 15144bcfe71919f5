#include "myoid/run/log_covariance.h"

#include <gtest/gtest.h>

namespace myoid::run {
namespace {

TEST(LogCovariance, TakesReportedSpreadsAndTheCorrelationOfTheFit) {
  fit::IdentificationResult fit;
  fit.free_parameters = {"BRA.optimal_fiber_length", "BIC.optimal_fiber_length", "TRI+BIC.max_isometric_force"};
  fit.covariance = Eigen::Matrix3d::Identity();
  fit.covariance(1, 1) = 4.0;
  fit.covariance(2, 2) = 9.0;
  fit.covariance(1, 2) = fit.covariance(2, 1) = 3.0;  // a correlation of 3 / (2 * 3)
  const auto add = [&](const char* name, double estimate, double error) {
    fit::ParameterEstimate e;
    e.muscle = "BIC";
    e.parameter = name;
    e.estimate = estimate;
    e.std_error = error;
    fit.estimates.push_back(e);
  };
  add("optimal_fiber_length", 0.1, 0.01);
  add("max_isometric_force", 500.0, 100.0);
  add("force_length_width", 0.05, 0.01);
  const Eigen::MatrixXd c = log_covariance(
      fit, "BIC", {"optimal_fiber_length", "max_isometric_force", "force_length_width", "eccentric_plateau"});
  EXPECT_NEAR(c(0, 0), 0.01, 1e-15);
  EXPECT_NEAR(c(1, 1), 0.04, 1e-15);
  EXPECT_NEAR(c(0, 1), 0.5 * 0.1 * 0.2, 1e-15);
  EXPECT_EQ(c(0, 1), c(1, 0));
  EXPECT_NEAR(c(2, 2), 0.04, 1e-15);
  EXPECT_EQ(c(2, 0), 0.0);  // no unknown of the fit
  EXPECT_EQ(c.row(3).norm(), 0.0);
}

}  // namespace
}  // namespace myoid::run
