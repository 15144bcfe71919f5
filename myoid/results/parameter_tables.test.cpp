#include "myoid/results/parameter_tables.h"

#include <gtest/gtest.h>

#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/page/parameter_words.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;

ParameterEstimate estimate(std::string owner, std::string parameter, double value) {
  ParameterEstimate e;
  e.muscle = std::move(owner);
  e.parameter = std::move(parameter);
  e.method = fit::Method::torque;
  e.estimate = value;
  e.ci_low = value - 0.01;
  e.ci_high = value + 0.01;
  return e;
}

IdentificationResult two_muscles() {
  IdentificationResult method;
  method.method = fit::Method::torque;
  method.estimates = {estimate("BIC", "optimal_fiber_length", 0.14), estimate("BIC", "length_activation", 0.1),
                      estimate("TRI", "length_activation", 0.1), estimate("TRI", "optimal_fiber_length", 0.12),
                      estimate("BIC", "emg_gain", 1.0)};
  method.estimates[2].tied_to = "BIC";
  return method;
}

TEST(EstimateTables, EveryNumberHasAMeaningForPeople) {
  for (const fit::ParameterField& field : fit::parameter_fields())
    EXPECT_NE(page::parameter_meaning(field.name), "") << field.name;
}

TEST(EstimateLines, TellTiedNumbersOnceAndNuisancesLast) {
  const IdentificationResult method = two_muscles();
  const std::vector<EstimateLine> lines = estimate_lines(method, 2);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].owners, "BIC");
  EXPECT_EQ(lines[1].owners, "TRI");
  EXPECT_EQ(lines[1].estimate->parameter, "optimal_fiber_length");
  EXPECT_EQ(lines[2].owners, "all muscles");
  EXPECT_EQ(lines[3].estimate->parameter, "emg_gain");
  EXPECT_EQ(estimate_lines(method, 3)[2].owners, "BIC, TRI");
}

TEST(EstimateLines, KeepApartWhatIsTiedByARatio) {
  IdentificationResult method = two_muscles();
  method.estimates[2].estimate = 0.05;
  EXPECT_EQ(estimate_lines(method, 2).size(), 5U);
}

TEST(EstimateTables, ShowTheTruthAsWideAsTheIntervalAndWhetherItLiesInside) {
  run::StudyResult result;
  result.source.truth = {{"BIC", "optimal_fiber_length", 0.145}, {"TRI", "optimal_fiber_length", 0.15}};
  result.fit_input.data.muscles.resize(2);
  const std::vector<page::Table> tables = estimate_tables(result, two_muscles());
  ASSERT_EQ(tables.size(), 3U);
  const auto& rows = tables[0].rows;
  ASSERT_EQ(rows.size(), 3U);
  ASSERT_EQ(tables[0].columns[6], "truth");
  EXPECT_EQ(rows[0][4].text, "0.140");
  EXPECT_EQ(rows[0][5].text, "0.130 to 0.150");
  EXPECT_EQ(rows[0][6].text, "0.145");
  EXPECT_EQ(rows[0][6].badge, page::Badge::good);
  EXPECT_EQ(rows[1][6].badge, page::Badge::weak);
  EXPECT_EQ(rows[2][6].text, "-");
  ASSERT_EQ(tables[1].rows.size(), 1U);
  EXPECT_EQ(tables[1].rows[0][1].text, "EMG gain");
}

TEST(TruthOf, AStrengthIsThatOfFullEffort) {
  run::StudyResult result;
  result.source.truth = {{"BIC", "max_isometric_force", 900.0}, {"BIC", "optimal_fiber_length", 0.14}};
  result.fit.methods.push_back(two_muscles());
  result.fit.methods[0].voluntary.emplace_back();
  const auto strength = [&] { return truth_of(result, estimate("BIC", "max_isometric_force", 500.0)); };
  EXPECT_EQ(strength(), 900.0);
  result.fit.methods[0].voluntary[0].from_mvc = false;  // the estimate is of the largest EMG
  EXPECT_EQ(strength(), std::nullopt);
  EXPECT_EQ(truth_of(result, estimate("BIC", "optimal_fiber_length", 0.13)), 0.14);
}

TEST(EstimateTables, AnIntervalBeyondAllMeaningIsNone) {
  ParameterEstimate e = estimate("BIC", "optimal_fiber_length", 0.1338);
  e.initial = 0.14;
  EXPECT_FALSE(is_undetermined(e));
  e.ci_low = -1.46e16;
  e.ci_high = 1.46e16;
  EXPECT_TRUE(is_undetermined(e));
}

TEST(EstimateTables, ANumberThatIsZeroHasItsInterval) {
  ParameterEstimate e;
  e.parameter = "joint_viscosity";
  e.ci_low = 0.0;
  e.ci_high = 0.3;
  EXPECT_FALSE(is_undetermined(e));
  e.ci_high = 1e4;
  EXPECT_TRUE(is_undetermined(e));
}

TEST(EstimateTables, AreCalledByTheirMethod) {
  IdentificationResult method = two_muscles();
  method.method = fit::Method::force;
  const std::vector<page::Table> tables = estimate_tables({}, method);
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_EQ(tables[0].id, "parameters_force");
  EXPECT_EQ(tables[0].title, "Identified parameters (method force)");
  EXPECT_NE(tables[0].caption.find("force that force sharing assigned"), std::string::npos);
  EXPECT_EQ(tables[1].id, "nuisances_force");
  EXPECT_EQ(tables[2].id, "meanings_force");
  EXPECT_EQ(tables[2].rows.size(), 3U);
}

TEST(BasinTables, HaveARowForEachMinimumAndOneForStartsThatFoundNone) {
  IdentificationResult method = two_muscles();
  EXPECT_TRUE(basin_tables(method).empty());
  method.basins = {
      {.fit = "BIC",
       .starts = 12,
       .failed = 2,
       .basins = {{.cost = 4.5, .starts = 8, .converged = 7, .rival = true},
                  {.cost = 5.5, .starts = 2, .converged = 2, .distance = 1.25, .rival = true, .given = true}}},
      {.fit = "TRI", .starts = 12, .basins = {{.cost = 1.0, .starts = 12}}}};
  const std::vector<page::Table> tables = basin_tables(method);
  ASSERT_EQ(tables.size(), 1U);
  const auto& rows = tables[0].rows;
  ASSERT_EQ(rows.size(), 4U);
  for (const auto& row : rows) EXPECT_EQ(row.size(), tables[0].columns.size());
  EXPECT_EQ(rows[0][3].badge, page::Badge::weak);
  EXPECT_EQ(rows[0][4].hint, "") << "the best is no rival of its own";
  EXPECT_EQ(rows[1][1].text, "5.5");
  EXPECT_EQ(rows[1][4].text, "1.2");
  EXPECT_EQ(rows[1][4].hint, "as good as the best");
  EXPECT_EQ(rows[1][5].text, "ends here");
  EXPECT_EQ(rows[2][2].text, "2");
  EXPECT_EQ(rows[3][0].text, "TRI");
}

}  // namespace
}  // namespace myoid::results
