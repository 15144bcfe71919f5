#include "myoid/results/cohort/group.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/csv_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kHeader = "muscle,parameter,unit,method,case,estimate,ci_low,ci_high,verdict,reason\n";

/// Three persons: two with numbers, one who failed.
Manifest three(const fs::path& folder) {
  Manifest manifest{.file = "m.csv", .persons = {}};
  const auto add = [&](const std::string& name, OutcomeKind kind, const std::string& rows) {
    manifest.persons.push_back(
        {.name = name, .id = name, .label = name, .study = "s.toml", .facts = {{"group", "young, fit"}}});
    const fs::path place = person_folder(folder, manifest.persons.back());
    write_outcome({.kind = kind, .message = kind == OutcomeKind::failed ? "no EMG" : ""}, place);
    if (!rows.empty()) write_file(place / "parameters.csv", kHeader + rows);
  };
  add("A", OutcomeKind::done,
      "BIC,max_isometric_force,N,torque,both,100,90,110,identified,\"a, b\"\n"
      "BIC,max_isometric_force,N,paper,both,900,1,2,identified,\n"
      "TRI,max_isometric_force,N,torque,both,5000,1,9999,prior_dominated,\n");
  add("B", OutcomeKind::gate_failed, "BIC,max_isometric_force,N,torque,both,140,120,160,weak,\n");
  add("C", OutcomeKind::failed, "");
  return manifest;
}

/// Writes the group and returns its cohort.csv.
recording::CsvTable written_numbers(const Manifest& manifest, const fs::path& folder) {
  ResultFolder held(folder, "myoid cohort", "cohort", true);
  write_group(read_group(manifest, folder), manifest, folder);
  return recording::read_csv_table(folder / "cohort.csv");
}

TEST(Group, TheTableHasEveryNumberOfEveryPersonBehindThePersonsOwnColumns) {
  const test::TemporaryFolder folder;
  const recording::CsvTable numbers = written_numbers(three(folder.path()), folder.path());
  ASSERT_EQ(numbers.rows.size(), 4U);
  EXPECT_EQ(numbers.names[0], "person");
  EXPECT_EQ(numbers.names[1], "group");
  EXPECT_EQ(numbers.names[2], "muscle");
  EXPECT_EQ(numbers.rows[3][0], "B");
  EXPECT_EQ(numbers.rows[3][7], "140");
}

TEST(Group, AColumnThatOnlySomePersonsHaveStandsUnderItsName) {
  const test::TemporaryFolder folder;
  const Manifest manifest = three(folder.path());
  write_file(person_folder(folder.path(), manifest.persons[1]) / "parameters.csv",
             "muscle,parameter,unit,method,case,estimate,given_estimate,ci_low,ci_high,verdict,reason\n"
             "BIC,max_isometric_force,N,torque,both,140,135,120,160,weak,why\n");
  const recording::CsvTable numbers = written_numbers(manifest, folder.path());
  const auto cell = [&](std::size_t row, const char* name) {
    const auto found = std::ranges::find(numbers.names, name);
    return numbers.rows[row].at(static_cast<std::size_t>(found - numbers.names.begin()));
  };
  EXPECT_EQ(cell(0, "given_estimate"), "");
  EXPECT_EQ(cell(0, "reason"), "a, b");
  EXPECT_EQ(cell(3, "given_estimate"), "135");
  EXPECT_EQ(cell(3, "ci_low"), "120");
  EXPECT_EQ(cell(3, "reason"), "why");
  const Group group = read_group(manifest, folder.path());
  EXPECT_EQ(group.page.sections[0].grids.at(0).rows[1].cells[0].given_value, 135.0);
}

TEST(Group, ThePageHasMeanSpreadAndWidthOfTheNumbersThatAreTold) {
  const test::TemporaryFolder folder;
  const Group group = read_group(three(folder.path()), folder.path());
  const page::Table& summary = group.page.sections[0].tables.at(0);
  ASSERT_EQ(summary.rows.size(), 1U) << "the prior's number is not the persons', nor is paper's";
  // Mean of 100 and 140; their standard deviation 20 sqrt 2; half widths 10 and 20.
  EXPECT_EQ(summary.rows[0][3].text, "2 of 2");
  EXPECT_EQ(summary.rows[0][4].text, "120");
  EXPECT_EQ(summary.rows[0][5].text, "28.3");
  EXPECT_EQ(summary.rows[0][6].text, "15");
  const page::StripGrid& grid = group.page.sections[0].grids.at(0);
  ASSERT_EQ(grid.rows.size(), 2U) << "the person without results has no row";
  EXPECT_EQ(grid.rows[0].page, "persons/A/report.html");
  EXPECT_EQ(grid.rows[1].cells[0].value, 140.0);
  EXPECT_THAT(group.page.headline, HasSubstr("2 of 3 persons"));
  EXPECT_THAT(group.page.headline, HasSubstr("C: no EMG"));
}

TEST(Group, WritesTablesPageAndDerivativeAndNoDerivativeOfAPersonWithoutResults) {
  const test::TemporaryFolder folder;
  const Manifest manifest = three(folder.path());
  write_file(folder / "sub-C/other_pipeline.tsv", "precious");
  {
    ResultFolder earlier(folder.path(), "myoid cohort", "cohort", true);
    write_file(folder / "sub-B/motion/old.tsv", "of an earlier day");
    write_file(folder / "sub-C/motion/old.tsv", "of an earlier, better day");
    earlier.finish();
  }
  ResultFolder held(folder.path(), "myoid cohort", "cohort", false);
  write_group(read_group(manifest, folder.path()), manifest, folder.path());
  EXPECT_THAT(read_text_file(folder / "cohort.csv"),
              HasSubstr("A,\"young, fit\",BIC,max_isometric_force,N,torque,both,100,90,110"));
  EXPECT_THAT(read_text_file(folder / "persons.csv"), HasSubstr("C,\"young, fit\",s.toml,persons/C,failed,no EMG"));
  EXPECT_THAT(read_text_file(folder / "participants.tsv"), HasSubstr("participant_id\tgroup\nsub-A\tyoung, fit\n"));
  EXPECT_TRUE(fs::exists(folder / "report.html"));
  EXPECT_TRUE(fs::exists(folder / "dataset_description.json"));
  EXPECT_TRUE(fs::exists(folder / "sub-A/sub-A_desc-identified_parameters.tsv"));
  EXPECT_FALSE(fs::exists(folder / "sub-B/motion"));
  EXPECT_FALSE(fs::exists(folder / "sub-C/motion"));
  EXPECT_EQ(read_text_file(folder / "sub-C/other_pipeline.tsv"), "precious");
}

}  // namespace
}  // namespace myoid::results
