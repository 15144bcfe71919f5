#include "myoid/page/svg_path.h"

#include <cmath>
#include <random>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::page {
namespace {

/// Reads "M x y l dx dy ..." by the rules of SVG: after M absolute, after l differences.
std::vector<double> points_of(std::string path) {
  std::string spaced;
  for (const char c : path) {
    if (c == 'M' || c == 'l') {
      spaced += {' ', c, ' '};
    } else {
      if (c == '-') spaced += ' ';
      spaced += c;
    }
  }
  std::istringstream stream(spaced);
  std::vector<double> points;
  bool differences = false;
  std::string word;
  while (stream >> word) {
    if (word == "M" || word == "l") {
      differences = word == "l";
      continue;
    }
    const double number = std::stod(word);
    const std::size_t n = points.size();
    points.push_back(differences ? points[n - 2] + number : number);
  }
  return points;
}

TEST(SvgPath, SaysTheSameAsAbsoluteNumbers) {
  SvgPath path;
  path.line(58.04, 212.5);
  path.line(59.2, 212.46);
  path.line(59.2, 212.54);  // the same tenth
  path.line(58.9, 200.0);
  path.close();
  EXPECT_EQ(path.text(), "M58 212.5l1.2 0-.3-12.5Z");
  path.lift();
  path.line(-0.5, 0.0);
  EXPECT_EQ(path.text(), "M58 212.5l1.2 0-.3-12.5ZM-.5 0");
}

TEST(SvgPath, RoundingDoesNotAddUp) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> step(0.3, 0.9), height(-300.0, 300.0);
  SvgPath path;
  std::vector<double> drawn;
  double x = 0.0;
  for (int k = 0; k < 5000; ++k) {
    drawn.push_back(x += step(engine));
    drawn.push_back(height(engine));
    path.line(drawn[drawn.size() - 2], drawn.back());
  }
  const std::vector<double> read = points_of(path.text());
  ASSERT_EQ(read.size(), drawn.size());
  // Half a tenth, and the round-off of 5000 sums in the test's own reader.
  for (std::size_t k = 0; k < read.size(); ++k) ASSERT_NEAR(read[k], drawn[k], 0.05 + 1e-9);
}

}  // namespace
}  // namespace myoid::page
