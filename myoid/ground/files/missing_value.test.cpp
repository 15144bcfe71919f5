#include "myoid/ground/files/missing_value.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid {
namespace {

/// Returns the column behind the repair, with the number that stands for missing values.
std::pair<Eigen::VectorXd, std::optional<double>> cleaned(const std::vector<double>& numbers) {
  Eigen::MatrixXd values = Eigen::Map<const Eigen::VectorXd>(numbers.data(), std::ssize(numbers));
  std::vector<Repair> repairs;
  const auto found = take_out_missing(values, {"knee"}, repairs);
  EXPECT_EQ(repairs.size(), found[0] ? 1U : 0U);
  return {values.col(0), found[0]};
}

TEST(MissingValue, NinesFarFromTheRestBecomeGaps) {
  for (const double number : {-9999.0, 9999.0, 999.0, -999.9, 999999.0, -99999.99}) {
    const auto [column, found] = cleaned({1.5, number, -20.0, number});
    EXPECT_EQ(found, number);
    EXPECT_TRUE(std::isnan(column[1]) && std::isnan(column[3])) << number;
    EXPECT_EQ(column[0], 1.5);
    EXPECT_EQ(column[2], -20.0);
  }
}

TEST(MissingValue, ANumberAmongOthersOfItsSizeIsANumber) {
  EXPECT_FALSE(cleaned({9990.0, 9999.0, 10010.0}).second);
  EXPECT_FALSE(cleaned({400.0, 999.0, 700.0}).second);
}

TEST(MissingValue, OtherLargeNumbersStay) {
  EXPECT_FALSE(cleaned({0.0, 1000.0, 1000.0, 9998.0, 5.0}).second);
  EXPECT_FALSE(cleaned({0.0, 99.0, 0.0}).second);
  // The least number of 16 bits is that of an amplifier that is cut off.
  EXPECT_FALSE(cleaned({0.0, -32768.0, -32768.0}).second);
}

TEST(MissingValue, OfSeveralSuchNumbersTheMostFrequentIsNamed) {
  EXPECT_EQ(cleaned({1.0, 9999.0, -9999.0, 9999.0, 2.0}).second, 9999.0);
}

}  // namespace
}  // namespace myoid
