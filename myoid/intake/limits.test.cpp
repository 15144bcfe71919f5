#include "myoid/intake/limits.h"

#include <gtest/gtest.h>

#include "tests/support/printed_page.h"

namespace myoid {
namespace {

TEST(Limits, AreTheOnesThatTheGuidePrints) {
  test::expect_printed("docs/guide/check.md", "what cannot be", markdown(plausibility_rows()));
  test::expect_printed("docs/guide/check.md", "gates", markdown(gate_rows()));
}

}  // namespace
}  // namespace myoid
