#include "myoid/ground/files/record_list.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::inline ground {
namespace {

TEST(RecordList, ALineIsTheOneOfSha256sumWhateverTheName) {
  if (std::system("sha256sum --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no sha256sum";
  const test::TemporaryFolder folder;
  for (const std::string name :
       {"plain.csv", "two words.csv", "back\\slash", "two\nlines", "'quote\"s", "\xE6\x9D\x8E"}) {
    write_file(folder / "f/" / name, "content of " + name);
    const std::string command = "cd '" + (folder / "f").string() + "' && sha256sum *";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
    ASSERT_TRUE(pipe);
    std::string told;
    for (int c = 0; (c = std::fgetc(pipe.get())) != EOF;) told += static_cast<char>(c);
    EXPECT_EQ(record_line(sha256("content of " + name), name), told);
    std::filesystem::remove_all(folder / "f");
  }
}

TEST(RecordList, IsReadAsItWasWritten) {
  RecordContent list;
  list.files["two\nlines\\.csv"] = {{std::string(64, 'a'), "run", true}};
  list.files["trial/ik.mot"] = {{std::string(64, 'b'), "run", false}, {std::string(64, 'c'), "report", true}};
  list.commands = {"run", "report"};
  const RecordContent read = parse_record(record_text(list));
  EXPECT_TRUE(read.exists);
  EXPECT_EQ(read.commands, list.commands);
  ASSERT_EQ(read.files.size(), 2U);
  EXPECT_EQ(read.files.at("two\nlines\\.csv")[0].sha256, std::string(64, 'a'));
  int unfinished = 0;
  for (const RecordedFile& file : read.files.at("trial/ik.mot")) unfinished += file.whole ? 0 : 1;
  EXPECT_EQ(read.files.at("trial/ik.mot").size(), 2U);
  EXPECT_EQ(unfinished, 1);
}

// A list from a stranger must not name files outside its folder.
TEST(RecordList, PathsThatLeaveTheFolderCountForNothing) {
  std::string text(kSignature);
  text += "# by run\n";
  for (const char* path : {"/etc/passwd", "../other.csv", "a/../../b", "./c", ""})
    text += std::string(64, 'a') + "  " + path + "\n";
  text += std::string(64, 'a') + "  inside/d.csv\n";
  const RecordContent read = parse_record(text);
  ASSERT_EQ(read.files.size(), 1U);
  EXPECT_TRUE(read.files.contains("inside/d.csv"));
  EXPECT_FALSE(parse_record(text.substr(1)).exists);
  EXPECT_FALSE(parse_record("").exists);
}

TEST(RecordList, AResultThatSomebodyChangedIsNamed) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", "1,2\n");
  write_file(folder / "b.csv", "1,2\n");
  RecordContent list;
  list.commands = {"run"};
  list.files["a.csv"] = {{sha256("1,2\n"), "run", true}};
  list.files["gone.csv"] = {{sha256("1,2\n"), "run", true}};
  write_file(folder / std::string(kRecordFile), record_text(list));
  const std::vector<std::string> names{"a.csv", "b.csv", "gone.csv"};
  EXPECT_TRUE(changed_since_written(folder.path(), names).empty());
  write_file(folder / "a.csv", "1,3\n");
  const std::vector<std::string> said = changed_since_written(folder.path(), names);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].find((folder / "a.csv").string() + ": was changed since 'myoid run' wrote it"), 0U);
}

TEST(RecordList, TheHashOfAFileIsThatOfItsBytes) {
  const test::TemporaryFolder folder;
  const std::string large(200'000, 'x');
  write_file(folder / "large", large);
  const OpenFile file(open((folder / "large").c_str(), O_RDONLY | O_CLOEXEC));
  ASSERT_TRUE(file);
  EXPECT_EQ(hash_of(file.get()), sha256(large));
  EXPECT_EQ(content_of(file.get()), large);
}

}  // namespace
}  // namespace myoid::inline ground
