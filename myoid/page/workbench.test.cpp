#include "myoid/page/workbench.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/page/html.h"
#include "myoid/page/scene_page.h"

#include "tests/support/packed_codes.h"

namespace myoid::page {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

Workbench one_trial() {
  Workbench workbench;
  WorkbenchTrial trial{.name = "slow </script>", .use = "calibration"};
  trial.clocks = {Eigen::Vector3d(0.0, 0.5, 1.0)};
  TimePlot plot{.kind = "angle", .title = "elbow", .unit = "deg"};
  plot.lines.push_back(
      {.name = "angle", .value = Eigen::Vector3d(10.0, std::numeric_limits<double>::quiet_NaN(), 30.0)});
  trial.plots.push_back(plot);
  workbench.trials.push_back(trial);
  return workbench;
}

TEST(Workbench, KeepsTheSeriesWithinHalfAStepOfThePacking) {
  const std::string text = workbench_json(one_trial(), {});
  EXPECT_THAT(text, Not(HasSubstr("</script")));
  const json trial = json::parse(text)["trials"][0];
  EXPECT_EQ(trial["name"], "slow </script>");
  EXPECT_EQ(trial["clocks"][0]["step"], 0.5);
  const json value = trial["plots"][0]["lines"][0]["value"];
  EXPECT_EQ(value["lower"], 10.0);
  EXPECT_EQ(value["upper"], 30.0);
  EXPECT_EQ(test::read_codes(value["codes"]), (std::vector<int>{0, 4095, 4094}));
}

TEST(Workbench, ALineOfAnotherLengthThanItsClockIsRefused) {
  Workbench workbench = one_trial();
  workbench.trials[0].plots[0].lines[0].value = Eigen::Vector2d(1.0, 2.0);
  try {
    validate(workbench);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("slow"), HasSubstr("angle")));
  }
  workbench = one_trial();
  workbench.trials[0].scene = 0;
  EXPECT_THROW(validate(workbench), InvalidInput);
  workbench = one_trial();
  workbench.trials[0].clocks[0][2] = 0.1;
  EXPECT_THROW(validate(workbench), InvalidInput);
}

TEST(Workbench, StandsInThePageOfAReportThatHasOne) {
  if (!has_viewer()) GTEST_SKIP() << "built without three.js or esbuild";
  Report report;
  report.title = "S01";
  const Workbench workbench = one_trial();
  const std::string page = html(report, &workbench);
  EXPECT_THAT(page, HasSubstr("id=\"workbench-data\""));
  EXPECT_THAT(page, Not(HasSubstr("id=\"scene\"")));
  EXPECT_THAT(page, HasSubstr("MIT License"));
  EXPECT_THAT(html(report), Not(HasSubstr("<script")));
}

}  // namespace
}  // namespace myoid::page
