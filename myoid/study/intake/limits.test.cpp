#include "myoid/study/intake/limits.h"

#include <gtest/gtest.h>

#include "tests/support/printed_page.h"

namespace myoid::study {
namespace {

TEST(Limits, EveryOneIsPrinted) {
  test::expect_all_printed<PlausibilityLimits>(
      [](const PlausibilityLimits& limits) { return markdown(plausibility_rows(limits)); });
  test::expect_all_printed<GateLimits>([](const GateLimits& limits) { return markdown(gate_rows(limits)); });
}

TEST(Limits, AreTheOnesThatTheGuidePrints) {
  test::expect_printed("docs/guide/check.md", "what cannot be", markdown(plausibility_rows()));
  test::expect_printed("docs/guide/check.md", "gates", markdown(gate_rows()));
}

}  // namespace
}  // namespace myoid::study
