#include "myoid/page/change_forest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::page {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ChangeForest, DrawsBothSessionsInSmallestDetectableChanges) {
  ChangeForest forest{.first = "first (2026-01-01)", .second = "second"};
  EXPECT_EQ(change_forest_html(forest), "");
  forest.rows = {{.owner = "Biceps",
                  .name = "voluntary torque",
                  .unit = "N m",
                  .first = {40.0, 38.0, 42.0},
                  .second = {46.0, 44.0, 60.0},
                  .detectable = 4.0,
                  .verdict = "differs",
                  .badge = Badge::info}};
  std::string text = change_forest_html(forest);
  // The first in the middle, half a detectable change to either side; the second 1.5 changes above: 50 % + 25 %.
  EXPECT_THAT(text, HasSubstr("<line x1=\"41.67%\" x2=\"58.33%\" y1=\"9\" y2=\"9\" stroke=\"#1f5fa8\""));
  EXPECT_THAT(text, HasSubstr("<svg x=\"75.00%\" y=\"19\""));
  EXPECT_THAT(text, HasSubstr("x2=\"100.00%\" y1=\"19\" y2=\"19\" stroke=\"#d1491b\""));
  EXPECT_THAT(text, HasSubstr("40.0 (38.0 to 42.0)"));
  EXPECT_THAT(text, Not(HasSubstr("not compared")));
  forest.rows[0].detectable.reset();
  EXPECT_THAT(change_forest_html(forest), HasSubstr("not compared"));
}

}  // namespace
}  // namespace myoid::page
