#include "myoid/results/cohort/manifest.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(Manifest, ATableNamesPersonsStudiesAndFurtherColumns) {
  const TemporaryFolder folder;
  write_file(folder / "persons.csv", "name;age;study\nP-1;31;one/study.toml\nP-2;n/a;two/study.toml\n");
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

TEST(Manifest, RefusesOnlyWhatIsNoNameOrStandsTwice) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) {
    write_file(folder / "m.csv", text);
    return message_of([&] { (void)read_manifest(folder / "m.csv"); });
  };
  EXPECT_THAT(complaint("name,study\nP1,a\nP1,b\n"), HasSubstr("m.csv:3: the person 'P1' stands in line 2 too"));
  EXPECT_THAT(complaint("name,study\n,a\n"), HasSubstr("m.csv:2: the name of a person: found nothing"));
  EXPECT_THAT(complaint("name,study\na\u202eb,a\n"), HasSubstr("U+202E at byte 2"));
  EXPECT_THAT(complaint("name,study\nP1,\n"), HasSubstr("has no study"));
  EXPECT_THAT(complaint("name,file\nP1,a\n"), HasSubstr("no column 'study'"));
}

TEST(Manifest, FoldersAndLabelsAreMadeFromNames) {
  const TemporaryFolder folder;
  write_file(folder / "m.csv", "name,study\nP1,a\nP-1,a\np1,a\n../x,a\n.stages,a\n\"a, b\",a\n李,a\n--,a\n");
  const Manifest manifest = read_manifest(folder / "m.csv");
  std::set<std::string> ids, labels;
  for (const Person& person : manifest.persons) {
    EXPECT_EQ(person_folder("", person).parent_path(), kPersonsFolder) << person.name;
    EXPECT_EQ(person.id.find_first_of("/\\ "), std::string::npos) << person.id;
    EXPECT_FALSE(person.id.starts_with('.') || person.id.starts_with('-')) << person.id;
    EXPECT_TRUE(std::ranges::all_of(person.label, [](unsigned char c) { return std::isalnum(c) != 0; }))
        << person.label;
    ids.insert(person.id);
    labels.insert(person.label);
  }
  EXPECT_EQ(ids.size(), 8U);
  EXPECT_EQ(labels.size(), 8U);
  // A workflow names persons by their ids, a user by their names.
  for (const Person& person : manifest.persons) {
    EXPECT_EQ(chosen_persons(manifest, {person.id}), std::vector<const Person*>{&person});
    EXPECT_EQ(chosen_persons(manifest, {person.name}), std::vector<const Person*>{&person});
  }
}

TEST(Manifest, ABidsDataSetHasItsFoldersAsPersonsAndItsTableAsColumns) {
  const TemporaryFolder folder;
  for (const char* name : {"sub-02", "sub-01", "sourcedata"}) fs::create_directories(folder / name);
  EXPECT_THAT(message_of([&] { (void)read_manifest(folder.path()); }), HasSubstr("code/study.toml"));
  write_file(folder / "code/study.toml", "x = 1\n");
  write_file(folder / "participants.tsv", "participant_id\tweight\nsub-02\t61.5\nsub-09\t80\n");
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
}  // namespace myoid::results
