#include "myoid/results/cohort/group_person.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPersonHeader = "muscle,parameter,unit,method,case,estimate,ci_low,ci_high,verdict\n";

fs::path run_with(const fs::path& folder, const std::string& rows) {
  write_file(folder / "parameters.csv", std::string(kPersonHeader) + rows);
  return folder;
}

TEST(GroupPerson, HasTheNumbersOfTorqueOrElseOfTheFirstMethod) {
  const test::TemporaryFolder folder;
  const std::string paper = "BIC,max_isometric_force,N,paper,both,500,400,600,weak\n";
  const fs::path both = run_with(folder / "both", paper +
                                                      "BIC,max_isometric_force,N,torque,both,700,,,identified\n"
                                                      "TRI,max_isometric_force,N,torque,both,,,,weak\n");
  const std::vector<GroupPerson> found = read_group_persons({both, run_with(folder / "paper", paper)}, folder.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "both");
  ASSERT_EQ(found[0].numbers.size(), 1U);  // TRI has no estimate
  EXPECT_EQ(found[0].numbers[0].estimate, 700.0);
  EXPECT_FALSE(found[0].numbers[0].low);
  EXPECT_EQ(found[1].numbers.at(0).estimate, 500.0);
  EXPECT_EQ(found[1].numbers[0].low, 400.0);
  EXPECT_EQ(found[0].page, "");  // the run has no report
}

TEST(GroupPerson, HasBothReadingsOfANumber) {
  const test::TemporaryFolder folder;
  write_file(folder / "run/parameters.csv",
             "muscle,parameter,unit,method,case,estimate,ci_low,ci_high,given_estimate,given_ci_low,"
             "given_ci_high,verdict\n"
             "BIC,max_isometric_force,N,torque,both,700,500,900,690,670,710,reproducible\n"
             "TRI,max_isometric_force,N,torque,both,800,500,900,,,,weak\n");
  const std::vector<GroupPerson> found = read_group_persons({folder / "run"}, folder.path());
  const std::vector<GroupNumber>& numbers = found.at(0).numbers;
  ASSERT_EQ(numbers.size(), 2U);
  EXPECT_EQ(numbers[0].given, 690.0);
  EXPECT_EQ(numbers[0].given_low, 670.0);
  EXPECT_EQ(numbers[0].given_high, 710.0);
  EXPECT_FALSE(numbers[1].given || numbers[1].given_low || numbers[1].given_high);
}

TEST(GroupPerson, NumbersAreInTheUnitsOfEveryOtherPage) {
  const test::TemporaryFolder folder;
  write_file(folder / "run/parameters.csv",
             "muscle,parameter,unit,method,case,estimate,ci_low,ci_high,verdict\n"
             "BIC,pennation_angle,rad,torque,both,1.0471975511965976,0.5235987755982988,,identified\n"
             "BIC,optimal_fiber_length,m,torque,both,0.12,,,identified\n"
             "BIC,max_shortening_speed,l_opt/s,torque,both,10,,,identified\n"
             "BIC,emg_gain,1,torque,both,2,,,identified\n");
  const std::vector<GroupPerson> found = read_group_persons({folder / "run"}, folder.path());
  const std::vector<GroupNumber>& numbers = found.at(0).numbers;
  ASSERT_EQ(numbers.size(), 4U);
  EXPECT_EQ(numbers[0].unit, "°");
  EXPECT_NEAR(numbers[0].estimate, 60.0, 1e-12);  // pi / 3
  EXPECT_NEAR(numbers[0].low.value_or(0.0), 30.0, 1e-12);
  EXPECT_EQ(numbers[1].unit, "cm");
  EXPECT_NEAR(numbers[1].estimate, 12.0, 1e-12);
  EXPECT_EQ(numbers[2].unit, "l_opt/s");
  EXPECT_EQ(numbers[2].estimate, 10.0);
  EXPECT_EQ(numbers[3].unit, "");
}

TEST(GroupPerson, TheNameIsThePartOfThePathInWhichRunsDiffer) {
  const test::TemporaryFolder folder;
  const fs::path one = run_with(folder / "sub-01/monday/out", "");
  const fs::path two = run_with(folder / "sub-02/monday/out", "");
  write_file(two / "report.html", "<html></html>");
  const std::vector<GroupRun> runs = group_runs({one, two});
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].name, "sub-01");
  EXPECT_EQ(runs[1].name, "sub-02");
  EXPECT_EQ(page_of(runs[1], folder / "pages"), "../sub-02/monday/out/report.html");
}

TEST(GroupPerson, AFolderWithoutARunIsNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(static_cast<void>(group_runs({folder.path()})), ReadError);
}

}  // namespace
}  // namespace myoid::results
