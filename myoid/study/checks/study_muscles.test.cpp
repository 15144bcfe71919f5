#include "myoid/study/checks/study_muscles.h"

#include <gtest/gtest.h>

#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"
#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

/// A study of these muscles of a model, with one [[muscle]] for each.
Study study_of(const std::string& coordinate, const std::vector<std::string>& muscles) {
  Study study;
  study.model.file = "model.osim";
  study.model.coordinate = coordinate;
  for (const std::string& name : muscles) study.muscles.push_back({.name = name, .osim = {name}, .emg = name});
  return study;
}

TEST(IdleMuscles, OfAMuscleThatCrossesTheJointNothingIsSaid) {
  EXPECT_TRUE(idle_muscles(test_trials::arm_study(), test_trials::arm()).empty());
}

TEST(IdleMuscles, OneThatMovesNoneOfTheCoordinatesIsAnErrorWithTheRemedy) {
  Study study = study_of("shoulder_flexion", {"BRA"});
  const std::vector<Remark> found = idle_muscles(study, test_trials::arm());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_EQ(found[0].about, "BRA");
  for (const char* part : {"BRA", "shoulder_flexion", "no moment arm", "osim"})
    EXPECT_NE(sentence(found[0]).find(part), std::string::npos) << sentence(found[0]);
  // One of several coordinates is enough.
  study.model.more_coordinates = {"elbow_flexion"};
  EXPECT_TRUE(idle_muscles(study, test_trials::arm()).empty());
}

TEST(IdleMuscles, TheOtherLegsAreAndThoseOfThePatellaAreNot) {
  const auto path = test::data_folder() / "opensim" / "rajagopal2016" / "model.osim";
  MYOID_REQUIRE_DATA(path);
  const body::BodyModel leg = body::read_osim(path);
  EXPECT_TRUE(idle_muscles(study_of("knee_angle_r", {"recfem_r", "vasint_r", "vaslat_r", "vasmed_r", "bfsh_r",
                                                     "gasmed_r", "sart_r", "tfl_r"}),
                           leg)
                  .empty());
  const std::vector<Remark> found = idle_muscles(study_of("ankle_angle_r", {"soleus_r", "soleus_l", "tibant_r"}), leg);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].about, "soleus_l");
  // Beside a muscle that has an arm, it makes the mean arm too small.
  Study both = study_of("hip_flexion_r", {});
  both.muscles = {{.name = "BF", .osim = {"bflh_r", "bfsh_r"}, .emg = "BF"}};
  const std::vector<Remark> some = idle_muscles(both, leg);
  ASSERT_EQ(some.size(), 1U);
  EXPECT_EQ(some[0].severity, Severity::warning);
  EXPECT_EQ(some[0].code, RemarkCode::idle_muscle);
  EXPECT_NE(some[0].says.find("bfsh_r"), std::string::npos) << some[0].says;
  EXPECT_EQ(some[0].says.find("bflh_r"), std::string::npos) << some[0].says;
}

Study two(const std::string& osim, const std::string& emg) {
  Study study;
  study.muscles = {{.name = "BIC", .osim = {"BIClong", "BICshort"}, .emg = "Biceps"},
                   {.name = "TRI", .osim = {osim}, .emg = emg}};
  return study;
}

TEST(SharedMuscles, OfMusclesOfTheirOwnNothingIsSaid) {
  EXPECT_TRUE(shared_muscles(two("TRIlong", "Triceps")).empty());
}

TEST(SharedMuscles, AMuscleOfTheModelInTwoTablesIsAnError) {
  const auto found = shared_muscles(two("BICshort", "Triceps"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_NE(found[0].says.find("'BICshort'"), std::string::npos) << found[0].says;
}

TEST(SharedMuscles, AChannelOfTwoMusclesIsAWarningUnlessItIsMeant) {
  Study study = two("TRIlong", "Biceps");
  const auto found = shared_muscles(study);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_NE(found[0].says.find("same_as = \"BIC\""), std::string::npos) << found[0].says;
  study.muscles[1].same_as = "BIC";
  EXPECT_TRUE(shared_muscles(study).empty());
}

}  // namespace
}  // namespace myoid::study
