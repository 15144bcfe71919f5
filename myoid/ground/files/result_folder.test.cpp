#include "myoid/ground/files/result_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::inline ground {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kCommand = "myoid run study.toml --out results";

TEST(ResultFolder, ThatIsMadeAndLeftEmptyGoesWithItsParents) {
  const test::TemporaryFolder folder;
  {
    const ResultFolder result(folder / "a/b", kCommand, false);
    EXPECT_TRUE(fs::is_directory(folder / "a/b"));
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
}

TEST(ResultFolder, ThatIsFilledAndFinishedStaysWithoutTheLock) {
  const test::TemporaryFolder folder;
  {
    ResultFolder result(folder / "out", kCommand, false);
    write_file(folder / "out/file", "text");
    result.finish();
  }
  EXPECT_TRUE(fs::exists(folder / "out/file"));
  EXPECT_FALSE(fs::exists(folder / "out" / FolderLock::kFile));
  EXPECT_THAT(test::message_of([&] { ResultFolder(folder / "out", kCommand, false); }),
              HasSubstr("is not empty; give --overwrite"));
  EXPECT_NO_THROW(ResultFolder(folder / "out", kCommand, true));
  EXPECT_NO_THROW(ResultFolder(folder / "out", kCommand, false, "file"));
}

TEST(ResultFolder, ThatWasLeftUnfinishedIsTakenOverByTheSameCommandAlone) {
  const test::TemporaryFolder folder;
  {
    const ResultFolder result(folder / "out", kCommand, false);
    write_file(folder / "out/file", "text");
  }
  EXPECT_THROW(ResultFolder(folder / "out", "myoid so --out out", false), InvalidInput);
  EXPECT_THAT(ResultFolder(folder / "out", kCommand, false).note(),
              HasSubstr("is taken over from a command that did not finish"));
}

TEST(RequireResults, NamesTheFolderInsideThatHoldsThem) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "demo/result");
  const auto message = [&](const char* of) {
    return test::message_of<ReadError>([&] { require_results(folder / of, "run.json"); });
  };
  EXPECT_THAT(message("demo"), Not(HasSubstr("result?")));
  write_file(folder / "demo/result/run.json", "{}");
  EXPECT_THAT(message("demo"), HasSubstr((folder / "demo/result").string()));
  EXPECT_NE(message("absent"), "(no error)");
  EXPECT_NO_THROW(require_results(folder / "demo/result", "run.json"));
}

TEST(ResultFolder, IsRefusedWhereItIsAFileOrHasNoName) {
  const test::TemporaryFolder folder;
  write_file(folder / "file", "text");
  EXPECT_THROW(ResultFolder(folder / "file", kCommand, true), InvalidInput);
  EXPECT_THROW(ResultFolder("", kCommand, true), InvalidInput);
  for (const char* root : {"/", "//", "/.", "/dev/.."}) EXPECT_THROW(ResultFolder(root, kCommand, true), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground
