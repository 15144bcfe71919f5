#include "myoid/ground/core/time_series.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground {
namespace {

TimeSeries two_channels() {
  Eigen::MatrixXd values(3, 2);
  values << 1, 10, 2, 20, 3, 30;
  return {Eigen::Vector3d(0.0, 0.1, 0.2), {{"a", Unit::meter}, {"b", Unit::meter}}, values};
}

TEST(TimeSeries, AddressesChannelsByName) { EXPECT_EQ(two_channels().column("b"), Eigen::Vector3d(10, 20, 30)); }

TEST(TimeSeries, RefusesTimeThatDoesNotIncrease) {
  EXPECT_THROW(TimeSeries(Eigen::Vector2d(0.1, 0.1), {{"a"}}, Eigen::MatrixXd::Zero(2, 1)), InvalidInput);
}

TEST(TimeSeries, RefusesTwoChannelsOfOneName) {
  EXPECT_THROW(TimeSeries(Eigen::Vector2d(0, 1), {{"a"}, {"a"}}, Eigen::MatrixXd::Zero(2, 2)), InvalidInput);
}

TEST(TimeSeries, RefusesAShapeThatDoesNotFit) {
  EXPECT_THROW(TimeSeries(Eigen::Vector2d(0, 1), {{"a"}}, Eigen::MatrixXd::Zero(3, 1)), InvalidInput);
}

TEST(TimeSeries, SliceKeepsBothEnds) { EXPECT_EQ(two_channels().slice(0.1, 0.2).time_s(), Eigen::Vector2d(0.1, 0.2)); }

TEST(TimeSeries, SelectKeepsTheOrderAskedFor) {
  const TimeSeries selected = two_channels().select({"b", "a"});
  EXPECT_EQ(selected.channels()[0].name, "b");
  EXPECT_EQ(selected.values()(2, 1), 3.0);
}

TEST(TimeSeries, KnowsItsRate) {
  EXPECT_DOUBLE_EQ(two_channels().mean_rate_hz(), 10.0);
  EXPECT_TRUE(two_channels().is_uniform());
}

TEST(RequireUnit, NamesTheChannelThatIsWrong) {
  EXPECT_NO_THROW(require_unit(two_channels(), Unit::meter, "lengths"));
  EXPECT_THROW(require_unit(two_channels(), Unit::volt, "EMG"), InvalidInput);
}

TEST(RequireFinite, RefusesAGap) {
  Eigen::MatrixXd values = two_channels().values();
  values(1, 1) = std::nan("");
  EXPECT_THROW(require_finite({two_channels().time_s(), two_channels().channels(), values}, "x"), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground
