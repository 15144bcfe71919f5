#include "myoid/page/svg_plot.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/numbers.h"

namespace myoid::page {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Ticks, AreRoundAndInside) {
  EXPECT_THAT(ticks(0.0, 10.0, 5), ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0, 10.0));
  EXPECT_THAT(ticks(-0.13, 0.31, 4), ElementsAre(0.0, DoubleNear(0.2, 1e-15)));
  EXPECT_THAT(ticks(97.0, 103.0, 3), ElementsAre(98.0, 100.0, 102.0));
  for (const double scale : {1e-9, 1e-3, 1.0, 1e7}) {
    const auto found = ticks(1.3 * scale, 8.9 * scale, 5);
    EXPECT_GE(found.size(), 3U);
    EXPECT_LE(found.size(), 8U);
    EXPECT_GE(found.front(), 1.3 * scale * (1 - 1e-9));
    EXPECT_LE(found.back(), 8.9 * scale * (1 + 1e-9));
  }
}

TEST(Decimate, KeepsTheExtremesAndTheEnds) {
  std::vector<double> y(100000);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = std::sin(0.01 * static_cast<double>(k));
  y[54321] = 7.0;
  y[12345] = -9.0;
  const auto keep = decimate(y, 200);
  EXPECT_LE(keep.size(), 800U);
  EXPECT_EQ(keep.front(), 0U);
  EXPECT_EQ(keep.back(), y.size() - 1);
  EXPECT_TRUE(std::is_sorted(keep.begin(), keep.end()));
  EXPECT_TRUE(std::binary_search(keep.begin(), keep.end(), 54321U));
  EXPECT_TRUE(std::binary_search(keep.begin(), keep.end(), 12345U));
}

TEST(Decimate, KeepsShortSeriesWholeAndGapsApart) {
  EXPECT_EQ(decimate({1, 2, 3}, 10).size(), 3U);
  std::vector<double> y(10000, 1.0);
  y[5003] = kNan;
  const auto keep = decimate(y, 50);
  EXPECT_TRUE(std::binary_search(keep.begin(), keep.end(), 5003U));
}

Figure one_curve(std::vector<double> x, std::vector<double> y) {
  Panel panel;
  panel.title = "P";
  panel.x = {"time", "s"};
  panel.y = {"force", "N"};
  panel.series.push_back({.name = "measured", .x = std::move(x), .y = std::move(y)});
  return {.id = "f", .title = "F", .panels = {panel}};
}

TEST(SvgPlot, DrawsLabelsUnitsAndLegend) {
  const std::string svg = svg_plot(one_curve({0, 1, 2}, {5, 7, 6}));
  EXPECT_THAT(svg, HasSubstr("time [s]"));
  EXPECT_THAT(svg, HasSubstr("force [N]"));
  EXPECT_THAT(svg, HasSubstr(">measured<"));
  EXPECT_THAT(svg, HasSubstr("viewBox"));
}

TEST(SvgPlot, AGapPartsTheCurve) {
  const std::string svg = svg_plot(one_curve({0, 1, 2, 3, 4}, {1, 2, kNan, 2, 1}));
  const std::size_t begin = svg.find("<path d=\"");
  const std::string path = svg.substr(begin, svg.find("\" fill", begin) - begin);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgPlot, HigherValuesAreHigherOnThePage) {
  const std::string svg = svg_plot(one_curve({0, 1}, {0, 1}));
  const std::size_t at = svg.find("<path d=\"M") + 10;
  double x = 0.0;
  double y = 0.0;
  double right = 0.0;
  double down = 0.0;
  ASSERT_EQ(std::sscanf(svg.c_str() + at, "%lf %lfl%lf%lf", &x, &y, &right, &down), 4);
  EXPECT_GT(right, 0.0);
  EXPECT_LT(down, 0.0);
}

TEST(SvgPlot, NothingToDrawIsNoFailure) {
  EXPECT_THAT(svg_plot(one_curve({}, {})), HasSubstr("</svg>"));
  EXPECT_THAT(svg_plot(one_curve({1.0}, {kNan})), Not(HasSubstr("nan")));
  EXPECT_THAT(svg_plot(one_curve({1.0, 2.0}, {3.0, 3.0})), Not(HasSubstr("nan")));
}

TEST(SvgPlot, NamesCannotBreakOut) {
  Figure figure = one_curve({0, 1}, {0, 1});
  figure.panels[0].title = "<script>alert(\"x\")</script> & more";
  const std::string svg = svg_plot(figure);
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  EXPECT_THAT(svg, HasSubstr("&lt;script&gt;"));
  EXPECT_EQ(escape_xml("a\x01"
                       "b"),
            "a?b");
}

TEST(SvgPlot, ABandHoldsItsSamplesHoweverMany) {
  Series band{.name = "95 %", .role = Role::band};
  for (int k = 0; k < 10000; ++k) {
    band.x.push_back(k);
    band.y.push_back(k == 5001 ? -10.0 : 0.0);
    band.y_upper.push_back(1.0);
  }
  Figure figure = one_curve({}, {});
  figure.panels[0].series = {band};
  const std::string svg = svg_plot(figure);
  const std::size_t begin = svg.find("<path d=\"M");
  const std::string path = svg.substr(begin, svg.find("\" fill", begin) - begin);
  EXPECT_LT(path.size(), 20000U);
  // The frame is 220 high, with margins of a 22nd. The one low sample takes ten of eleven parts of
  // the rest, down and up again.
  EXPECT_NE(path.find(" 181.8"), std::string::npos);
  EXPECT_NE(path.find("-181.8"), std::string::npos);
}

}  // namespace
}  // namespace myoid::page
