#include "myoid/cohort/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/files/atomic_file.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::cohort {
namespace {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(Manifest, ATableNamesPersonsStudiesAndFurtherColumns) {
  const TemporaryFolder folder;
  recording::write_file(folder / "persons.csv", "name;age;study\nP-1;31;one/study.toml\nP-2;n/a;two/study.toml\n");
  const Manifest manifest = read_manifest(folder / "persons.csv");
  ASSERT_EQ(manifest.persons.size(), 2U);
  EXPECT_EQ(manifest.persons[0].name, "P-1");
  EXPECT_EQ(manifest.persons[0].label, "P1");
  EXPECT_EQ(manifest.persons[0].study, folder / "one/study.toml");
  EXPECT_EQ(manifest.fact_names(), std::vector<std::string>{"age"});
  EXPECT_EQ(manifest.persons[0].facts[0].second, "31");
  EXPECT_EQ(manifest.persons[1].facts[0].second, "");
  EXPECT_EQ(person_folder("out", manifest.persons[1]), fs::path("out/persons/P-2"));
}

TEST(Manifest, RefusesPersonsWhoseResultsWouldMeet) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) {
    recording::write_file(folder / "m.csv", text);
    return message_of([&] { (void)read_manifest(folder / "m.csv"); });
  };
  EXPECT_THAT(complaint("name,study\nP1,a\nP-1,b\n"), HasSubstr("m.csv:3: the persons 'P1' and"));
  EXPECT_THAT(complaint("name,study\n../x,a\n"), HasSubstr("found the name '../x'"));
  EXPECT_THAT(complaint("name,study\n.stages,a\n"), HasSubstr("found the name '.stages'"));
  EXPECT_THAT(complaint("name,study\nP1,\n"), HasSubstr("has no study"));
  EXPECT_THAT(complaint("name,file\nP1,a\n"), HasSubstr("no column 'study'"));
}

TEST(Manifest, ABidsDataSetHasItsFoldersAsPersonsAndItsTableAsColumns) {
  const TemporaryFolder folder;
  for (const char* name : {"sub-02", "sub-01", "sourcedata"}) fs::create_directories(folder / name);
  EXPECT_THAT(message_of([&] { (void)read_manifest(folder.path()); }), HasSubstr("code/study.toml"));
  recording::write_file(folder / "code/study.toml", "x = 1\n");
  recording::write_file(folder / "participants.tsv", "participant_id\tweight\nsub-02\t61.5\nsub-09\t80\n");
  const Manifest manifest = read_manifest(folder.path());
  ASSERT_EQ(manifest.persons.size(), 2U);
  EXPECT_EQ(manifest.persons[0].name, "sub-01");
  EXPECT_EQ(manifest.persons[0].facts[0].second, "");
  EXPECT_EQ(manifest.persons[1].label, "02");
  EXPECT_EQ(manifest.persons[1].facts[0].second, "61.5");
  EXPECT_EQ(manifest.persons[1].study, folder / "code" / "study.toml");
}

TEST(Manifest, PersonsAreChosenByNameOrLabelInTheOrderOfTheManifest) {
  Manifest manifest;
  for (const char* label : {"01", "02", "03"})
    manifest.persons.push_back({.name = std::string("sub-") + label, .label = label});
  const auto chosen = chosen_persons(manifest, {"03", "sub-01"});
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_EQ(chosen[0]->label, "01");
  EXPECT_EQ(chosen[1]->label, "03");
  EXPECT_EQ(chosen_persons(manifest, {}).size(), 3U);
  EXPECT_THAT(message_of([&] { (void)chosen_persons(manifest, {"sub-04"}); }), HasSubstr("no person 'sub-04'"));
}

}  // namespace
}  // namespace myoid::cohort
