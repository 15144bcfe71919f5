#include "myoid/page/forest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::page {
namespace {

using testing::HasSubstr;

TEST(Forest, DrawsEachNumberInSpreadsOfItsPrior) {
  ForestRow row{.owner = "BIC",
                .name = "optimal fiber length",
                .unit = "m",
                .estimate = 0.13,
                .lower = 0.11,
                .upper = 0.2,
                .prior_mean = 0.12,
                .prior_sd = 0.01,
                .verdict = "weak",
                .badge = Badge::weak};
  const std::string text = forest_html({row});
  // The estimate is one spread above: 50 % + 12.5 %; the interval from -1 to beyond the scale.
  EXPECT_THAT(text, HasSubstr("<svg x=\"62.50%\""));
  EXPECT_THAT(text, HasSubstr("<line x1=\"37.50%\" x2=\"100.00%\""));
  EXPECT_THAT(text, HasSubstr("0.110 to 0.200"));
  row.prior_sd.reset();
  EXPECT_THAT(forest_html({row}), HasSubstr("no prior"));
  EXPECT_EQ(forest_html({}), "");
}

}  // namespace
}  // namespace myoid::page
