#include "myoid/program/contents/contents_text.h"

#include <gtest/gtest.h>

namespace myoid::program {
namespace {

TEST(ContentsText, EachKeyIsALineAndTheMembersOfAListStandBelowIt) {
  const auto contents = nlohmann::ordered_json::parse(R"({
      "kind": "C3D", "rate_hz": 100.0, "frames": 3, "gravity": [0.0, -9.81, 0.0], "markers": [],
      "channels": [{"name": "BIC", "unit": "V", "lowest": -0.003, "gaps": 2}],
      "repairs": ["line 3: one"]})");
  EXPECT_EQ(contents_text(contents),
            "kind: C3D\nrate hz: 100\nframes: 3\ngravity: [0.0,-9.81,0.0]\n"
            "channels (1):\n  BIC [V]  lowest -0.003  gaps 2\nrepairs (1):\n  line 3: one\n");
}

TEST(ContentsText, NothingAListOfListsAndBytesThatAreNoUtf8AreRendered) {
  EXPECT_EQ(contents_text(nlohmann::ordered_json::object()), "");
  nlohmann::ordered_json nested = nlohmann::ordered_json::object();
  nested["a"] = nullptr;
  nested["b"]["c"] = "\xF6";
  EXPECT_EQ(contents_text(nested), "a: null\nb: {\"c\":\"\xEF\xBF\xBD\"}\n");
  const auto list = nlohmann::ordered_json::parse(R"({"a": [[1, 2], null, {"unit": "V"}]})");
  EXPECT_EQ(contents_text(list), "a (3):\n  [1,2]\n  null\n  [V]\n");
}

TEST(ContentsText, OfAMemberTheUnitStandsBehindTheNumberAndWhatIsFalseIsLeftOut) {
  const auto contents = nlohmann::ordered_json::parse(R"({"muscles": [
      {"name": "BIC", "max_force_n": 1060.0, "length_m": 0.12, "fixed": false, "locked": true, "emg": "ch_n"}]})");
  EXPECT_EQ(contents_text(contents), "muscles (1):\n  BIC  max force 1060 N  length 0.12 m  locked  emg ch_n\n");
}

TEST(ContentsText, WhereAValueComesFromStandsBehindIt) {
  EXPECT_EQ(contents_text({{"up", "z"}, {"up_from", "POINT:Y_SCREEN"}, {"not_from", 2}}),
            "up: z (from POINT:Y_SCREEN)\nnot from: 2\n");
}

TEST(ContentsText, ListsWithinAListStandBelowTheirMember) {
  const nlohmann::ordered_json clocks{
      {"other_clocks", {{{"rate_hz", 148.0}, {"channels", {{{"name", "ACC X"}}, {{"name", "ACC Y"}}}}}}}};
  EXPECT_EQ(contents_text(clocks), "other clocks (1):\n  rate 148 Hz\n    ACC X\n    ACC Y\n");
}

}  // namespace
}  // namespace myoid::program
