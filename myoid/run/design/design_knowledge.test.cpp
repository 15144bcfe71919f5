#include "myoid/run/design/design_knowledge.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::run {
namespace {

using fit::Unknown;

/// F_max of two muscles, on a logarithmic scale, and a fiber length without prior.
std::vector<Unknown> three() {
  const auto of = [](const char* muscle, const char* name, double start, double sd) {
    Unknown f;
    f.field = &fit::parameter_field(name);
    f.owner = muscle;
    f.label = std::string(muscle) + "." + name;
    f.start = f.prior.mean = start;
    f.bounds.lower = start - 2.0;
    f.bounds.upper = start + 2.0;
    f.prior.sd = sd;
    return f;
  };
  return {of("BIC", "max_isometric_force", std::log(1000.0), 0.25),
          of("BRA", "max_isometric_force", std::log(800.0), 0.25), of("BIC", "optimal_fiber_length", 0.12, 0.0)};
}

TEST(DesignKnowledge, WithoutARunItIsThePriorsAndAQuarterOfTheBoundsWhereThereIsNone) {
  const Knowledge known = knowledge_of(three(), std::nullopt);
  EXPECT_NEAR(known.covariance(0, 0), 0.0625, 1e-12);
  EXPECT_NEAR(known.covariance(2, 2), 1.0, 1e-12);
  EXPECT_NEAR(known.mean[1], std::log(800.0), 1e-12);
  EXPECT_LT((known.precision * known.covariance - Eigen::Matrix3d::Identity()).norm(), 1e-9);
}

TEST(DesignKnowledge, NumbersThatARunTiesToEachOtherHaveAnInverseToSevenDigits) {
  EarlierRun run;
  run.parameters = {"BRA.max_isometric_force", "BIC.max_isometric_force"};
  run.estimate = Eigen::Vector2d(700.0, 900.0);
  run.covariance = (Eigen::Matrix2d() << 0.01, 0.01, 0.01, 0.01 + 1e-13).finished();
  const Knowledge known = knowledge_of(three(), run);
  EXPECT_LT((known.precision * known.covariance - Eigen::Matrix3d::Identity()).norm(), 1e-7);
}

TEST(DesignKnowledge, ARunReplacesWhatItFittedAndLeavesTheRest) {
  EarlierRun run;
  run.parameters = {"BRA.max_isometric_force", "BIC.max_isometric_force"};
  run.estimate = Eigen::Vector2d(700.0, 900.0);
  run.covariance = (Eigen::Matrix2d() << 0.01, 0.002, 0.002, 0.02).finished();
  const Knowledge known = knowledge_of(three(), run);
  EXPECT_NEAR(known.mean[0], std::log(900.0), 1e-12);
  EXPECT_NEAR(known.covariance(0, 0), 0.02, 1e-9);
  EXPECT_NEAR(known.covariance(0, 1), 0.002, 1e-9);
  EXPECT_NEAR(known.covariance(2, 2), 1.0, 1e-9);
  run.covariance(0, 0) = std::nan("");
  EXPECT_THROW((void)knowledge_of(three(), run), InvalidInput);
}

TEST(DesignKnowledge, ThePersonsSpreadAsTheKnowledgeDoesAndKeepToTheBounds) {
  const std::vector<Unknown> free = three();
  const Knowledge known = knowledge_of(free, std::nullopt);
  const std::vector<Eigen::VectorXd> persons = draw_persons(free, known, 4001, 7);
  EXPECT_EQ(persons[0], known.mean);
  double square = 0.0;
  for (std::size_t k = 1; k < persons.size(); ++k) {
    square += std::pow(persons[k][0] - known.mean[0], 2);
    EXPECT_LE(persons[k][2], free[2].bounds.upper);
    EXPECT_GE(persons[k][2], free[2].bounds.lower);
  }
  // The variance of 4000 normal numbers is known to 2.2 % (one standard deviation).
  EXPECT_NEAR(square / 4000.0, 0.0625, 0.0625 * 0.09);
  EXPECT_EQ(draw_persons(free, known, 3, 7)[2], persons[2]);
}

TEST(DesignKnowledge, TargetsAreNamedByOwnerParameterOrBoth) {
  EXPECT_EQ(targets_of(three(), {"BIC"}), (std::vector<Eigen::Index>{0, 2}));
  EXPECT_EQ(targets_of(three(), {"max_isometric_force"}), (std::vector<Eigen::Index>{0, 1}));
  EXPECT_EQ(targets_of(three(), {"BRA.max_isometric_force"}), (std::vector<Eigen::Index>{1}));
  EXPECT_THROW((void)targets_of(three(), {"BIC", "SOL"}), InvalidInput);
}

TEST(DesignKnowledge, AnIntervalOfARunNarrowsOnItsOwnScale) {
  const std::vector<Unknown> free = three();
  std::optional<EarlierRun> run(std::in_place);
  fit::ParameterEstimate row;
  row.muscle = "BIC";
  row.parameter = "max_isometric_force";
  row.estimate = 1000.0;
  row.ci_low = 500.0;
  row.ci_high = 2000.0;
  run->estimates = {row};
  ASSERT_EQ(found_by(run, free[0]), &run->estimates[0]);
  EXPECT_EQ(found_by(run, free[1]), nullptr);
  const fit::ParameterEstimate half = expected_estimate(
      free[0], {.mean = std::log(1000.0), .sd = 0.1, .prior_sd = 0.25, .found = found_by(run, free[0]), .ratio = 0.5});
  // Half of a factor of two to either side is a factor of the square root of two.
  EXPECT_NEAR(*half.ci_low, 1000.0 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(*half.ci_high, 1000.0 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(*half.shrinkage, 1.0 - 0.16, 1e-12);
}

}  // namespace
}  // namespace myoid::run
