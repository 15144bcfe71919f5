#include "myoid/ground/core/progress_part.h"

#include <gtest/gtest.h>

namespace myoid {
namespace {

TEST(ProgressPart, TellsItsSharesAsThoseOfTheWhole) {
  double share = 0.0;
  std::string name;
  const Progress whole{.report =
                           [&](double at, std::string_view what) {
                             share = at;
                             name = what;
                           },
                       .stop = {}};
  part_of(part_of(whole, 0.5, 0.9), 0.0, 0.5).tell(0.5, "fits");
  EXPECT_DOUBLE_EQ(share, 0.6);
  EXPECT_EQ(name, "fits");
  EXPECT_FALSE(part_of({}, 0.0, 1.0).report);
}

}  // namespace
}  // namespace myoid
