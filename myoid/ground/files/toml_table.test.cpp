#include "myoid/ground/files/toml_table.h"

#include <functional>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/message_of.h"

namespace myoid::inline ground {
namespace {

std::string message_of(const std::function<void()>& action) {
  return test::message_of<ReadError>([&] { action(); });
}

TEST(TomlTable, AnUnknownKeyIsRefusedWithItsLineAndTheNearestKnownOne) {
  const toml::table root = parse_toml("a = 1\nlowpas_hz = 6\n", "s.toml");
  TomlTable table(root, "s.toml", "[emg]");
  (void)table.number("a");
  (void)table.number("lowpass_hz");
  EXPECT_EQ(message_of([&] { table.finish(); }), "s.toml:2: [emg] lowpas_hz: unknown key; did you mean 'lowpass_hz'?");
}

TEST(TomlTable, ANumberInQuotesIsRefused) {
  const toml::table root = parse_toml("mass_kg = \"75\"\n", "s.toml");
  TomlTable table(root, "s.toml", "[subject]");
  EXPECT_NE(message_of([&] { (void)table.number("mass_kg"); }).find("expected a number"), std::string::npos);
}

TEST(TomlTable, ASyntaxErrorNamesItsLine) {
  EXPECT_NE(message_of([] { (void)parse_toml("a = 1\nb = = 2\n", "s.toml"); }).find("s.toml:2"), std::string::npos);
}

TEST(TomlTable, AChoiceListsWhatIsAllowed) {
  const toml::table root = parse_toml("use = \"callibration\"\n", "s.toml");
  TomlTable table(root, "s.toml", "[[trial]] 1");
  EXPECT_NE(message_of([&] {
              (void)table.choice("use", "x", {"calibration", "mvc"});
            }).find("expected one of calibration, mvc"),
            std::string::npos);
}

TEST(TomlTable, AnUnknownKeyNamesTheNearestBesideUnderscoresAndUnits) {
  for (const auto& [written, meant] : {std::pair{"high_pass", "highpass_hz"},
                                       {"lowpass", "lowpass_hz"},
                                       {"heldmass", "held_mass_kg"},
                                       {"highpas_hz", "highpass_hz"}}) {
    const toml::table root = parse_toml(std::string(written) + " = 20\n", "s.toml");
    TomlTable table(root, "s.toml", "[emg]");
    for (const char* known : {"highpass_hz", "lowpass_hz", "held_mass_kg", "kind"}) (void)table.number(known);
    EXPECT_NE(message_of([&] { table.finish(); }).find(std::string("did you mean '") + meant + "'"), std::string::npos)
        << written;
  }
}

TEST(ParseToml, ACommaInANumberIsNamed) {
  const auto message = [](const std::string& text) {
    try {
      (void)parse_toml(text, "f.toml");
    } catch (const ReadError& error) {
      return std::string(error.what());
    }
    return std::string("read");
  };
  const std::string comma = message("a = 1\nmass_kg = 1,25\n");
  EXPECT_NE(comma, message("a = 1\nmass_kg = 1;25\n"));
  for (const char* right : {"a = [1,2]\n", "a = {b = 1,c = 2}\n", "a = '1,25'\n", "a = 1 # 2,5\n", "'1,2' = 3\n"})
    EXPECT_EQ(message(right), "read") << right;
}

TEST(ParseToml, LettersBeyondAsciiStandInQuotesAndRemarksOnly) {
  // Found by fuzzing: U+FEBA after a key, and alone after an incomplete byte-order mark.
  for (const std::string text : {"a\xEF\xBB\xBA", "\xEF\xBB\xBE", "# \xC2\xB5\n\xC2\xB5 = 1", "a = \"x\" \xC3\xA9",
                                 "a = \"\\\xC3\xA9\"", "a = ''\xC3\xA9"})
    EXPECT_THROW((void)parse_toml(text, "f.toml"), ReadError) << text;
  // Found by fuzzing: a quote inside a number hid what came after it.
  EXPECT_THROW((void)parse_toml(std::string("a =-\0x2\0'\xEF\xB9\xBF[", 12), "f.toml"), ReadError);
  EXPECT_THROW((void)parse_toml("a = -x'\xEF\xB9\xBF", "f.toml"), ReadError);
  for (const char* text : {"\ta = [1.'*\xEF\xBF\xB5'", "a = {b = 1.'\xEF\xBF\xB5'}", "[t]\na = [\n1.'\xEF\xBF\xB5'",
                           "a = 0oa=\"\"\"\\\\5\xEF\xBB\xBD", "a = 1[\"\xEF\xBB\xBD\"]",
                           "a = \"\"\"x \\ \n \xEF\xBB\xB6\"\"\"", "\"\"\"\n\xEF\xBB\xBF\n"})  // a key of several lines
    EXPECT_THROW((void)parse_toml(text, "f.toml"), ReadError) << text;
  const toml::table t = parse_toml(
      "\xEF\xBB\xBF# caf\xC3\xA9 \"\na = \"\xC2\xB5V \\\" #\xC3\xA9\" # \xC3\xA9\n"
      "'\xC3\xA9' = '\xC3\xA9\\'\nm = \"\"\"\n\xC3\xA9 \"\xC3\xA9\" \\\n b\"\"\"\n"
      "l = '''\xC3\xA9\'\n\xC3\xA9'''\n",
      "f.toml");
  EXPECT_EQ(t["a"].value<std::string>(), "\xC2\xB5V \" #\xC3\xA9");
  EXPECT_EQ(t["\xC3\xA9"].value<std::string>(), "\xC3\xA9\\");
  EXPECT_TRUE(t.contains("m") && t.contains("l"));
  const toml::table dotted = parse_toml("a.'\xC3\xA9' = {b.'\xC3\xA9' = [1, 2], c.\"d\" = 3}\n[e.'f']\n", "f.toml");
  EXPECT_EQ(dotted["a"]["\xC3\xA9"]["c"]["d"].value<int>(), 3);
  EXPECT_TRUE(dotted["e"]["f"].is_table());
  const toml::table lists = parse_toml(
      "a = [ # first\n [1, 2], [\"\xC3\xA9\"],\n {b = [3], c = {d = 4}}]\n[[t]]\nd = 1979-05-27 "
      "07:32:00\n",
      "f.toml");
  EXPECT_EQ(lists["a"][2]["c"]["d"].value<int>(), 4);
  EXPECT_TRUE(lists["t"].is_array());
}

}  // namespace
}  // namespace myoid::inline ground
