#include "myoid/ground/files/quoted_text.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/toml_table.h"

#include "tests/support/temporary_folder.h"

namespace myoid::inline ground {
namespace {

const std::array<std::string, 12> kWords{
    "a b",      "it's",       "$HOME `x` \"y\" \\", "--z", "$(touch x)", "{} {.} {1} {= $_=1 =} {#}",
    "{a}{{b}}", "two\nlines", "Jürgen 李 😀",        "",    "tab\tend ",  "-e 's/\\n/x/'"};

/// Returns the standard output of a command.
std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  return text;
}

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

TEST(ShellWord, IsReadByAShellAsItIs) {
  for (const std::string& word : kWords) EXPECT_EQ(output_of("printf %s " + shell_word(word)), word);
  EXPECT_EQ(shell_word("study/flex_2.5kg.toml"), "study/flex_2.5kg.toml");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(ParallelWord, IsReadByBothShellsOfGnuParallelAsItIs) {
  if (!has_program("parallel")) GTEST_SKIP() << "GNU parallel is not installed";
  const test::TemporaryFolder folder;
  // The words are folders of a script, as in the workflow of a cohort.
  std::filesystem::path script = folder.path();
  for (const std::string& word : kWords) script /= "p" + word;
  write_file(script, "printf '%s' \"$1\"");
  EXPECT_EQ(output_of("cd " + shell_word(folder.path().string()) + " && parallel sh " + parallel_word(script.string()) +
                      " ::: arg </dev/null"),
            "arg");
  EXPECT_FALSE(std::filesystem::exists(folder / "x"));
}

TEST(PythonText, IsReadByPythonAsItIs) {
  if (!has_program("python3")) GTEST_SKIP() << "Python is not installed";
  std::string script = "import sys\n", expected;
  for (const std::string& word : kWords) {
    script += "sys.stdout.write(" + python_text(word) + " + '|')\n";
    expected += word + "|";
  }
  EXPECT_EQ(output_of("python3 -X utf8 -c " + shell_word(script)), expected);
}

TEST(EscapeXml, LeavesNoTagNoQuoteAndNoControlCharacter) {
  EXPECT_EQ(escape_xml("<a b=\"c\">&'\x01\x1b\u0085\u202e\xff"
                       "é"),
            "&lt;a b=&quot;c&quot;&gt;&amp;'?????é");
}

TEST(UrlPath, EncodesAllButLettersDigitsAndMarks) {
  EXPECT_EQ(url_path("../a b#1?/50%/ä:x"), "../a%20b%231%3F/50%25/%C3%A4%3Ax");
}

TEST(CsvCell, IsQuotedWhereAReaderWouldTakeItForSomethingElse) {
  EXPECT_EQ(csv_cell("plain text"), "plain text");
  for (const char* text : {"a,b", "a;b", "#1", " a", "a ", "a\tb"})
    EXPECT_EQ(csv_cell(text), '"' + std::string(text) + '"');
  EXPECT_EQ(csv_cell("say \"x\""), "\"say \"\"x\"\"\"");
}

TEST(TerminalText, HoldsNoControlCharacter) {
  EXPECT_EQ(terminal_text("a\x1b[31m\r\u009b\u202e\xff\n\tb"), "a\\u001b[31m\\u000d\\u009b\\u202e\xEF\xBF\xBD\n\tb");
  EXPECT_EQ(terminal_text("trial " + std::string(100000, 'n') + " is bad\n"),
            "trial " + std::string(59, 'n') + "… is bad\n");
}

TEST(Elided, CutsByCharactersAndNotByBytes) {
  EXPECT_EQ(elided("äöü", 3), "äöü");
  EXPECT_EQ(elided("äöüß", 3), "äö…");
  EXPECT_EQ(with_short_words("a äöüß b", 3), "a äö… b");
}

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
}  // namespace myoid::inline ground
