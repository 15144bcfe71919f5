#include "myoid/intervals/estimate_remarks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

ParameterEstimate routes(const std::string& parameter, double narrow, double wide) {
  ParameterEstimate e;
  e.muscle = "BIC";
  e.parameter = parameter;
  e.estimate = 1.0;
  e.routes = {{"sandwich", 1.0 - narrow, 1.0 + narrow}, {"cluster", 1.0 - wide, 1.0 + wide}};
  return e;
}

TEST(RouteRemarks, SayOnceWhichNumbersDisagreeAndByHowMuchAtMost) {
  RouteRemarks remarks;
  std::vector<ParameterEstimate> estimates{routes("a", 0.1, 0.14), routes("b", 0.1, 0.2), routes("c", 0.1, 0.35),
                                           routes("d", 1e-300, 1e200)};
  for (ParameterEstimate& e : estimates) remarks.compare(e);
  EXPECT_FALSE(estimates[0].routes_disagree);
  EXPECT_TRUE(estimates[1].routes_disagree);
  std::vector<std::string> lines;
  remarks.add_to(lines, estimates.size());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("3 of 4 numbers, most for BIC d"), std::string::npos) << lines[0];
  EXPECT_NE(lines[0].find("over 100"), std::string::npos) << lines[0];
  EXPECT_LT(lines[0].size(), 260U);
}

TEST(RouteRemarks, AreSilentOnWhatChanceMakesOfTheirWidths) {
  // Five equal trials tell a variance to sqrt(2 / 5), a width to 0.32. Three such spreads are a factor of 2.6.
  for (const auto& [wide, disagree] : {std::pair{0.25, false}, std::pair{0.28, true}}) {
    ParameterEstimate e = routes("a", 0.1, wide);
    e.estimate = 1.0;
    e.routes[1].spread = std::sqrt(0.5 / 5.0);
    RouteRemarks remarks;
    remarks.compare(e);
    EXPECT_EQ(e.routes_disagree, disagree) << wide;
  }
}

TEST(RouteRemarks, AreSilentOnWidthsThatNoVerdictHangsOn) {
  // Identified is what may be off by 12 %: a tenth of that is nothing.
  for (const auto& [scale, disagree] : {std::pair{0.01, false}, std::pair{0.02, true}}) {
    ParameterEstimate e = routes("a", 0.1 * scale, scale);
    e.estimate = 1.0;
    RouteRemarks remarks;
    remarks.compare(e);
    EXPECT_EQ(e.routes_disagree, disagree) << scale;
  }
}

TEST(RouteRemarks, SayWhetherTheReportedIntervalIsTheWider) {
  const auto line_for = [](double half) {
    ParameterEstimate e = routes("a", 0.1, 0.3);
    e.ci_low = 1.0 - half;
    e.ci_high = 1.0 + half;
    RouteRemarks remarks;
    remarks.compare(e);
    std::vector<std::string> lines;
    remarks.add_to(lines, 1);
    return lines.at(0);
  };
  EXPECT_NE(line_for(0.3).find("the wider one is what is reported"), std::string::npos);
  EXPECT_NE(line_for(0.1).find("for 1 of them a route is wider"), std::string::npos);
}

TEST(ActiveMotion, IsWhatAMuscleDidWhileItWasActive) {
  StudyData data;
  MuscleSetup setup;
  setup.name = setup.emg_channel = "M";
  setup.start.max_shortening_speed_mps = 1.0;
  data.muscles.push_back(setup);
  constexpr Eigen::Index n = 101;
  TrialData trial;
  trial.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0);
  trial.length_m = Eigen::MatrixXd::Constant(n, 1, 0.1);
  trial.velocity_mps = Eigen::MatrixXd::Constant(n, 1, -0.1);
  trial.velocity_mps.bottomRows(50).setConstant(0.1);  // while at rest
  Eigen::MatrixXd activation = Eigen::MatrixXd::Constant(n, 1, 0.3);
  activation.bottomRows(50).setConstant(0.01);
  trial.activation = TimeSeries(trial.time_s, {{"M", Unit::dimensionless}}, activation);
  data.trials.push_back(trial);
  const ActiveMotion motion = active_motion(data, 0.0).at(0);
  EXPECT_TRUE(motion.shortened);
  EXPECT_FALSE(motion.lengthened);
  Unknown plateau, curvature;
  plateau.field = &parameter_field("eccentric_plateau");
  curvature.field = &parameter_field("concentric_curvature");
  EXPECT_EQ(never_done(plateau, motion, false), "lengthened");
  EXPECT_EQ(never_done(curvature, motion, false), "");
  EXPECT_EQ(never_done(curvature, {}, false), "shortened");
  EXPECT_EQ(never_done(curvature, {.lengthened = true}, true), "");
}

TEST(KnownBeforehand, IsTheStudysTheLiteraturesOrAnyEffort) {
  Unknown strength;
  strength.field = &parameter_field("max_isometric_force");
  EXPECT_EQ(known_beforehand(strength, true), "the literature's value");
  EXPECT_NE(known_beforehand(strength, false).find("1/20 to 1"), std::string::npos);
  strength.prior_is_given = true;
  EXPECT_EQ(known_beforehand(strength, true), "what the study gave beforehand");
  Unknown delay;
  delay.field = &parameter_field("emg_delay");
  EXPECT_EQ(known_beforehand(delay, true), "what is expected beforehand");
}

TEST(RouteRemarks, ARouteOfEndlessWidthDoesNotDisagreeWithItself) {
  ParameterEstimate e;
  e.parameter = "max_isometric_force";
  e.estimate = 1.0;
  e.routes = {{"sandwich", 0.0, std::numeric_limits<double>::infinity(), 0.0}};
  RouteRemarks routes;
  routes.compare(e);
  EXPECT_FALSE(e.routes_disagree);
}

TEST(RouteRemarks, SayOnceWhichProfilesAreOpen) {
  RouteRemarks remarks;
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) {
    ParameterEstimate e = routes(name, 0.1, 0.1);
    e.routes.push_back({"profile", 0.9, {}});
    remarks.compare(e);
  }
  std::vector<std::string> lines;
  remarks.add_to(lines, 8);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("6 of 8 numbers (BIC a, BIC b, BIC c, BIC d, ...)"), std::string::npos) << lines[0];
}

TEST(AgreeOnTied, TheWorstVerdictIsThatOfAll) {
  const auto owner = [](const char* muscle, const char* tied_to, Verdict verdict) {
    ParameterEstimate e;
    e.muscle = muscle;
    e.tied_to = tied_to;
    e.verdict = verdict;
    e.reason = muscle;
    return e;
  };
  std::vector<ParameterEstimate> estimates{owner("X", "", Verdict::identified), owner("BIC", "", Verdict::identified),
                                           owner("BRA", "BIC", Verdict::weak),
                                           owner("TRI", "BIC", Verdict::identified)};
  agree_on_tied(estimates, 3);
  EXPECT_EQ(estimates[0].verdict, Verdict::identified);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(estimates[i].verdict, Verdict::weak) << i;
    EXPECT_EQ(estimates[i].reason, "BRA") << i;
  }
}

TEST(PriorDistances, AboveThreeMakeALineThatNamesTheMuscleAndTheFarthestNumber) {
  std::vector<std::string> lines;
  add_distances_to(lines, {{"BIC", 2.9, "force_length_width", 2.0}, {"TRI", 1.0, "max_isometric_force", 3.4}});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].find("TRI has left"), 0U) << lines[0];
  EXPECT_NE(lines[0].find("max_isometric_force 3.4"), std::string::npos) << lines[0];
}

TEST(DistanceFromPrior, CountsInSpreadsOfWhatTheSolverSees) {
  Unknown strength;
  strength.prior.mean = std::log(1000.0);
  strength.prior.sd = 0.25;
  EXPECT_NEAR(distance_from_prior(strength, std::log(400.0)), std::log(2.5) / 0.25, 1e-12);
  EXPECT_NEAR(distance_from_prior(strength, std::log(2500.0)), std::log(2.5) / 0.25, 1e-12);
}

TEST(LagRemark, SaysWhatWasChosenAndWhetherTheRecordingTells) {
  IdentificationResult result;
  EXPECT_EQ(lag_remark(result), "");
  result.shared_lag_gain = -3.9;
  EXPECT_NE(lag_remark(result).find("with a delay that leaves its shape"), std::string::npos);
  EXPECT_NE(lag_remark(result).find("hardly tells"), std::string::npos);
  result.lag = EmgLag::shared;
  result.shared_lag_gain = 4.1;
  EXPECT_NE(lag_remark(result).find("with the lags of excitation"), std::string::npos);
  EXPECT_NE(lag_remark(result).find("chi-square less by 4"), std::string::npos);
}

}  // namespace
}  // namespace myoid::identification
