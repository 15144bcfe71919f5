// The page of a group in a browser.
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "browser.h"
#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Browser;
using myoid::test::myoid;
using myoid::test::read_rows;
using myoid::test::Row;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;
using testing::IsEmpty;

/// Six finished runs; the last person is five times as strong as the others.
void make_runs(const TemporaryFolder& folder) {
  for (int i = 0; i < 6; ++i) {
    const std::string place = folder / fmt::format("runs/Person_{}", i);
    std::filesystem::create_directories(place);
    const double strength = i == 5 ? 3000.0 : 600.0 + 10.0 * i;
    std::string rows = "muscle,parameter,unit,method,case,estimate,ci_low,ci_high,verdict\n";
    for (const char* muscle : {"BIC", "BRA", "BRD", "TRI"}) {
      rows += fmt::format("{},max_isometric_force,N,torque,both,{},{},{},identified\n", muscle, strength,
                          strength - 50.0, strength + 50.0);
      rows += fmt::format("{},optimal_fiber_length,m,torque,both,0.1,0.05,0.15,prior_dominated\n", muscle);
    }
    write_text(place + "/parameters.csv", rows);
    write_text(place + "/report.html", fmt::format("<!DOCTYPE html><title>{}</title><body>person {}</body>", i, i));
  }
}

TEST(GroupPage, LeadsFromThePersonWhoIsFarFromTheOthersToTheReport) {
  if (!myoid::test::there_is("chromium")) GTEST_SKIP() << "needs the package chromium";
  const TemporaryFolder folder;
  make_runs(folder);
  const auto done = myoid({"report", "--group", folder / "runs", "--out", folder / "group"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("report.html"));
  Browser browser(1280, 900);
  browser.open("file://" + std::string(folder / "group/report.html"));
  EXPECT_THAT(browser.evaluate("document.querySelector('.headline').textContent").get<std::string>(),
              HasSubstr("Person_5, BIC max isometric force"));
  EXPECT_EQ(browser.evaluate("document.querySelectorAll('svg.strip .ring').length"), 4);
  // The mark lies where the number is: the outlier is right of everybody.
  const auto place = [&](int row) {
    return browser
        .evaluate(fmt::format("document.querySelectorAll('#group_max_isometric_force tbody tr')[{}]"
                              ".querySelector('svg.strip g > svg').getBoundingClientRect().left",
                              row))
        .get<double>();
  };
  EXPECT_GT(place(5), place(4) + 50.0);
  EXPECT_GT(place(4), place(0));
  // The numbers of the plot are those of the persons' files.
  for (const Row& row : read_rows(folder / "group/tables/group_max_isometric_force.csv")) {
    const auto own = read_rows(folder / ("runs/" + row.at("person") + "/parameters.csv"));
    const auto same = std::find_if(own.begin(), own.end(), [&](const Row& r) {
      return r.at("muscle") == row.at("number") && r.at("parameter") == "max_isometric_force";
    });
    ASSERT_NE(same, own.end());
    EXPECT_EQ(row.at("value"), same->at("estimate"));
    EXPECT_EQ(row.at("lower"), same->at("ci_low"));
  }
  for (const int width : {390, 1280, 1920}) {
    browser.resize(width, 900);
    EXPECT_LE(browser.evaluate("document.documentElement.scrollWidth").get<int>(), width);
  }
  EXPECT_THAT(browser.complaints(), IsEmpty());
  browser.evaluate("[...document.querySelectorAll('a')].find((a) => a.textContent === 'Person_5').click()");
  browser.wait_for("document.body.textContent.includes('person 5')");
}

}  // namespace
