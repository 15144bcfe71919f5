#include "myoid/results/parameter_files.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/fit/intervals/estimate_columns.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/tables/csv_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

fit::IdentificationResult one_estimate() {
  fit::ParameterEstimate e;
  e.muscle = "BIC";
  e.parameter = "optimal_fiber_length";
  e.unit = Unit::meter;
  e.method = fit::Method::torque;
  e.initial = 0.1;
  e.estimate = 0.1 + 0.2;
  e.std_error = std::numeric_limits<double>::infinity();
  e.ci_low = 0.25;
  e.reason = "known to \"12 %\", about";
  fit::IdentificationResult result;
  result.method = fit::Method::torque;
  result.estimates = {e};
  return result;
}

TEST(ParametersCsv, ANumberReadsBackTheSameAndWhatIsAbsentOrInfiniteIsAnEmptyCell) {
  const test::TemporaryFolder folder;
  write_file(folder / "p.csv", parameters_csv({one_estimate()}));
  const recording::CsvTable table = recording::read_csv_table(folder / "p.csv");
  const auto cell = [&](const std::string& name) {
    const auto it = std::find(table.names.begin(), table.names.end(), name);
    return table.rows.at(0).at(static_cast<std::size_t>(it - table.names.begin()));
  };
  EXPECT_EQ(std::stod(cell("estimate")), 0.1 + 0.2);
  EXPECT_EQ(cell("std_error"), "");
  EXPECT_EQ(cell("ci_low"), "0.25");
  EXPECT_EQ(cell("ci_high"), "");
  EXPECT_EQ(cell("reason"), "known to \"12 %\", about");
}

TEST(ParametersCsv, ThePosteriorHasTheSourcesOfTheVarianceAndItsSecondReading) {
  const std::string plain = parameters_csv({one_estimate()});
  EXPECT_EQ(plain.find("variance_"), std::string::npos);
  fit::IdentificationResult result = one_estimate();
  result.estimates[0].variance_shares = {0.5, 0.25, 0.125, 0.0625, 0.0625, 0.0};
  result.estimates[0].given_estimate = 0.28;
  result.estimates[0].given_ci_low = 0.25;
  const test::TemporaryFolder folder;
  write_file(folder / "p.csv", parameters_csv({result}));
  const recording::CsvTable table = recording::read_csv_table(folder / "p.csv");
  const auto cell = [&](const std::string& name) {
    const auto it = std::find(table.names.begin(), table.names.end(), name);
    return table.rows.at(0).at(static_cast<std::size_t>(it - table.names.begin()));
  };
  EXPECT_EQ(cell("variance_noise"), "0.5");
  EXPECT_EQ(cell("variance_geometry"), "0.125");
  EXPECT_EQ(cell("variance_model"), "0");
  EXPECT_EQ(cell("given_estimate"), "0.28");
  EXPECT_EQ(cell("given_ci_low"), "0.25");
  EXPECT_EQ(cell("given_ci_high"), "");
}

TEST(PosteriorCsv, HasARowForEachDrawAndAColumnForEachUnknown) {
  fit::IdentificationResult result = one_estimate();
  result.free_parameters = {"BIC.optimal_fiber_length", "subject.emg_delay"};
  result.draws.resize(2, 3);
  result.draws << 0.125, 0.25, 0.5, 0.0625, 0.03125, 0.5;
  result.draw_weights.resize(3);
  result.draw_weights << 0.5, 0.25, 0.25;
  EXPECT_EQ(posterior_csv(result),
            "weight,BIC.optimal_fiber_length,subject.emg_delay\n0.5,0.125,0.0625\n"
            "0.25,0.25,0.03125\n0.25,0.5,0.5\n");
  const test::TemporaryFolder folder;
  write_parameter_files({one_estimate()}, {}, {}, {}, folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder / "posterior.csv"));
  write_parameter_files({result}, {}, {}, {}, folder.path());
  EXPECT_TRUE(std::filesystem::exists(folder / "posterior.csv"));
}

TEST(ParametersJson, ARowReadsBackTheSameInEveryColumn) {
  fit::IdentificationResult result = one_estimate();
  fit::ParameterEstimate& e = result.estimates.front();
  e.std_error = 0.01;
  e.prior_mean = 0.11;
  e.prior_distance = 1.0 / 3.0;
  e.at_bound = true;
  e.verdict = fit::Verdict::prior_dominated;
  e.tied_to = "BRA";
  const auto json = nlohmann::json::parse(parameters_json({result}, {}, {}));
  const nlohmann::json& row = json.at("methods").at(0).at("estimates").at(0);
  const auto read = fit::estimate_of_json(row);
  ASSERT_TRUE(read);
  for (const fit::EstimateColumn& column : fit::estimate_columns()) {
    std::visit([&](const auto member) { EXPECT_EQ(*read.*member, e.*member) << column.name; }, column.member);
  }
  EXPECT_EQ(read->tied_to, "BRA");
  nlohmann::json without = row;
  without["estimate"] = nullptr;
  EXPECT_FALSE(fit::estimate_of_json(without));
  without = row;
  without.erase("verdict");
  EXPECT_THROW(static_cast<void>(fit::estimate_of_json(without)), nlohmann::json::exception);
}

TEST(ParametersJson, MethodPaperHasNoNoiseAndNoDelay) {
  fit::IdentificationResult torque = one_estimate();
  torque.delay_s = 0.05;
  fit::IdentificationResult paper = torque;
  paper.method = fit::Method::paper;
  const auto json = nlohmann::json::parse(parameters_json({torque, paper}, {}, {}));
  EXPECT_EQ(json.at("methods").at(0).at("emg_delay_s"), 0.05);
  EXPECT_TRUE(json.at("methods").at(1).at("emg_delay_s").is_null());
  EXPECT_TRUE(json.at("methods").at(0).at("estimates").at(0).at("std_error").is_null());
}

TEST(ParametersJson, LeftOutIsTheKindOfAFoldOrThatTrialsWereHeldBack) {
  const auto left_out = [](const fit::IdentificationResult& result, std::size_t folds) {
    const std::vector<fit::Fold> of(folds);
    return nlohmann::json::parse(parameters_json({result}, of, {}, {.left_out = "block"})).at("left_out");
  };
  fit::IdentificationResult result = one_estimate();
  EXPECT_EQ(left_out(result, 0), "none");
  EXPECT_EQ(left_out(result, 2), "block");
  result.trials.resize(2);
  result.trials[1].calibration = false;
  EXPECT_EQ(left_out(result, 0), "validation");
  EXPECT_EQ(left_out(result, 2), "block");
}

TEST(ParametersJson, SearchesTellWhereTheirStartsEnded) {
  fit::IdentificationResult torque = one_estimate();
  const auto none = nlohmann::json::parse(parameters_json({torque}, {}, {}));
  EXPECT_TRUE(none.at("methods").at(0).at("searches").empty());
  torque.basins = {
      {.fit = "all muscles",
       .starts = 12,
       .failed = 2,
       .basins = {{.cost = 4.5, .starts = 9, .converged = 8, .rival = true},
                  {.cost = 5.5, .starts = 1, .converged = 1, .distance = 1.25, .rival = true, .given = true}}}};
  const auto json = nlohmann::json::parse(parameters_json({torque}, {}, {}));
  const auto& searches = json.at("methods").at(0).at("searches").at(0);
  EXPECT_EQ(searches.at("fit"), "all muscles");
  EXPECT_EQ(searches.at("starts"), 12);
  EXPECT_EQ(searches.at("starts_without_a_minimum"), 2);
  ASSERT_EQ(searches.at("basins").size(), 2U);
  const auto& second = searches.at("basins").at(1);
  EXPECT_EQ(second.at("cost"), 5.5);
  EXPECT_EQ(second.at("starts"), 1);
  EXPECT_EQ(second.at("distance"), 1.25);
  EXPECT_EQ(second.at("as_good_as_the_best"), true);
  EXPECT_EQ(second.at("of_the_given_start"), true);
  EXPECT_EQ(searches.at("basins").at(0).at("converged"), 8);
}

}  // namespace
}  // namespace myoid::results
