#include "myoid/results/paper_tables.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;
using fit::PublishedSearch;
using math::Termination;

ParameterEstimate number(const std::string& muscle, fit::FitCase branch, const std::string& name, double value) {
  ParameterEstimate e;
  e.muscle = muscle;
  e.fit_case = branch;
  e.parameter = name;
  e.method = fit::Method::paper;
  e.initial = 0.14;
  e.estimate = value;
  e.verdict = fit::Verdict::prior_dominated;
  e.reason = "nobody measured the force";
  return e;
}

IdentificationResult two_branches() {
  IdentificationResult method;
  method.method = fit::Method::paper;
  method.estimates = {number("BIC", fit::FitCase::shortening, "optimal_fiber_length", 0.131),
                      number("BIC", fit::FitCase::shortening, "concentric_curvature", 0.27),
                      number("BIC", fit::FitCase::lengthening, "optimal_fiber_length", 0.14)};
  method.published = {
      {.muscle = "BIC",
       .fit_case = fit::FitCase::shortening,
       .termination = Termination::converged,
       .iterations = 9,
       .start_cost = 800.0,
       .cost = 20.0,
       .plain = Termination::no_descent,
       .plain_iterations = 1},
      {.muscle = "BIC", .fit_case = fit::FitCase::lengthening, .message = "only 3 samples in lengthening"}};
  return method;
}

TEST(PaperTables, HaveThePapersColumnsAndStartAndMinimumOfEachMuscle) {
  const std::vector<page::Table> tables = paper_tables(two_branches());
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_EQ(tables[0].id, "table_1_shortening");
  EXPECT_EQ(tables[1].id, "table_2_lengthening");
  ASSERT_EQ(tables[0].columns.size(), 6U);  // muscle, x, three unknowns, the criterion
  ASSERT_EQ(tables[1].columns.size(), 7U);
  for (const page::Table& table : tables) {
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.id;
  }
  const auto& rows = tables[0].rows;
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0][1].text, "x_init");
  EXPECT_EQ(rows[0][2].text, "0.14");
  EXPECT_EQ(rows[1][2].text, "0.131");
  EXPECT_EQ(rows[1][2].hint, "nobody measured the force");
  EXPECT_EQ(rows[1][3].text, "held") << "the width is no unknown here";
  EXPECT_EQ(rows[1][4].text, "0.27");
  EXPECT_EQ(rows[1][5].text, "20");
  EXPECT_EQ(tables[1].rows[1][2].text, "–") << "no search";
}

TEST(PaperTables, SayHowBothSearchesEnded) {
  IdentificationResult method = two_branches();
  const auto row = [&](std::size_t r) {
    const std::vector<page::Cell> cells = paper_tables(method).at(2).rows.at(r);
    return cells.at(2).text + "; " + cells.at(3).text;
  };
  PublishedSearch& first = method.published[0];
  EXPECT_EQ(row(0), "minimum of the published criterion after 9 steps; diverged after 1 step");
  EXPECT_EQ(row(1), "only 3 samples in lengthening; –");
  first.plain = Termination::converged;
  first.damped = true;
  EXPECT_EQ(row(0), "minimum of the published criterion after 9 damped steps; the same minimum after 1 step");
  first.plain_elsewhere = true;
  first.termination = Termination::no_descent;
  first.message = "no step lowers the cost";
  EXPECT_EQ(row(0), "no minimum after 9 steps: no step lowers the cost; converged to another point after 1 step");
}

TEST(PaperSection, IsFoldedAndHasTheSolversThatTheStudyCompares) {
  run::StudyFit fit;
  fit.methods = {two_branches()};
  const page::Section section = paper_section(fit, true);
  EXPECT_TRUE(section.folded);
  EXPECT_EQ(section.tables.size(), 3U);
  fit.contests = {{.fit = "BIC shortening", .runs = {{.solver = "gauss_newton", .cost = 0.1234567890123}}},
                  {.fit = "BIC lengthening"}};
  const page::Table solvers = paper_section(fit, false).tables.at(3);
  ASSERT_EQ(solvers.rows.size(), 1U);
  EXPECT_EQ(solvers.rows[0][0].text, "BIC shortening");
  EXPECT_EQ(solvers.rows[0][3].text, "0.1234567890123") << "solvers.csv has every digit";
}

}  // namespace
}  // namespace myoid::results
