#include "myoid/ground/files/name_ids.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "myoid/ground/files/result_names.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {
namespace {

using Texts = std::vector<std::string>;

constexpr std::string_view kLettersAndDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";

const Texts kOdd{"slow 2 kg",
                 "slow_2_kg",
                 "A",
                 "a",
                 "B",
                 "\u00fcben",
                 "\u00e4ben",
                 "BIC (long)",
                 "O'Neil",
                 "\"q\"",
                 "李",
                 "王",
                 "😀",
                 "..",
                 ".",
                 "-x",
                 "--",
                 "a/b",
                 "a\\b",
                 ".stages",
                 "run.json",
                 "Report.HTML",
                 "figures",
                 "CON",
                 "nul.txt",
                 "com1",
                 "ends.",
                 "x:y*?",
                 "$(touch x)",
                 "{trial}",
                 "%41",
                 "#1",
                 "a,b;c",
                 "a\tb",
                 "=1+1",
                 "__proto__",
                 "1",
                 "TRUE",
                 std::string(100000, 'n'),
                 std::string(100000, 'n') + "m",
                 " a",
                 "a ",
                 "~",
                 "*",
                 "a\u202eb"};

TEST(NameIds, AreUniqueNamesOfFilesForAnyNames) {
  const Texts ids = ids_of(kOdd, IdFor::file, result_names());
  std::set<std::string> small;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::string& id = ids[i];
    ASSERT_FALSE(id.empty());
    EXPECT_LE(id.size(), 60U);
    EXPECT_EQ(id.find_first_not_of(std::string(kLettersAndDigits) + "_-."), std::string::npos) << id;
    EXPECT_FALSE(id.front() == '.' || id.front() == '-' || id.back() == '.') << id;
    const std::string stem = small_letters(id.substr(0, id.find('.')));
    for (const char* device : {"con", "nul", "com1"}) EXPECT_NE(stem, device);
    EXPECT_TRUE(small.insert(small_letters(id)).second) << id << " of " << kOdd[i];
  }
  for (const std::string_view name : result_names())
    EXPECT_FALSE(small.contains(small_letters(std::string(name)))) << name;
}

TEST(NameIds, ThatAreIdsAlreadyStayAndOthersAreReadable) {
  EXPECT_EQ(ids_of({"flex_slow", "P-1", "a.b", "B"}), (Texts{"flex_slow", "P-1", "a.b", "B"}));
  EXPECT_EQ(ids_of({"slow 2 kg", "BIC (long)", "a/b", ".x"}), (Texts{"slow_2_kg", "BIC_long", "a_b", "x"}));
  EXPECT_EQ(ids_of({"sub 01", "x-2"}, IdFor::label), (Texts{"sub01", "x2"}));
  EXPECT_EQ(ids_of({"2 kg", "ik", "_x"}, IdFor::variable), (Texts{"x2_kg", "ik", "x"}));
  const Texts both = ids_of({"slow 2 kg", "slow_2_kg"});
  EXPECT_EQ(both[1], "slow_2_kg");
  EXPECT_TRUE(both[0].starts_with("slow_2_kg-")) << both[0];
}

TEST(NameIds, DependOnTheNamesAndNotOnTheirOrder) {
  Texts reversed = kOdd;
  std::ranges::reverse(reversed);
  const NameIds one(kOdd), other(reversed);
  for (const std::string& name : kOdd) EXPECT_EQ(one.of(name), other.of(name));
}

TEST(NameIds, OfLabelsAndVariablesHoldTheirLetters) {
  for (const auto& [place, marks] : {std::pair{IdFor::label, ""}, std::pair{IdFor::variable, "_"}}) {
    const Texts ids = ids_of(kOdd, place);
    std::set<std::string> all;
    for (const std::string& id : ids) {
      EXPECT_EQ(id.find_first_not_of(std::string(kLettersAndDigits) + marks), std::string::npos) << id;
      EXPECT_LE(id.size(), 63U);
      EXPECT_FALSE(place == IdFor::variable && kLettersAndDigits.find(id[0]) >= 52) << id;
      EXPECT_TRUE(all.insert(small_letters(id)).second) << id;
    }
  }
}

TEST(NameIds, EqualNamesHaveIdsOfTheirOwn) {
  const Texts ids = ids_of({"a", "a", "a"});
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), 3U);
}

TEST(NameRefusal, NamesWhatCannotBeSeen) {
  for (const char* name : {"a", "slow 2 kg", "李", "😀", "a\u200db", "..", "\\n"})
    EXPECT_EQ(name_refusal(name), "") << name;
  for (const char* name : {"", "  ", "a\nb", "a\tb", "\x1b[31m", "a\x7f", "\xff", "\u0085", "a\u202eb"})
    EXPECT_NE(name_refusal(name), "") << name;
  EXPECT_NE(name_refusal("a\x07").find("U+0007 at byte 2"), std::string::npos);
}

}  // namespace
}  // namespace myoid::inline ground
