#include "myoid/fit/intervals/verdict_rules.h"

#include <gtest/gtest.h>

#include "tests/support/printed_page.h"

namespace myoid::fit {
namespace {

TEST(VerdictRules, AreTheOnesThatThePagePrints) {
  test::expect_printed("docs/theory/identification.md", "verdict rules", verdict_rules_markdown());
}

}  // namespace
}  // namespace myoid::fit
