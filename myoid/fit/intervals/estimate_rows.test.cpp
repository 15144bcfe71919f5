#include "myoid/fit/intervals/estimate_rows.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

TEST(ActiveLengths, AreThoseOfAMuscleWhileItWasActive) {
  StudyData data;
  MuscleSetup setup;
  setup.name = setup.emg_channel = "M";
  setup.start.max_shortening_speed_mps = 1.0;
  data.muscles.push_back(setup);
  constexpr Eigen::Index n = 101;
  TrialData trial;
  trial.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0);
  trial.length_m = Eigen::MatrixXd::Constant(n, 1, 0.1);
  trial.velocity_mps = Eigen::MatrixXd::Zero(n, 1);
  Eigen::MatrixXd activation = Eigen::MatrixXd::Constant(n, 1, 0.3);
  activation.bottomRows(50).setConstant(0.01);
  trial.activation = TimeSeries(trial.time_s, {{"M", Unit::dimensionless}}, activation);
  trial.length_m.topRows(50).col(0) = Eigen::VectorXd::LinSpaced(50, 0.1, 0.2);
  data.trials = {trial};
  // Without a tenth of a second at either end of half a second.
  EXPECT_NEAR(active_length_spans_m(data, 0.0).at(0), 0.06, 0.005);
  trial.length_m.topRows(50).setConstant(0.1);
  trial.length_m.bottomRows(50).col(0) = Eigen::VectorXd::LinSpaced(50, 0.1, 0.2);  // while at rest
  data.trials = {trial};
  EXPECT_NEAR(active_length_spans_m(data, 0.0).at(0), 0.0, 1e-12);
}

TEST(EquivalentDeviations, AreThoseOfTheChiSquareDistribution) {
  // Tables: P(chi2_k > x) = 0.0027 (three standard deviations) at x = 9.00, 11.83, 16.25, 20.06 for
  // k = 1, 2, 4, 6, and 0.05 at x = 12.592 for k = 6. Their digits
  // leave 0.001.
  for (const auto& [k, x] : {std::pair{1, 9.0}, {2, 11.83}, {4, 16.25}, {6, 20.06}})
    EXPECT_NEAR(equivalent_deviations(x, k), 3.0, 0.001) << k;
  EXPECT_NEAR(equivalent_deviations(12.592, 6), 1.95996, 0.001);
  EXPECT_EQ(equivalent_deviations(0.0, 4), 0.0);
  EXPECT_GT(equivalent_deviations(400.0, 6), 8.0);
  EXPECT_EQ(equivalent_deviations(1e5, 6), std::sqrt(1e5));  // a tail below the smallest number
}

TEST(PriorDistances, AboveThreeMakeALineThatNamesTheMuscleAndTheFarthestNumber) {
  std::vector<Remark> lines;
  add_distances_to(lines, {{"BIC", 2.9, "force_length_width", 2.0}, {"TRI", 1.0, "max_isometric_force", 3.4}});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].code, RemarkCode::far_from_prior);
  EXPECT_EQ(lines[0].about, "TRI");
  EXPECT_NE(lines[0].says.find("max_isometric_force 3.4"), std::string::npos) << lines[0].says;
}

TEST(DistanceFromPrior, CountsInSpreadsOfWhatTheSolverSees) {
  Unknown strength;
  strength.prior.mean = std::log(1000.0);
  strength.prior.sd = 0.25;
  EXPECT_NEAR(distance_from_prior(strength, std::log(400.0)), std::log(2.5) / 0.25, 1e-12);
  EXPECT_NEAR(distance_from_prior(strength, std::log(2500.0)), std::log(2.5) / 0.25, 1e-12);
}

}  // namespace
}  // namespace myoid::fit
