#include "myoid/page/verdict_mark.h"

#include <array>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::page {
namespace {

using testing::HasSubstr;

constexpr std::array<std::string_view, 6> kVerdicts = {"identified",      "reproducible",     "weak",
                                                       "prior_dominated", "not_identifiable", "non_physical"};

TEST(VerdictMark, EachVerdictHasAColorAndAShapeOfItsOwn) {
  std::set<std::string> colors, shapes;
  for (const std::string_view verdict : kVerdicts) {
    const Badge badge = verdict_badge(verdict);
    colors.emplace(verdict_color(badge));
    std::string shape = verdict_shape(badge);
    shapes.insert(shape.substr(0, shape.find("fill")));  // the drawing without its color
    EXPECT_THAT(verdict_mark(badge), HasSubstr(std::string(verdict_color(badge)))) << verdict;
  }
  EXPECT_EQ(colors.size(), kVerdicts.size());
  EXPECT_EQ(shapes.size(), kVerdicts.size());
}

TEST(VerdictMark, AnArrowPointsToItsSide) {
  EXPECT_NE(beyond_arrow(-1, "#000"), beyond_arrow(1, "#000"));
  EXPECT_THAT(beyond_arrow(1, "#123456"), HasSubstr("#123456"));
}

}  // namespace
}  // namespace myoid::page
