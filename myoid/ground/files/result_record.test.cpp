#include "myoid/ground/files/result_record.h"

#include <cstdlib>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/input_log.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::inline ground {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// Writes a file as a person does, past this program.
void by_hand(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// A folder `out` with results of `run`.
void make_results(const fs::path& out, const std::vector<std::string>& files) {
  RecordedFolder held(out, "run");
  for (const std::string& file : files) write_file(out / file, "result " + file);
  held.finish();
}

TEST(ResultRecord, NamesEachFileWithTheHashOfItsContentInTheFormOfSha256sum) {
  const test::TemporaryFolder folder;
  const std::string odd = "swing 2 kg (ü) \\ \n'x'/ik.mot";
  make_results(folder / "out", {"report.html", odd});
  const std::string list = read_text_file(folder / "out" / kRecordFile);
  EXPECT_THAT(list, HasSubstr("\n# by run\n"));
  EXPECT_THAT(list, HasSubstr("\n" + sha256("result report.html") + "  report.html\n"));
  if (std::system("sha256sum --version > /dev/null 2>&1") == 0) {
    const std::string check = "cd '" + (folder / "out").string() + "' && sha256sum --strict --quiet -c .myoid.files";
    EXPECT_EQ(std::system(check.c_str()), 0);
  }
  EXPECT_EQ(author_of(folder / "out/report.html"), "run");
  EXPECT_EQ(author_of(folder / "out/other.html"), "");
  RecordedFolder held(folder / "out", "run");
  EXPECT_EQ(standing_of(folder / "out" / odd), Standing::result);
  remove_results(folder / "out");
  EXPECT_FALSE(fs::exists(folder / "out" / odd));
}

TEST(ResultRecord, OnlyUnchangedResultsOfTheSameCommandAreRemoved) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  make_results(out, {"a.sto", "edited.csv", "trial/ik.mot", "linked/id.sto"});
  {
    RecordedFolder other(out, "twin");
    write_file(out / "markers.trc", "raw");
    other.finish();
  }
  by_hand(out / "edited.csv", "by a person");
  by_hand(out / "trial/notes.txt", "mine");
  by_hand(out / "report.html", "mine");
  // The folder of a result becomes a link to the same bytes elsewhere.
  fs::rename(out / "linked", folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", out / "linked");
  RecordedFolder held(out, "run");
  remove_earlier_results(out);
  EXPECT_FALSE(fs::exists(out / "a.sto"));
  EXPECT_FALSE(fs::exists(out / "trial/ik.mot"));
  for (const char* kept :
       {"out/edited.csv", "out/trial/notes.txt", "out/report.html", "out/markers.trc", "elsewhere/id.sto"})
    EXPECT_TRUE(fs::exists(folder / kept)) << kept;
  EXPECT_THAT(held.take_notes(), ElementsAre(HasSubstr("kept: edited.csv")));
}

TEST(ResultRecord, OfAnotherFolderOrWithPathsThatLeadOutRemovesNothing) {
  const test::TemporaryFolder folder;
  make_results(folder / "out", {"a.sto"});
  by_hand(folder / "a.sto", "result a.sto");
  by_hand(folder / "mine/a.sto", "mine");
  std::string list = read_text_file(folder / "out" / kRecordFile);
  list += sha256("result a.sto") + "  ../a.sto\n" + sha256("result a.sto") + "  " + (folder / "a.sto").string() + "\n";
  by_hand(folder / "mine" / kRecordFile, list);
  RecordedFolder held(folder / "mine", "run");
  remove_results(folder / "mine");
  EXPECT_TRUE(fs::exists(folder / "a.sto"));
  EXPECT_EQ(read_text_file(folder / "mine/a.sto"), "mine");
}

TEST(ResultRecord, AResultReplacesItsLikeAndNothingElse) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  make_results(out, {"a.sto", "edited.csv"});
  {
    RecordedFolder other(out, "so");
    write_file(out / "forces.sto", "of so");
    other.finish();
  }
  by_hand(out / "edited.csv", "by a person");
  by_hand(out / "foreign.csv", "mine");
  by_hand(folder / "target.csv", "mine");
  fs::create_symlink(folder / "target.csv", out / "link.csv");
  RecordedFolder held(out, "run");
  write_file(out / "a.sto", "new");
  write_file(out / "edited.csv", "new");
  EXPECT_EQ(read_text_file(out / "edited.csv"), "new");
  EXPECT_EQ(read_text_file(out / "kept-1/edited.csv"), "by a person");
  EXPECT_THAT(held.take_notes(), ElementsAre(HasSubstr("kept-1: edited.csv")));
  for (const char* name : {"foreign.csv", "link.csv", "forces.sto"})
    EXPECT_THROW(write_file(out / name, "new"), InvalidInput) << name;
  EXPECT_EQ(read_text_file(folder / "target.csv"), "mine");
  EXPECT_EQ(read_text_file(out / "forces.sto"), "of so");
}

TEST(ResultRecord, AFolderInTheFolderThatIsALinkIsNotWrittenThrough) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "elsewhere");
  fs::create_directories(folder / "out");
  fs::create_directory_symlink(folder / "elsewhere", folder / "out/figures");
  RecordedFolder held(folder / "out", "run");
  EXPECT_THROW(write_file(folder / "out/figures/a.svg", "x"), InvalidInput);
  EXPECT_TRUE(fs::is_empty(folder / "elsewhere"));
}

TEST(ResultRecord, AnInputIsNeitherRemovedNorReplacedByWhateverName) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  make_results(out, {"a.sto", "b.sto", "c.sto"});
  fs::create_hard_link(out / "b.sto", folder / "hard.sto");
  fs::create_symlink(out / "c.sto", folder / "soft.sto");
  const InputLog inputs;
  for (const fs::path& file : {out / "a.sto", folder / "hard.sto", folder / "soft.sto"}) (void)read_text_file(file);
  RecordedFolder held(out, "run");
  remove_results(out);
  for (const char* name : {"a.sto", "b.sto", "c.sto"}) {
    EXPECT_EQ(standing_of(out / name), Standing::input);
    EXPECT_THROW(write_file(out / name, "new"), InvalidInput);
    EXPECT_EQ(read_text_file(out / name), std::string("result ") + name);
  }
  EXPECT_THROW(write_file(folder / "soft.sto", "new"), InvalidInput) << "outside every folder of results too";
  write_file(out / "own.sto", "one");
  (void)read_text_file(out / "own.sto");
  EXPECT_NO_THROW(write_file(out / "own.sto", "two")) << "what the process wrote itself is no input";
}

TEST(ResultRecord, KnowsTheFilesOfACommandThatWasKilled) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  {
    RecordedFolder killed(out, "convert");
    write_file(out / "walk.trc", "half of the work");
  }
  {
    RecordedFolder again(out, "convert");
    EXPECT_EQ(standing_of(out / "walk.trc"), Standing::unfinished);
    write_file(out / "walk.trc", "half of the work");
    again.finish();
  }
  RecordedFolder third(out, "convert");
  EXPECT_EQ(standing_of(out / "walk.trc"), Standing::result);
  by_hand(out / "walk.trc", "edited");
  EXPECT_EQ(standing_of(out / "walk.trc"), Standing::changed);
  EXPECT_FALSE(recorded_content(out / "walk.trc"));
}

TEST(ResultRecord, OfAnEarlierVersionIsMissingAndItsFilesAreMovedAside) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  by_hand(out / "run.json", "{\n  \"program\": \"myoid\"\n}\n");
  by_hand(out / "report.html", "old");
  by_hand(out / "notes.txt", "mine");
  for (int turn = 0; turn < 2; ++turn) {
    ResultFolder held(out, "myoid run s.toml", true);
    write_file(out / "report.html", "new");  // the first turn is stopped here
    if (turn == 1) write_file(out / "run.json", "new");
    if (turn == 1) held.finish();
  }
  EXPECT_EQ(read_text_file(out / "kept-1/report.html"), "old");
  EXPECT_TRUE(fs::exists(out / "kept-2/run.json"));
  EXPECT_EQ(read_text_file(out / "report.html"), "new");
  EXPECT_EQ(read_text_file(out / "notes.txt"), "mine");
}

TEST(ResultRecord, AListOfAnotherKindIsRefused) {
  const test::TemporaryFolder folder;
  by_hand(folder / "out" / kRecordFile, "a file of mine\n");
  RecordedFolder held(folder / "out", "run");
  EXPECT_THROW(write_file(folder / "out/a.sto", "x"), InvalidInput);
  EXPECT_EQ(read_text_file(folder / "out" / kRecordFile), "a file of mine\n");
  EXPECT_FALSE(fs::exists(folder / "out/a.sto"));
}

}  // namespace
}  // namespace myoid::inline ground
