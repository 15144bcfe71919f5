#include "myoid/intervals/verdict_rules.h"

#include <gtest/gtest.h>

#include "tests/support/printed_page.h"

namespace myoid::identification {
namespace {

TEST(VerdictRules, AreTheOnesThatThePagePrints) {
  test::expect_printed("docs/theory/identification.md", "verdict rules", verdict_rules_markdown());
}

}  // namespace
}  // namespace myoid::identification
