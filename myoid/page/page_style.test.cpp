#include "myoid/page/page_style.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/page/svg_plot.h"
#include "myoid/page/verdict_mark.h"

namespace myoid::page {
namespace {

/// Relative luminance (WCAG 2.1) of "#fff" or "#14181d".
double luminance(std::string_view color) {
  double sum = 0.0;
  const double weights[] = {0.2126, 0.7152, 0.0722};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string digits =
        color.size() == 4 ? std::string(2, color[k + 1]) : std::string(color.substr(2 * k + 1, 2));
    const double share = std::stoi(digits, nullptr, 16) / 255.0;
    sum += weights[k] * (share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4));
  }
  return sum;
}

double contrast(std::string_view a, std::string_view b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

const PageColor& color(std::string_view name) {
  for (const PageColor& c : page_colors())
    if (c.name == name) return c;
  throw std::runtime_error("no color " + std::string(name));
}

TEST(PageStyle, WritingStandsOutFromItsGroundInBothSchemes) {
  const std::vector<std::pair<const char*, const char*>> pairs{
      {"ink", "back"},      {"dim", "back"},          {"faint", "back"},    {"accent", "back"},   {"back", "accent"},
      {"ink", "field"},     {"dim", "field"},         {"pass-ink", "pass"}, {"warn-ink", "warn"}, {"fail-ink", "fail"},
      {"info-ink", "info"}, {"repeat-ink", "repeat"}, {"warn-ink", "back"}, {"green", "back"},    {"red", "back"}};
  for (const auto& [ink, ground] : pairs) {
    EXPECT_GE(contrast(color(ink).light, color(ground).light), 4.5) << ink << " on " << ground;
    EXPECT_GE(contrast(color(ink).dark, color(ground).dark), 4.5) << ink << " on " << ground << ", dark";
  }
}

TEST(PageStyle, LinesStandOutFromThePageInBothSchemes) {
  for (const char* line : {"accent", "orange", "green", "amber", "red", "violet", "moved", "grey", "truth", "sky",
                           "other", "rose", "fault", "high"}) {
    EXPECT_GE(contrast(color(line).light, color("back").light), 3.0) << line;
    EXPECT_GE(contrast(color(line).dark, color("back").dark), 3.0) << line << ", dark";
  }
}

TEST(PageStyle, KnowsEveryColorOfADrawing) {
  Panel panel{.title = "all"};
  for (int role = 0; role <= static_cast<int>(Role::points); ++role) {
    Series series{.name = "s", .x = {0, 1}, .y = {2, 3}, .role = static_cast<Role>(role)};
    series.y_upper = {3, 4};
    panel.series.push_back(series);
  }
  std::string drawn = svg_plot({.id = "all", .title = "all", .panels = {panel}});
  for (const Badge badge : {Badge::none, Badge::good, Badge::weak, Badge::bad, Badge::info, Badge::repeat})
    drawn += verdict_mark(badge);
  const std::regex attribute("(?:fill|stroke)=\"(#[0-9a-f]+)\"");
  const std::string style = page_style();
  std::set<std::string> colors;
  for (std::sregex_iterator it(drawn.begin(), drawn.end(), attribute); it != std::sregex_iterator(); ++it)
    colors.insert((*it)[1]);
  EXPECT_GT(colors.size(), 10U);
  for (const std::string& one : colors)
    EXPECT_NE(style.find("[fill=\"" + one + "\"]"), std::string::npos) << one << " has no dark color";
}

TEST(PageStyle, HasNoColorBesideTheTable) {
  const std::string style = page_style();
  const std::string rules = style.substr(style.rfind("}}\n"));
  EXPECT_FALSE(std::regex_search(rules, std::regex("#[0-9a-f]{3,6}\\b(?=[;\\s])")));
}

}  // namespace
}  // namespace myoid::page
