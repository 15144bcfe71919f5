#include "myoid/study/study.h"

#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/study/read_study.h"
#include "myoid/study/study_text.h"

#include "tests/support/message_of.h"

namespace myoid::study {
namespace {

const std::string kMinimal = R"(
[[muscle]]
name = "BIC"
emg = "biceps"
[[muscle]]
name = "BRA"
emg = { same_as = "BIC" }
[[trial]]
name = "t1"
markers = "a/t1.trc"
emg = "t1.sto"
)";

std::string study_message(const std::string& text) {
  return test::message_of<ReadError>([&] { (void)parse_study(text, "dir/study.toml"); });
}

TEST(ParseStudy, AMuscleWithoutElectrodeTakesTheOtherOnesChannel) {
  EXPECT_EQ(parse_study(kMinimal, "s.toml").muscles.at(1).emg, "biceps");
}

TEST(ParseStudy, WithoutAnMvcTrialItKnowsThatTheNormalisationIsOverTheStudy) {
  EXPECT_FALSE(parse_study(kMinimal, "s.toml").emg.has_mvc);
}

TEST(ParseStudy, ATieToAMuscleThatIsNotThereIsRefused) {
  const std::string message = study_message(
      "[[muscle]]\nname = \"BRA\"\nemg = { same_as = \"BICC\" }\n[[trial]]\nname = \"t\"\nmotion = "
      "\"a.mot\"\nemg = \"e.sto\"\n");
  EXPECT_NE(message.find("BICC"), std::string::npos) << message;
}

TEST(ParseStudy, AMuscleWithoutEmgHasNoChannel) {
  const std::string trial = "[[trial]]\nname = \"t\"\nmotion = \"a.mot\"\nemg = \"e.sto\"\n";
  const std::string bic = "[[muscle]]\nname = \"BIC\"\nemg = \"biceps\"\n";
  const std::string bra = "[[muscle]]\nname = \"BRA\"\nwithout_emg = ";
  const Study study = parse_study(bic + bra + "\"synergies\"\n" + trial, "s.toml");
  EXPECT_EQ(study.muscles.at(1).without_emg, fit::WithoutEmg::synergies);
  EXPECT_EQ(study.muscles.at(1).emg, "");
  EXPECT_EQ(study.identify.methods, std::vector{fit::Method::torque});
  EXPECT_TRUE(study.identify.leaves_out_paper);
  const std::string paper = "[identify]\nmethod = [\"paper\"]\n";
  EXPECT_EQ(parse_study(paper + bic + bra + "\"unseen\"\n" + trial, "s.toml").identify.methods,
            std::vector{fit::Method::paper});
  Study again = parse_study(study_toml(study), "s.toml");
  again.identify.leaves_out_paper = true;  // the text states the method
  EXPECT_EQ(again, study);
  EXPECT_NE(study_message(bic + bra + "\"synergy\"\n" + trial).find("synergies"), std::string::npos);
  EXPECT_NE(study_message(bic + bra + "\"unseen\"\nemg = \"biceps\"\n" + trial), "");
  EXPECT_NE(study_message(bra + "\"unseen\"\n" + trial).find("without_emg"), std::string::npos);
}

TEST(ParseStudy, TwoTrialsOfOneNameAreRefused) {
  const std::string message =
      study_message(kMinimal + "[[trial]]\nname = \"t1\"\nmotion = \"b.mot\"\nemg = \"b.sto\"\n");
  EXPECT_NE(message.find("two [[trial]] are named 't1'"), std::string::npos) << message;
}

TEST(ParseStudy, ANormNamesTrialsOfTheStudy) {
  const std::string norm = "[[norm]]\nname = \"adults\"\nfile = \"n.csv\"\n";
  const Study study = parse_study(kMinimal + norm + "trials = [\"t1\"]\n", "dir/study.toml");
  ASSERT_EQ(study.norms.size(), 1U);
  EXPECT_EQ(study.norms[0].file, std::filesystem::path("dir/n.csv"));
  EXPECT_EQ(study.norms[0].trials, std::vector<std::string>{"t1"});
  EXPECT_TRUE(parse_study(kMinimal + norm + "trials = \"all\"\n", "s.toml").norms[0].trials.empty());
  EXPECT_NE(study_message(kMinimal + norm + "trials = [\"t2\"]\n").find("[[norm]] adults: 't2'"), std::string::npos);
}

TEST(ParseStudy, WithoutATrialToLearnFromItIsRefused) {
  EXPECT_NE(study_message(kMinimal + "use = \"validation\"\n").find("no [[trial]] has use"), std::string::npos);
}

TEST(ParseStudy, LagsOfTheActivationWithoutDynamicsAreRefusedWithTheRemedy) {
  const std::string lag = "\n[[parameter]]\nname = \"activation_time\"\nfree = true\n";
  EXPECT_NE(study_message(kMinimal + lag).find("activation_time: "), std::string::npos);
}

TEST(ParseStudy, AnEmgIsFollowedInOneWayOnly) {
  const std::string both = "\n[identify]\nlag = \"shared\"\ndynamics = true\n";
  EXPECT_NE(study_message(kMinimal + both).find("lag: "), std::string::npos) << study_message(kMinimal + both);
}

}  // namespace
}  // namespace myoid::study
