#include "myoid/results/cohort/group_report.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/record_list.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// A run that found this F_max with a standard error of 20 N.
fs::path run(const fs::path& folder, double strength) {
  write_file(folder / "parameters.csv",
             fmt::format("muscle,parameter,unit,method,case,estimate,ci_low,ci_high,verdict\n"
                         "BIC,max_isometric_force,N,paper,both,1,1,1,weak\n"
                         "BIC,max_isometric_force,N,torque,both,{},{},{},identified\n",
                         strength, strength - 40, strength + 40));
  write_file(folder / "parameters.json",
             fmt::format(
                 R"({{"methods": [{{"method": "torque", "r2": 0.75, "estimates": [{{"muscle": "BIC",
              "parameter": "max_isometric_force", "unit": "N", "method": "torque", "case": "both",
              "estimate": {}, "std_error": 20, "ci_low": {}, "ci_high": {},
              "verdict": "identified"}}], "trials": []}}],
              "leave_one_trial_out": [{{"identified": {{"r2": 0.5, "rmse_nm": 3}}}},
                                      {{"identified": {{"r2": 0.7, "rmse_nm": 1}}}},
                                      {{"identified": {{"r2": null, "rmse_nm": 2}}}}]}})",
                 strength, strength - 40, strength + 40));
  write_file(folder / "report.json",
             R"({"gates": [{"name": "a", "status": "pass"}, {"name": "b", "status": "warn"}]})");
  write_file(folder / "report.html", "<html></html>");
  write_file(folder / "run.json", R"({"trials": [{"name": "lift", "marker_error_m": 0.004}, {"name": "emg",
             "marker_error_m": null}]})");
  return folder;
}

double value(const page::StripGrid& grid, std::size_t row, const std::string& name) {
  for (std::size_t c = 0; c < grid.columns.size(); ++c)
    if (grid.columns[c].name == name) return grid.rows[row].cells[c].value.value_or(-1.0);
  return -2.0;
}

TEST(GroupReport, HasTheRunsOfAFolderWithLinksAndQuality) {
  const test::TemporaryFolder folder;
  run(folder / "persons/one/result", 600);
  run(folder / "persons/two/result", 700);
  const page::Report page =
      group_report({.persons = {folder / "persons"}, .after = {}, .folder = folder / "pages/group"});
  page::validate(page);
  ASSERT_EQ(page.sections.size(), 1U);
  const page::StripGrid& quality = page.sections[0].grids.at(0);
  EXPECT_EQ(quality.rows[0].person, "one");
  EXPECT_EQ(quality.rows[1].page, "../../persons/two/result/report.html");
  EXPECT_EQ(value(quality, 0, "questions not passed"), 1.0);
  EXPECT_EQ(value(quality, 0, "R2 of the fitted samples"), 0.75);
  EXPECT_EQ(value(quality, 0, "R2 of trials left out"), 0.6);
  EXPECT_EQ(value(quality, 0, "torque error, left out"), 2.0);
  EXPECT_NEAR(value(quality, 0, "marker error, median frame"), 4.0, 1e-12);
  EXPECT_EQ(value(page.sections[0].grids.at(1), 1, "BIC"), 700.0);
}

TEST(GroupReport, OfTwoSessionsHasTheChangeAndTheSmallestThatShows) {
  const test::TemporaryFolder folder;
  std::vector<fs::path> before, after;
  for (const double change : {0.0, 30.0, 150.0}) {
    const std::string name = fmt::format("P{}", change);
    before.push_back(run(folder / "before" / name, 600));
    after.push_back(run(folder / "after" / name, 600 + change));
  }
  const page::Report page = group_report({.persons = before, .after = after, .folder = folder / "group"});
  page::validate(page);
  ASSERT_EQ(page.sections[0].id, "changes");
  const page::StripGrid& grid = page.sections[0].grids.at(0);
  const page::StripCell& most = grid.rows[2].cells[0];
  EXPECT_EQ(most.value, 150.0);
  EXPECT_NEAR(*most.value - *most.lower, 1.96 * 20.0 * std::sqrt(2.0), 0.01);
  EXPECT_EQ(most.verdict, "differs");
  EXPECT_EQ(grid.rows[1].cells[0].verdict, "no change");
  const std::vector<page::Cell>& row = page.sections[0].tables.at(0).rows.at(0);
  EXPECT_EQ(row[3].text, "3");
  EXPECT_EQ(row[4].text, "1");
  EXPECT_EQ(row[5].text, "60");   // mean of 0, 30, 150
  EXPECT_EQ(row[7].text, "156");  // 1.96 times their standard deviation, 79.4
  EXPECT_TRUE(page.headline.starts_with("P150: ")) << page.headline;
  // 1.96 standard errors of the difference of two times 20 N are 55.4 N, 9.2 % of 600 N.
  EXPECT_NE(page.headline.find("Biceps stronger: F_max larger by 150 N (25 %, 95 % 94.6 to 205 N); a change below"),
            std::string::npos)
      << page.headline;
  EXPECT_EQ(page.headline.find("P30: "), std::string::npos) << page.headline;
}

TEST(GroupReport, TwoSessionsAreComparedGivenGeometryAndSensors) {
  const test::TemporaryFolder folder;
  const auto session = [&](const char* name, double given) {
    const fs::path place = run(folder / name, 600);  // the person's number stays, with 40 N to either side
    std::string json = read_text_file(place / "parameters.json");
    json.insert(json.find("\"verdict\""),
                fmt::format(R"("given_estimate": {}, "given_ci_low": {}, "given_ci_high": {}, )", given, given - 10,
                            given + 10));
    write_file(place / "parameters.json", json);
    return place;
  };
  const page::Report page =
      group_report({.persons = {session("before", 600)}, .after = {session("after", 660)}, .folder = folder / "group"});
  const page::StripCell& cell = page.sections[0].grids.at(0).rows[0].cells[0];
  EXPECT_NEAR(*cell.value, 60.0, 0.1);
  // With another effort of 3 % in each session.
  EXPECT_NEAR(*cell.value - *cell.lower,
              std::sqrt(2.0 * 100.0 + std::pow(1.96 * 0.03, 2) * (600.0 * 600.0 + 660.0 * 660.0)), 0.02);
  EXPECT_EQ(cell.verdict, "differs");
}

/// Adds what a run of this coordinate and recording says of itself.
void add_provenance(const fs::path& folder, const std::string& coordinate, const std::string& sha256) {
  std::string json = read_text_file(folder / "parameters.json");
  json.insert(1, fmt::format(R"("provenance": {{"options": {{"model": {{"builtin": "arm4", "coordinate": ["{}"]}},
                                "muscle": [{{"name": "BIC"}}]}},
                                "inputs": [{{"path": "x/slow.trc", "sha256": "{}"}}]}}, )",
                             coordinate, sha256));
  write_file(folder / "parameters.json", json);
}

TEST(GroupReport, NamesPersonsWhoAreNotOfOneKind) {
  const test::TemporaryFolder folder;
  const fs::path anna = run(folder / "anna", 600), bernd = run(folder / "bernd", 700), knee = run(folder / "knee", 900);
  add_provenance(anna, "elbow_flexion", "11");
  add_provenance(bernd, "elbow_flexion", "22");
  add_provenance(knee, "knee_angle_r", "33");
  EXPECT_TRUE(group_report({.persons = {anna, bernd}, .after = {}, .folder = "x"}).gates.empty());
  const auto said = [&](const fs::path& third) {
    const page::Report page = group_report({.persons = {anna, bernd, third}, .after = {}, .folder = "x"});
    return page.gates.empty() ? std::string() : page.gates[0].value;
  };
  EXPECT_THAT(said(knee), HasSubstr("anna and knee: the coordinate is elbow_flexion here, knee_angle_r there"));
  fs::create_directories(folder / "again");
  fs::copy(bernd, folder / "again/bernd", fs::copy_options::recursive);
  EXPECT_THAT(said(folder / "again/bernd"), HasSubstr("both rest on the recording slow.trc"));
}

TEST(GroupReport, NamesFilesThatWereChangedSinceTheRun) {
  const test::TemporaryFolder folder;
  const fs::path anna = run(folder / "anna", 600);
  RecordContent list;
  list.commands = {"run"};
  list.files["parameters.csv"] = {{sha256(read_text_file(anna / "parameters.csv")), "run", true}};
  write_file(anna / std::string(kRecordFile), record_text(list));
  EXPECT_TRUE(group_report({.persons = {anna}, .after = {}, .folder = "x"}).gates.empty());
  write_file(anna / "parameters.csv", read_text_file(anna / "parameters.csv") +
                                          "TRI,max_isometric_force,N,torque,both,9,8,"
                                          "10,identified\n");
  const page::Report page = group_report({.persons = {anna}, .after = {anna}, .folder = "x"});
  ASSERT_EQ(page.gates.size(), 1U);
  EXPECT_THAT(page.gates[0].value, HasSubstr("parameters.csv: was changed since 'myoid run' wrote it"));
}

TEST(GroupReport, SaysWhatIsMissing) {
  const test::TemporaryFolder folder;
  const fs::path one = run(folder / "one", 600), two = run(folder / "two", 600);
  fs::create_directories(folder / "empty");
  try {
    static_cast<void>(group_report({.persons = {folder / "empty"}, .after = {}, .folder = "x"}));
    FAIL() << "a folder without a run was taken";
  } catch (const ReadError& error) {
    EXPECT_THAT(error.what(), HasSubstr("myoid run"));
  }
  EXPECT_THROW(static_cast<void>(group_report({.persons = {one, two}, .after = {one}, .folder = "x"})), InvalidInput);
}

TEST(GroupReport, OfATwinStudyThePersonsBringTheirTruth) {
  const test::TemporaryFolder folder;
  write_file(folder / "persons.csv",
             "seed,method,case,muscle,parameter,unit,truth,initial,estimate,ci_low,ci_high,shrinkage,"
             "verdict\n"
             "1,torque,both,BIC,max_isometric_force,N,905,1059,952,771,1163,0.8,weak\n"
             "2,torque,both,BIC,max_isometric_force,N,800,1059,820,700,900,0.8,weak\n");
  const page::Report page = group_report({.persons = {folder.path()}, .after = {}, .folder = "x"});
  const page::StripGrid& grid = page.sections[0].grids.at(0);
  ASSERT_EQ(grid.rows.size(), 2U);
  EXPECT_EQ(grid.rows[0].person, "person 1");
  EXPECT_EQ(grid.rows[1].cells[0].truth, 800.0);
}

}  // namespace
}  // namespace myoid::results
