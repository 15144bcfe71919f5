#include "myoid/signals/quality_limits.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/core/remark.h"

#include "tests/support/places.h"
#include "tests/support/printed_page.h"

namespace myoid::signals {
namespace {

TEST(QualityLimits, AreTheOnesThatTheDocumentationLists) {
  std::ifstream stream(test::source_dir() / "docs/guide/check.md");
  std::stringstream text;
  text << stream.rdbuf();
  const std::vector<LimitRow> rows = limit_rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(rows[i].code), i);
    const std::string begin = fmt::format("| `{}` | {} |", name(rows[i].code), rows[i].limit);
    EXPECT_NE(text.str().find(begin), std::string::npos) << "no row " << begin;
  }
  // The last kind has the last row.
  EXPECT_EQ(rows.back().code, RemarkCode::plate_pressure_outside);
}

TEST(QualityLimits, EveryOneIsInARow) {
  test::expect_all_printed<QualityLimits>([](const QualityLimits& limits) {
    std::string text;
    for (const LimitRow& row : limit_rows(limits)) text += row.limit + "\n";
    return text;
  });
}

}  // namespace
}  // namespace myoid::signals
