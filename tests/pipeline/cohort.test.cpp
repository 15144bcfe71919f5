// The command `cohort` as a user runs it, with a table and as a BIDS App, with three small virtual persons.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_rows;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// Three persons of one effort and one movement each, and a fourth whose markers are missing.
class Cohort : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder / "p.toml",
               "level = \"L1\"\n[[trial]]\nname = \"mvc\"\nkind = \"mvc\"\ndirection = \"both\"\n"
               "[[trial]]\nname = \"lift\"\nkind = \"eccentric\"\nheld_mass_kg = 1.0\n");
    const Finished twin =
        myoid({"twin", "--protocol", folder / "p.toml", "--subjects", "4", "--out", folder / "people"});
    ASSERT_EQ(twin.exit_code, 0) << twin.err;
    fs::remove(folder / "people/person_000002/lift.trc");
    std::string table = "name,age,study\n";
    for (const char* n : {"1", "2", "3", "4"})
      table += std::string("P") + n + ",3" + n + ",people/person_00000" + n + "/study.toml\n";
    write_text(manifest(), table);
  }

  [[nodiscard]] std::string manifest() const { return folder / "persons.csv"; }

  [[nodiscard]] Finished cohort(const std::string& out, const std::vector<std::string>& more = {}) const {
    return cohort_of(manifest(), out, more);
  }
  [[nodiscard]] Finished cohort_of(const std::string& persons,
                                   const std::string& out,
                                   std::vector<std::string> more) const {
    more.insert(more.begin(), {"cohort", persons, "--out", folder / out});
    return myoid(more);
  }

  /// Every file by its name.
  [[nodiscard]] std::map<std::string, std::string> files(const std::string& out) const {
    std::map<std::string, std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(folder / out)) {
      if (!entry.is_regular_file()) continue;
      std::string text = read_text(entry.path());
      for (std::size_t at = text.find(folder / out); at != std::string::npos; at = text.find(folder / out))
        text.replace(at, (folder / out).string().size(), "OUT");
      result[fs::relative(entry.path(), folder / out).string()] = text;
    }
    return result;
  }

  static void expect_same(const std::map<std::string, std::string>& first,
                          const std::map<std::string, std::string>& second) {
    EXPECT_EQ(first.size(), second.size());
    for (const auto& [name, text] : first) {
      const auto other = second.find(name);
      EXPECT_TRUE(other != second.end() && other->second == text) << name;
    }
  }

  TemporaryFolder folder;
};

// No study is there, so that every person fails at once.
TEST(CohortOfMany, HasTwentyLinesForThosePersonsWhoAreNotDone) {
  const TemporaryFolder folder;
  std::string table = "name,study\n";
  for (int i = 10; i < 40; ++i) table += "P" + std::to_string(i) + ",absent.toml\n";
  write_text(folder / "persons.csv", table);
  const Finished run = myoid({"cohort", folder / "persons.csv", "--out", folder / "out", "--quiet"});
  EXPECT_EQ(run.exit_code, 5) << run.err;
  EXPECT_THAT(run.out, HasSubstr("P29 "));
  EXPECT_THAT(run.out, Not(HasSubstr("P30 ")));
  EXPECT_THAT(run.out, HasSubstr("0 of 30 "));
}

TEST_F(Cohort, HasTheSameBytesForOneJobAndForThreeAndNamesWhoFailed) {
  const Finished one = cohort("one", {"--jobs", "1", "--threads", "1", "--keep", "all"});
  EXPECT_EQ(one.exit_code, 5) << one.err;
  EXPECT_THAT(one.err, HasSubstr("P2 failed: "));
  EXPECT_THAT(one.err, HasSubstr("lift.trc"));
  EXPECT_THAT(one.out, HasSubstr("P4"));
  EXPECT_EQ(cohort("three", {"--jobs", "3", "--keep", "all"}).exit_code, 5);
  const auto first = files("one");
  EXPECT_GT(first.size(), 60U);
  expect_same(first, files("three"));

  // The numbers are those of `run`.
  ASSERT_NE(myoid({"run", folder / "people/person_000003/study.toml", "--out", folder / "run"}).exit_code, 3);
  EXPECT_EQ(first.at("persons/P3/parameters.csv"), read_text(folder / "run/parameters.csv"));
  const auto rows = read_rows(folder / "one/cohort.csv");
  std::size_t count = 0;
  for (const char* name : {"P1", "P3", "P4"})
    count += read_rows(folder / "one/persons" / name / "parameters.csv").size();
  EXPECT_EQ(rows.size(), count);
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.at("person") == "P2"; }), 0);
  EXPECT_EQ(rows.back().at("age"), "34");
  EXPECT_EQ(read_rows(folder / "one/persons.csv").at(1).at("outcome"), "failed");
}

TEST_F(Cohort, APersonIsAFewSmallFilesUnlessAllAreKept) {
  constexpr std::size_t kMostFiles = 30, kMostBytes = 2'000'000;
  ASSERT_EQ(cohort("out").exit_code, 5);
  const auto of_person = [&](const char* ending) {
    std::size_t count = 0, bytes = 0;
    for (const auto& [name, text] : files("out")) {
      if (!name.starts_with("persons/P1/") || !name.ends_with(ending)) continue;
      ++count;
      bytes += text.size();
    }
    return std::pair(count, bytes);
  };
  EXPECT_LE(of_person("").first, kMostFiles);
  EXPECT_LE(of_person("").second, kMostBytes);
  EXPECT_EQ(of_person("report.html").first, 1U);
  EXPECT_EQ(of_person(".sto").first, 0U);
  const std::string parameters = files("out").at("persons/P1/parameters.csv");
  // Another wish computes the person again, and leaves nothing of the former.
  ASSERT_EQ(cohort("out", {"--keep", "tables"}).exit_code, 5);
  EXPECT_EQ(of_person("report.html").first, 0U);
  EXPECT_EQ(files("out").at("persons/P1/parameters.csv"), parameters);
  ASSERT_EQ(cohort("out", {"--keep", "all", "--work-dir", folder / "work"}).exit_code, 5);
  EXPECT_GT(of_person(".sto").first, 5U);
  EXPECT_TRUE(fs::exists(folder / "work/P1/.stages"));
  EXPECT_FALSE(fs::exists(folder / "out/persons/P1/.stages"));
}

TEST_F(Cohort, AKilledCohortGoesOnWhereItStoppedWithTheSameBytes) {
  ASSERT_EQ(cohort("whole").exit_code, 5);
  {
    myoid::test::Running running({"cohort", manifest(), "--out", folder / "killed", "--jobs", "1", "--threads", "1"});
    while (!running.ended() && !fs::exists(folder / "killed/persons/P1/outcome.json"))
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    running.send(SIGKILL);
    (void)running.wait();
  }
  ASSERT_FALSE(fs::exists(folder / "killed/cohort.csv"));
  const Finished resumed = cohort("killed");
  EXPECT_EQ(resumed.exit_code, 5) << resumed.err;
  EXPECT_THAT(resumed.out, HasSubstr("as before"));
  expect_same(files("whole"), files("killed"));

  // A changed recording is computed again, an unchanged one is not.
  myoid::test::replace_in(folder / "people/person_000004/study.toml", "mass_kg = 73.0", "mass_kg = 74.0");
  const std::string before = read_text(folder / "killed/persons/P4/outcome.json");
  const Finished again = cohort("killed", {"--person", "P3", "--person", "P4"});
  EXPECT_THAT(again.out, HasSubstr("P3"));
  EXPECT_THAT(again.out.substr(again.out.find("P4")), Not(HasSubstr("as before")));
  EXPECT_TRUE(read_text(folder / "killed/persons/P4/outcome.json") != before);
}

TEST_F(Cohort, AFolderWithOtherFilesIsLeftAlone) {
  fs::create_directories(folder / "other");
  write_text(folder / "other/report.html", "mine");
  const Finished refused = cohort("other");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_THAT(refused.err, HasSubstr("holds other files"));
  EXPECT_EQ(read_text(folder / "other/report.html"), "mine");
  EXPECT_EQ(cohort("new", {"--person", "P9"}).exit_code, 3);
  EXPECT_FALSE(fs::exists(folder / "new")) << "bad input leaves no folder";

  const fs::path stages = folder / "work/P1/.stages", linked = folder / "work/P3/.stages";
  fs::create_directories(stages);
  fs::create_directories(linked.parent_path());
  write_text(stages / "notes.txt", "mine");
  fs::create_directory_symlink(folder / "other", linked);
  ASSERT_EQ(cohort("new", {"--work-dir", folder / "work"}).exit_code, 5);
  EXPECT_EQ(read_text(stages / "notes.txt"), "mine");
  EXPECT_TRUE(fs::is_symlink(linked));
  for (const fs::path& store : {stages, folder / "other"})
    EXPECT_EQ(std::distance(fs::directory_iterator(store), {}), 1) << "stages are left in " << store;
  EXPECT_FALSE(fs::exists(folder / "work/P4/.stages"));
}

TEST_F(Cohort, AWorkflowIsFilesAndNoNumbers) {
  for (const std::string engine : {"snakemake", "slurm", "parallel"}) {
    const Finished done = cohort(engine, {"--workflow", engine});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("workflow/"));
    EXPECT_EQ(read_text(folder / engine / "workflow/persons.txt"), "P1\nP2\nP3\nP4\n");
    EXPECT_FALSE(fs::exists(folder / engine / "persons/P1"));
  }
  EXPECT_EQ(cohort("x", {"--workflow", "cron"}).exit_code, 2);
}

TEST_F(Cohort, ABidsDataSetIsAnsweredInTheFormOfABidsApp) {
  const fs::path data = folder / "data";
  fs::create_directories(data / "code");
  for (const char* n : {"1", "2", "3"})
    fs::rename(folder / (std::string("people/person_00000") + n), data / (std::string("sub-0") + n));
  std::string study = read_text(data / "sub-01/study.toml");
  const auto set = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = study.find(from); at != std::string::npos; at = study.find(from, at + to.size()))
      study.replace(at, from.size(), to);
  };
  for (const char* file : {"model.osim", "mvc", "lift", "truth.csv"})
    set("= \"" + std::string(file) + (std::string(file).find('.') == std::string::npos ? "." : "\""),
        "= \"../{name}/" + std::string(file) + (std::string(file).find('.') == std::string::npos ? "." : "\""));
  set("\"mvc_", "\"../{name}/mvc_");
  set("\"lift_", "\"../{name}/lift_");
  set("73.0", "{weight}");
  write_text(data / "code/study.toml", study);
  write_text(data / "participants.tsv", "participant_id\tweight\nsub-01\t73.0\nsub-03\t73.0\n");

  const auto bids = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"cohort", data, folder / "derivative"});
    return myoid(more);
  };
  const Finished some = bids({"participant", "--participant-label", "01", "02"});
  EXPECT_EQ(some.exit_code, 5) << some.err;
  EXPECT_THAT(some.err, HasSubstr("sub-02 failed"));
  EXPECT_THAT(some.err, HasSubstr("no value in the column 'weight'"));
  EXPECT_FALSE(fs::exists(folder / "derivative/persons/sub-03"));
  EXPECT_FALSE(fs::exists(folder / "derivative/cohort.csv"));
  EXPECT_NE(bids({"participant", "--participant-label", "03"}).exit_code, 3);
  const Finished group = bids({"group"});
  EXPECT_EQ(group.exit_code, 5) << group.err;
  EXPECT_TRUE(fs::exists(folder / "derivative/dataset_description.json"));
  EXPECT_TRUE(fs::exists(folder / "derivative/sub-03/sub-03_desc-identified_parameters.tsv"));
  EXPECT_FALSE(fs::exists(folder / "derivative/sub-02"));

  // The filled template is the person's own study: the same numbers.
  ASSERT_NE(myoid({"run", data / "sub-03/study.toml", "--out", folder / "run"}).exit_code, 3);
  EXPECT_EQ(read_text(folder / "derivative/persons/sub-03/parameters.csv"), read_text(folder / "run/parameters.csv"));

  // `bids` is another name of the command, which says so, and asks for the level as a BIDS App must. The options of
  // `cohort` name the same steps.
  const auto results = files("derivative");
  fs::remove_all(folder / "derivative");
  ASSERT_EQ(
      myoid({"bids", data, folder / "derivative", "participant", "--participant_label", "01", "02", "03"}).exit_code,
      5);
  const Finished other = myoid({"bids", data, folder / "derivative", "group"});
  EXPECT_EQ(other.exit_code, group.exit_code);
  EXPECT_EQ(other.out, group.out);
  EXPECT_THAT(other.err, HasSubstr("myoid cohort "));
  expect_same(results, files("derivative"));
  EXPECT_EQ(myoid({"bids", data, folder / "none"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "none"));
  fs::remove_all(folder / "derivative");
  ASSERT_EQ(cohort_of(data, "derivative", {"--person", "01", "02", "03"}).exit_code, 5);
  EXPECT_FALSE(fs::exists(folder / "derivative/cohort.csv"));
  EXPECT_EQ(cohort_of(data, "derivative", {"--group"}).exit_code, group.exit_code);
  expect_same(results, files("derivative"));
}

}  // namespace
