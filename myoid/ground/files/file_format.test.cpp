#include "myoid/ground/files/file_format.h"

#include <set>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/toml_table.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/places.h"
#include "tests/support/printed_page.h"

namespace myoid::inline ground {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Returns the table in Markdown, for docs/guide/file-formats.md.
std::string file_formats_markdown() {
  const auto code = [](const std::vector<std::string_view>& words) {
    std::string text;
    for (const std::string_view word : words) text += fmt::format("{}`{}`", text.empty() ? "" : ", ", word);
    return text.empty() ? std::string("–") : text;
  };
  const auto unit = [&](std::string_view name) { return name.empty() ? code({}) : code({name}); };
  std::string text = "| ending | holds | written as | reader | writer |\n| --- | --- | --- | --- | --- |\n";
  for (const FormatEntry& entry : file_formats())
    text += fmt::format("| {} | {} | {} | {} | {} |\n", code(entry.endings), entry.holds, code(entry.written),
                        unit(entry.reader), unit(entry.writer));
  return text;
}

TEST(FileFormat, TheTableIsTheOneThatThePagePrints) {
  test::expect_printed("docs/guide/file-formats.md", "file formats", file_formats_markdown());
}

TEST(FileFormat, EachHasItsReaderAndWriterAmongTheSources) {
  for (const FormatEntry& entry : file_formats()) {
    for (const std::string_view unit : {entry.reader, entry.writer}) {
      if (unit.empty()) continue;
      const auto header = test::source_dir() / "myoid" / (std::string(unit) + ".h");
      EXPECT_TRUE(std::filesystem::exists(header)) << header;
    }
    EXPECT_EQ(entry.writer.empty(), entry.written.empty()) << entry.endings.front();
  }
}

TEST(FileFormat, AnEndingBelongsToOneFormat) {
  std::set<std::string_view> seen;
  for (const FormatEntry& entry : file_formats()) {
    for (const std::string_view ending : entry.endings) {
      EXPECT_TRUE(seen.insert(ending).second) << ending;
      EXPECT_EQ(format_of("a/lift" + std::string(ending)), entry.format) << ending;
    }
    for (const std::string_view ending : entry.written) EXPECT_THAT(entry.endings, ::testing::Contains(ending));
  }
}

TEST(FileFormat, TheLongestEndingDecidesInAnyCase) {
  EXPECT_EQ(format_of("Lift.C3D"), FileFormat::c3d);
  EXPECT_EQ(format_of("sub-01_motion.tsv"), FileFormat::bids_motion);
  EXPECT_EQ(format_of("sub-01_emotion.tsv"), FileFormat::text_table);
  EXPECT_EQ(format_of("lift.dat"), std::nullopt);
  EXPECT_EQ(format_of("folder.c3d/lift"), std::nullopt);
  EXPECT_EQ(format_of(".trc"), std::nullopt);  // A name without an ending.
}

TEST(FileFormat, TheListsOfEndingsComeFromTheTable) {
  EXPECT_THAT(written_endings_text(), AllOf(HasSubstr(".trc, "), HasSubstr(" and .csv")));
  EXPECT_TRUE(is_written_ending(".csv"));
  EXPECT_FALSE(is_written_ending(".tsv"));
  EXPECT_FALSE(is_written_ending(".osim"));
  EXPECT_EQ(endings_text([](const FormatEntry& e) { return e.format == FileFormat::edf; }), ".edf and .bdf");
}

TEST(FileFormat, OtherProgramsFormatsAreRefusedWithTheNextStep) {
  for (const char* name : {"a.acq", "a.mat", "b.XLSX", "a.mvnx", "a.xdf", "a.qtm", "a.hpf", "a.slk", "a.forces"}) {
    try {
      refuse_foreign_format(name);
      ADD_FAILURE() << name;
    } catch (const ReadError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(name), HasSubstr("not read; "))) << name;
    }
  }
  for (const char* name : {"a.csv", "a.c3d", "a", "a.xyz", "acq", "mat.sto"})
    EXPECT_NO_THROW(refuse_foreign_format(name)) << name;
}

TEST(WrongKind, NamesTheKindOfTheFileAndTheOneExpected) {
  EXPECT_THAT(wrong_kind("a/push.TRC", {FileFormat::model}, "a model (.osim)"),
              AllOf(HasSubstr(".trc"), HasSubstr("markers"), HasSubstr("a model (.osim)")));
  EXPECT_EQ(wrong_kind("a.osim", {FileFormat::model}, "a model"), "");
  EXPECT_EQ(wrong_kind("a.dat", {FileFormat::model}, "a model"), "");
}

TEST(WrongKind, TheReadersSayIt) {
  const auto message = [](auto read) -> std::string {
    try {
      read();
    } catch (const ReadError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message([] { static_cast<void>(recording::parse_storage("<xml/>\n", "m.osim")); }),
              HasSubstr("m.osim: this is a .osim file (a model)"));
  EXPECT_THAT(message([] { static_cast<void>(parse_toml("<xml/>\n", "m.osim")); }),
              HasSubstr("a study or protocol (.toml) is expected"));
}

}  // namespace
}  // namespace myoid::inline ground
