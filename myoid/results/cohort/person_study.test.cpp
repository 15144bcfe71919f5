#include "myoid/results/cohort/person_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/toml_table.h"
#include "myoid/study/read_study.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using test::message_of;
using testing::HasSubstr;

const Person kPerson{
    .name = "sub-07", .id = "sub-07", .label = "07", .study = {}, .facts = {{"weight", "61.5"}, {"sex", ""}}};

TEST(PersonStudy, WordsInBracesBecomeThePersonsAndTomlsOwnBracesStay) {
  EXPECT_EQ(filled_study("mass = {weight} # {name}, {label}\nemg = { same_as = \"BIC\" }\n", "t", kPerson),
            "mass = 61.5 # sub-07, 07\nemg = { same_as = \"BIC\" }\n");
}

TEST(PersonStudy, ANameStaysItselfInEveryKindOfString) {
  Person person = kPerson;
  for (const char* name : {"O'Neil \"the\" \\ {label} # 1", "a''' \"\"\" b", "李\u00e4", "{name}", "\\u0041"}) {
    person.name = name;
    const std::string text = filled_study(
        "a = \"x {name} \\\" y\" # it's {weight}\nb = 'x {name} y'\nc = \"\"\"{name}\"\"\"\nd = '''{name}'''\n", "t",
        person);
    const toml::table root = parse_toml(text, "t.toml");
    TomlTable table(root, "t.toml", "t");
    EXPECT_EQ(table.text("a"), "x " + person.name + " \" y") << text;
    EXPECT_EQ(table.text("b"), "x " + person.name + " y") << text;
    EXPECT_EQ(table.text("c"), person.name) << text;
    EXPECT_EQ(table.text("d"), person.name) << text;
  }
}

TEST(PersonStudy, SaysWhichColumnIsMissingAndInWhichLine) {
  EXPECT_THAT(message_of([] { (void)filled_study("a = 1\nb = \"{labell}\"\n", "t.toml", kPerson); }),
              HasSubstr("t.toml:2: found {labell}, expected a column of the manifest: name, label"));
  EXPECT_THAT(message_of([] { (void)filled_study("sex = \"{sex}\"\n", "t.toml", kPerson); }),
              HasSubstr("'sub-07' has no value in the column 'sex'"));
}

TEST(PersonStudy, AFilledTemplateIsAStudyWhosePathsAreThoseOfTheTemplate) {
  const test::TemporaryFolder folder;
  const auto text = [](const std::string& place) {
    return "[subject]\nmass_kg = " + std::string(place.empty() ? "{weight}" : "61.5") +
           "\n[[muscle]]\nname = \"BIC\"\nosim = [\"BIC\"]\nemg = \"BIC\"\n[[trial]]\nname = "
           "\"a\"\n"
           "markers = \"../sub-" +
           (place.empty() ? "{label}" : place) + "/a.trc\"\nemg = \"../a.sto\"\n";
  };
  write_file(folder / "code/study.toml", text(""));
  write_file(folder / "code/by_hand.toml", text("07"));
  Person person = kPerson;
  person.study = folder / "code/study.toml";
  const study::Study filled = study::read_study(person_study(person, folder / "out"));
  const study::Study by_hand = study::read_study(folder / "code/by_hand.toml");
  EXPECT_EQ(filled.file, folder / "out/study.toml");
  EXPECT_EQ(filled.subject.mass_kg, 61.5);
  ASSERT_TRUE(filled.trials[0].markers && by_hand.trials[0].markers);
  EXPECT_EQ(filled.trials[0].markers->lexically_normal(), by_hand.trials[0].markers->lexically_normal());

  person.study = folder / "code/by_hand.toml";
  EXPECT_EQ(person_study(person, folder / "other"), person.study) << "no template: the file itself";
}

TEST(PersonStudy, AFilterChoosesTrialsByTheNamesOfTheirRecordings) {
  const test::TemporaryFolder folder;
  study::TrialSpec trial;
  trial.markers = "motion/sub-07_ses-02_task-lift_tracksys-omc_motion.tsv";
  trial.emg = "emg/sub-07_ses-02_task-lift_emg.edf";
  EXPECT_TRUE(passes(trial, {}));
  EXPECT_TRUE(passes(trial, {{"task", {"walk", "lift"}}, {"ses", {"02"}}}));
  EXPECT_FALSE(passes(trial, {{"task", {"lif"}}}));
  EXPECT_FALSE(passes(trial, {{"task", {"lift"}}, {"ses", {"01"}}}));
  EXPECT_TRUE(passes(trial, {{"run", {"1"}}})) << "a name without the entity";
  write_file(folder / "f.json", R"({"motion": {"session": "02", "task": ["lift", "walk"]}, "emg": {"run": "1"}})");
  BidsFilter filter;
  add_bids_filter(folder / "f.json", filter);
  EXPECT_EQ(filter, (BidsFilter{{"ses", {"02"}}, {"task", {"lift", "walk"}}, {"run", {"1"}}}));
  for (const char* damaged : {"{", "[1]", R"({"motion": 1})", R"({"motion": {"task": [1]}})"}) {
    write_file(folder / "f.json", damaged);
    EXPECT_THROW(add_bids_filter(folder / "f.json", filter), InvalidInput) << damaged;
  }
}

}  // namespace
}  // namespace myoid::results
