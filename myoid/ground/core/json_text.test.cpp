#include "myoid/ground/core/json_text.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace myoid::inline ground {
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

template <typename Read>
std::string error_of(const Read& read) {
  try {
    read();
  } catch (const nlohmann::json::exception& error) {
    return json_error_text(error);
  }
  return "no error";
}

TEST(JsonErrorText, SaysWhatIsWrongWithoutTheLibrarysWords) {
  const std::string whole = R"({"methods": [{"r2": "high"}], "no":1})";
  EXPECT_EQ(error_of([&] { (void)parse_json(whole.substr(0, 20)); }), "the text breaks off or is damaged at byte 21");
  EXPECT_EQ(error_of([&] { (void)parse_ordered_json(""); }), "the text breaks off or is damaged at byte 1");
  const nlohmann::json json = parse_json(whole);
  EXPECT_EQ(error_of([&] { (void)json.at("estimates"); }), "'estimates' is missing");
  EXPECT_EQ(error_of([&] { (void)json.at("methods").at(3); }), "a list is shorter than expected");
  EXPECT_EQ(error_of([&] { (void)json.at("methods").at(0).at("r2").get<double>(); }),
            "a value is of another kind than expected");
  const std::string deep = error_of([&] { (void)parse_json(std::string(100'000, '[')); });
  EXPECT_EQ(deep.find("json."), std::string::npos) << deep;
  EXPECT_EQ(deep.find("parse error"), std::string::npos) << deep;
  EXPECT_EQ(deep.find("breaks off"), std::string::npos) << deep;
  EXPECT_NE(deep.find(" at byte "), std::string::npos) << deep;
}

}  // namespace
}  // namespace myoid::inline ground
