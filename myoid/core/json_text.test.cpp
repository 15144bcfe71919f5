#include "myoid/core/json_text.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace myoid {
namespace {

using nlohmann::ordered_json;

// A name in Latin-1 is no UTF-8; U+FFFD is EF BF BD there.
TEST(JsonText, KeepsWhatItCanOfANameThatIsNoUtf8) {
  const ordered_json json{{"muscle \xE9", "bic\xE9ps"}, {"n", 1}};
  EXPECT_EQ(json_text(json, -1), "{\"muscle \xEF\xBF\xBD\":\"bic\xEF\xBF\xBDps\",\"n\":1}");
  EXPECT_EQ(ordered_json::parse(json_text(json))["n"], 1);
}

TEST(JsonText, IndentsByTwoAndKeepsTheOrder) {
  EXPECT_EQ(json_text({{"b", 1}, {"a", {2}}}), "{\n  \"b\": 1,\n  \"a\": [\n    2\n  ]\n}");
}

}  // namespace
}  // namespace myoid
