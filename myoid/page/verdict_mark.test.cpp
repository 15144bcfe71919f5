#include "myoid/page/verdict_mark.h"

#include <array>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::page {
namespace {

using testing::HasSubstr;

constexpr std::array kBadges = {Badge::none, Badge::good, Badge::weak, Badge::bad, Badge::info, Badge::repeat};

TEST(VerdictMark, EachBadgeHasAColorAndAShapeOfItsOwn) {
  std::set<std::string> colors, shapes;
  for (const Badge badge : kBadges) {
    colors.emplace(verdict_color(badge));
    std::string shape = verdict_shape(badge);
    shapes.insert(shape.substr(0, shape.find("fill")));  // the drawing without its color
    EXPECT_THAT(verdict_mark(badge), HasSubstr(std::string(verdict_color(badge))));
  }
  EXPECT_EQ(colors.size(), kBadges.size());
  EXPECT_EQ(shapes.size(), kBadges.size());
}

TEST(VerdictMark, AnArrowPointsToItsSide) {
  EXPECT_NE(beyond_arrow(-1, "#000"), beyond_arrow(1, "#000"));
  EXPECT_THAT(beyond_arrow(1, "#123456"), HasSubstr("#123456"));
}

}  // namespace
}  // namespace myoid::page
