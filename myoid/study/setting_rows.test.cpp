#include "myoid/study/setting_rows.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/printed_page.h"

namespace myoid::study {
namespace {

SettingRow row_of(const std::string& table, const std::string& key) {
  for (const SettingTable& t : setting_tables()) {
    for (const SettingRow& row : t.rows)
      if (t.name == table && row.key == key) return row;
  }
  return {};
}

TEST(SettingTables, AreTheOnesThatTheGuidePrints) {
  for (const SettingTable& table : setting_tables())
    test::expect_printed("docs/guide/study.md", table.name, markdown(table.rows));
}

TEST(SettingTables, ARowSaysRangeUnitAndDefault) {
  const SettingRow rate = row_of("[motion]", "rate_hz");
  EXPECT_EQ(rate.allowed, "10 to 2000 Hz");
  EXPECT_EQ(rate.usual, "100");
  EXPECT_EQ(row_of("[identify]", "folds").allowed, "`trial`, `condition`, `block`");
  EXPECT_EQ(row_of("[identify]", "folds").usual, "`\"trial\"`");
  EXPECT_EQ(row_of("[emg]", "delay_s").allowed, "0 to 0.3 s, or `\"estimate\"`");
  EXPECT_EQ(row_of("[model]", "held_mass.at_m").allowed, "3 numbers [m]");
  EXPECT_EQ(row_of("[[muscle]]", "name").usual, "required");
}

TEST(SettingTables, EveryRowHasASentence) {
  for (const SettingTable& table : setting_tables()) {
    EXPECT_FALSE(table.rows.empty()) << table.name;
    for (const SettingRow& row : table.rows) {
      EXPECT_FALSE(row.says.empty()) << table.name << row.key;
      EXPECT_EQ(row.says.find('|'), std::string::npos) << row.key;
    }
  }
}

TEST(ReferenceText, IsFreeOfMarkdown) {
  const std::string text = reference_text(setting_tables());
  EXPECT_EQ(text.find('`'), std::string::npos);
  EXPECT_EQ(text.find("]("), std::string::npos);
  EXPECT_NE(text.find("  rate_hz: 10 to 2000 Hz; default 100\n"), std::string::npos);
}

}  // namespace
}  // namespace myoid::study
