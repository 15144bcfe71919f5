#pragma once

#include <memory>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "browser.h"
#include "program.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace myoid::test {

/// A run of three trials of a virtual person, made once, and a browser that shows its report.
class WorkbenchPage : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!there_is("chromium")) return;
    folder_ = std::make_unique<TemporaryFolder>();
    const std::string protocol = source_dir() / "examples/protocols/three_trials.toml";
    const auto twin =
        myoid({"twin", "--model", "arm4", "--protocol", protocol, "--seed", "3", "--out", *folder_ / "rec"});
    ASSERT_EQ(twin.exit_code, 0) << twin.err;
    write_file(*folder_ / "rec/norm.csv",
               "percent,elbow_flexion_mean,elbow_flexion_sd\n"
               "0,20,5\n50,100,10\n100,40,8\n");
    const std::string study = read_text(*folder_ / "rec/study.toml");
    write_file(*folder_ / "rec/study.toml",
               study + "\n[[norm]]\nname = \"adults, N = 24\"\nfile = \"norm.csv\"\ntrials = [\"ramp\"]\n");
    const auto run = myoid({"run", *folder_ / "rec/study.toml", "--out", *folder_ / "result"});
    ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
    const std::string text = read_text(*folder_ / "result/report.html");
    if (text.find("id=\"workbench-data\"") == std::string::npos) return;  // built without three.js
    browser_ = std::make_unique<Browser>(960, 720);
  }
  static void TearDownTestSuite() {
    browser_.reset();
    folder_.reset();
  }

  void SetUp() override {
    if (!browser_) GTEST_SKIP() << "needs the packages chromium, and libjs-three and esbuild in the build";
    browser_->resize(960, 720);
    open();
  }
  void TearDown() override {
    if (!browser_) return;
    EXPECT_THAT(browser_->complaints(), testing::IsEmpty());
  }

  static void open(const std::string& wishes = "trial=swing_2kg") {
    browser_->open("file://" + std::string(*folder_ / "result/report.html") + "#" + wishes);
  }
  static nlohmann::json js(const std::string& expression) { return browser_->evaluate(expression); }

  /// Scrolls a plot into view and names it `plot` in the page; its place in the window.
  struct Place {
    double left, top, width, height;
  };
  static Place plot(const std::string& kind, const std::string& title) {
    const nlohmann::json box =
        js(fmt::format("window.plot = myoid.plots.find((p) => p.kind === '{}' && p.title === '{}');"
                       "plot.element.scrollIntoView({{block: 'center'}});"
                       "(({{left, top, width, height}}) => [left, top, width, height])"
                       "(plot.svg.getBoundingClientRect())",
                       kind, title));
    return {box[0], box[1], box[2], box[3]};
  }
  /// Returns the place in the window at which a time of the plot is drawn.
  static double x_of(const Place& place, double time_s) {
    return place.left + js(fmt::format("plot.px({})", time_s)).get<double>();
  }

  inline static std::unique_ptr<TemporaryFolder> folder_;
  inline static std::unique_ptr<Browser> browser_;
};

}  // namespace myoid::test
