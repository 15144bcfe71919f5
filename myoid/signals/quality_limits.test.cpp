#include "myoid/signals/quality_limits.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/core/fault.h"

#include "tests/support/places.h"

namespace myoid::signals {
namespace {

TEST(QualityLimits, AreTheOnesThatTheDocumentationLists) {
  std::ifstream stream(test::source_dir() / "docs/guide/check.md");
  std::stringstream text;
  text << stream.rdbuf();
  const std::vector<LimitRow> rows = limit_rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(rows[i].kind), i);
    const std::string begin = fmt::format("| `{}` | {} |", name(rows[i].kind), rows[i].limit);
    EXPECT_NE(text.str().find(begin), std::string::npos) << "no row " << begin;
  }
  // The last kind has the last row.
  EXPECT_EQ(rows.back().kind, FaultKind::plate_pressure_outside);
}

TEST(Fault, IsASentenceWithItsRemedy) {
  Fault fault;
  fault.text = "marker 'A' jumps";
  EXPECT_EQ(sentence(fault), "marker 'A' jumps");
  fault.remedy = "remove it";
  EXPECT_EQ(sentence(fault), "marker 'A' jumps; remove it");
}

}  // namespace
}  // namespace myoid::signals
