#include "myoid/study/run_identity.h"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/results/parameter_files.h"
#include "myoid/study/study_text.h"

#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

Study study_of(const std::vector<std::string>& muscles) {
  Study study;
  study.subject.name = "anna";
  study.subject.mass_kg = 60.0;
  study.model.builtin = "arm4";
  for (const std::string& name : muscles) {
    MuscleSpec muscle;
    muscle.name = name;
    muscle.osim = {name};
    muscle.emg = name;
    study.muscles.push_back(muscle);
  }
  return study;
}

/// The folder that a run of this study leaves, as far as its identity goes.
std::filesystem::path folder_of(const Study& study, const std::filesystem::path& folder) {
  Provenance provenance;
  provenance.options_json = study_json(study);
  if (study.model.file) provenance.inputs.push_back({study.model.file->string(), "one"});
  std::filesystem::create_directories(folder);
  write_file(folder / "parameters.json", results::parameters_json({}, {}, provenance));
  return folder;
}

TEST(RunIdentity, OfAStudyIsThatOfItsRun) {
  const test::TemporaryFolder folder;
  const Study study = study_of({"BIC", "TRI"});
  const RunIdentity of_run = read_run_identity(folder_of(study, folder.path() / "a"));
  EXPECT_TRUE(of_run.known);
  EXPECT_EQ(of_run.subject, "anna");
  EXPECT_EQ(of_run.model, "arm4");
  const IdentityDifferences same = differences(identity_of(study), of_run);
  EXPECT_TRUE(same.grave.empty());
  EXPECT_TRUE(same.other.empty());
}

TEST(RunIdentity, OneRecordingIsKnownByMostOfItsFiles) {
  RunIdentity first, second;
  first.recordings = {{"a.trc", "1"}, {"b.trc", "2"}, {"mvc.sto", "3"}};
  second.recordings = {{"renamed.trc", "1"}, {"other.trc", "4"}, {"later.trc", "5"}};
  EXPECT_EQ(common_recordings(first, second), std::vector<std::string>{"a.trc"});
  EXPECT_FALSE(of_one_recording(first, second));
  second.recordings[1].sha256 = "2";
  EXPECT_TRUE(of_one_recording(first, second));
  EXPECT_FALSE(of_one_recording({}, second));
}

TEST(RunIdentity, SettingsThatDifferHaveTheirNames) {
  const Study study = study_of({"BIC", "TRI"});
  Study other = study;
  other.muscles[1].without_emg = fit::WithoutEmg::unseen;
  other.identify.cross_validate = false;
  const std::vector<std::string> names = differing_settings(identity_of(study), identity_of(other));
  EXPECT_EQ(std::ranges::count(names, "identify cross_validate"), 1);
  EXPECT_EQ(std::ranges::count(names, "muscle TRI without_emg"), 1);
  EXPECT_TRUE(differing_settings(identity_of(study), identity_of(study)).empty());
}

TEST(RunIdentity, AnotherModelOrNoCommonMuscleIsGrave) {
  const test::TemporaryFolder folder;
  const RunIdentity here = identity_of(study_of({"BIC", "TRI"}));
  Study wu = study_of({"BIC", "TRI"});
  wu.model.file = "somewhere/wu.osim";
  const IdentityDifferences model = differences(here, read_run_identity(folder_of(wu, folder.path() / "wu")));
  ASSERT_EQ(model.grave.size(), 1U);
  EXPECT_NE(model.grave[0].find("wu.osim"), std::string::npos);
  const IdentityDifferences muscles = differences(here, identity_of(study_of({"SOL", "GAS"})));
  ASSERT_EQ(muscles.grave.size(), 1U);
  EXPECT_NE(muscles.grave[0].find("SOL, GAS"), std::string::npos);
  // One name, other content: the run has the sum "one", the file another.
  write_file(folder.path() / "wu.osim", "changed");
  Study changed = study_of({"BIC", "TRI"});
  changed.model.file = folder.path() / "wu.osim";
  EXPECT_EQ(differences(identity_of(changed), read_run_identity(folder.path() / "wu")).grave.size(), 1U);
}

TEST(RunIdentity, SeveralPersonsMayDifferInAllButJointsMusclesAndRecordings) {
  RunIdentity anna = identity_of(study_of({"BIC", "TRI"}));
  anna.recordings = {{"slow.trc", "11"}, {"fast.trc", "22"}};
  RunIdentity bernd = anna;
  bernd.subject = "bernd";
  bernd.mass_kg = 90.0;
  bernd.model = "bernd.osim";
  bernd.recordings = {{"slow.trc", "33"}};
  const IdentityDifferences alike = differences(anna, bernd, Whose::several_persons);
  EXPECT_TRUE(alike.grave.empty());
  EXPECT_TRUE(alike.other.empty());
  bernd.coordinates = {"knee_angle_r"};
  EXPECT_EQ(differences(anna, bernd, Whose::several_persons).grave.size(), 1U);
  const IdentityDifferences twice = differences(anna, anna, Whose::several_persons);
  ASSERT_EQ(twice.grave.size(), 1U);
  EXPECT_NE(twice.grave[0].find("slow.trc and 1 "), std::string::npos) << twice.grave[0];
  // Two sessions of one person may share a recording, such as a maximal contraction.
  EXPECT_TRUE(differences(anna, anna).grave.empty());
}

TEST(RunIdentity, AnotherPersonAndFurtherMusclesAreRemarked) {
  Study other = study_of({"BIC", "TRI", "BRA"});
  other.subject.name = "bernd";
  other.subject.mass_kg = 90.0;
  const IdentityDifferences found = differences(identity_of(study_of({"BIC", "TRI"})), identity_of(other));
  EXPECT_TRUE(found.grave.empty());
  EXPECT_EQ(found.other.size(), 3U);
}

TEST(RunIdentity, AStudyWithoutABodyIsNotHeldAgainstOneWithABody) {
  const test::TemporaryFolder folder;
  Study bodiless = study_of({"BIC"});
  bodiless.model.builtin = "none";
  bodiless.model.coordinate = "joint";
  const RunIdentity there = read_run_identity(folder_of(bodiless, folder.path()));
  EXPECT_FALSE(there.known);
  EXPECT_TRUE(differences(identity_of(study_of({"BIC"})), there).grave.empty());
  EXPECT_FALSE(differences(identity_of(study_of({"SOL"})), there).grave.empty());
  write_file(folder / "parameters.json", "{\"provenance\": [");
  EXPECT_THROW((void)read_run_identity(folder.path()), ReadError);
}

}  // namespace
}  // namespace myoid::study
