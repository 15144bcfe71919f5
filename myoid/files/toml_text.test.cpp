#include "myoid/files/toml_text.h"

#include <limits>

#include <gtest/gtest.h>

#include "myoid/files/toml_table.h"

namespace myoid::recording {
namespace {

TEST(TomlText, IsReadBackAsItWas) {
  for (const std::string text : {"plain", "a \"quoted\" \\ word", "two\nlines\ttab", "Jürgen", ""}) {
    const toml::table root = parse_toml("key = " + toml_text(text) + "\n", "t.toml");
    EXPECT_EQ(TomlTable(root, "t.toml", "table").text("key"), text);
  }
}

TEST(TomlNumber, IsReadBackToTheSameBits) {
  for (const double value : {0.1, 1.0, -3.0, 1e300, 1.0 / 3.0, 5e-324, std::numeric_limits<double>::max()}) {
    const toml::table root = parse_toml("key = " + toml_number(value) + "\n", "t.toml");
    EXPECT_TRUE(root.get("key")->is_floating_point());
    EXPECT_EQ(TomlTable(root, "t.toml", "table").number("key"), value);
  }
}

}  // namespace
}  // namespace myoid::recording
