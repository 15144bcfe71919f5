#include "myoid/run/design/verdict_badge.h"

#include <set>

#include <gtest/gtest.h>

namespace myoid::run {
namespace {

// A reader tells verdicts apart by their marks (page/verdict_mark.h), one for each badge.
TEST(VerdictBadge, EachVerdictHasABadgeOfItsOwn) {
  std::set<page::Badge> badges;
  for (const std::string_view word : fit::kVerdictNames)
    badges.insert(verdict_badge(*choice_named<fit::Verdict>(word)));
  EXPECT_EQ(badges.size(), std::size(fit::kVerdictNames));
  EXPECT_EQ(verdict_badge(fit::Verdict::identified), page::Badge::good);
  EXPECT_EQ(verdict_badge(fit::Verdict::non_physical), page::Badge::bad);
}

}  // namespace
}  // namespace myoid::run
