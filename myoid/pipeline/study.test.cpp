#include "myoid/pipeline/study.h"

#include <string>

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::pipeline {
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

std::string message_of(const std::string& text) {
  try {
    (void)parse_study(text, "dir/study.toml");
  } catch (const ReadError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(ParseStudy, PathsAreRelativeToTheFilesOwnFolder) {
  const Study study = parse_study(kMinimal, "dir/study.toml");
  EXPECT_EQ(study.trials.at(0).markers, "dir/a/t1.trc");
}

TEST(ParseStudy, AMuscleWithoutElectrodeTakesTheOtherOnesChannel) {
  EXPECT_EQ(parse_study(kMinimal, "s.toml").muscles.at(1).emg, "biceps");
}

TEST(ParseStudy, WithoutAModelTheBuiltInArmIsUsed) {
  EXPECT_EQ(parse_study(kMinimal, "s.toml").model.builtin, "arm4");
}

TEST(ParseStudy, WithoutAnMvcTrialItKnowsThatTheNormalisationIsOverTheStudy) {
  EXPECT_FALSE(parse_study(kMinimal, "s.toml").emg.has_mvc);
}

TEST(ParseStudy, ATrialWithoutEmgIsRefusedWithTheRemedy) {
  const std::string message = message_of(
      "[[muscle]]\nname = \"B\"\nemg = \"b\"\n[[trial]]\nname = \"t1\"\nmarkers = \"a.trc\"\n");
  EXPECT_NE(message.find("dir/study.toml:"), std::string::npos) << message;
  EXPECT_NE(message.find("'t1' has no 'emg'"), std::string::npos) << message;
}

TEST(ParseStudy, AMisspeltKeyIsRefusedWithTheNearestKnownOne) {
  const std::string message = message_of(kMinimal + "[emg]\nlowpas_hz = 6\n");
  EXPECT_NE(message.find("did you mean 'lowpass_hz'"), std::string::npos) << message;
}

TEST(ParseStudy, ATieToAMuscleThatIsNotThereIsRefused) {
  const std::string message = message_of(
      "[[muscle]]\nname = \"BRA\"\nemg = { same_as = \"BICC\" }\n[[trial]]\nname = \"t\"\nmotion = "
      "\"a.mot\"\nemg = \"e.sto\"\n");
  EXPECT_NE(message.find("BICC"), std::string::npos) << message;
}

TEST(ParseStudy, TwoTrialsOfOneNameAreRefused) {
  const std::string message =
      message_of(kMinimal + "[[trial]]\nname = \"t1\"\nmotion = \"b.mot\"\nemg = \"b.sto\"\n");
  EXPECT_NE(message.find("two [[trial]] are named 't1'"), std::string::npos) << message;
}

TEST(ParseStudy, AStartThatNoMuscleHasIsRefusedWithTheRange) {
  const std::string text =
      "[[muscle]]\nname = \"B\"\nemg = \"b\"\nstart = { optimal_fiber_length = 173 }\n[[trial]]\n"
      "name = \"t\"\nmotion = \"a.mot\"\nemg = \"e.sto\"\n";
  EXPECT_NE(message_of(text).find("study.toml:4"), std::string::npos) << message_of(text);
  EXPECT_NE(message_of(text).find("found 173 m, expected 0.01 to 0.6 m"), std::string::npos)
      << message_of(text);
}

TEST(ParseStudy, AnUnknownParameterIsRefusedAtItsLine) {
  const std::string text =
      "[[muscle]]\nname = \"B\"\nemg = \"b\"\nfixed = [\"eccentric_plato\"]\n[[trial]]\n"
      "name = \"t\"\nmotion = \"a.mot\"\nemg = \"e.sto\"\n";
  EXPECT_NE(message_of(text).find("study.toml:4"), std::string::npos) << message_of(text);
  EXPECT_NE(message_of(text).find("did you mean 'eccentric_plateau'"), std::string::npos)
      << message_of(text);
}

TEST(ParseStudy, ARateThatNoMachineCanHoldIsRefusedWithTheRange) {
  EXPECT_NE(message_of(kMinimal + "[motion]\nrate_hz = 1e9\n").find("expected 10 to 2000 Hz"),
            std::string::npos);
}

TEST(ParseStudy, AnEndBeforeTheStartIsRefused) {
  EXPECT_NE(message_of(kMinimal + "start_s = 10\nend_s = 5\n").find("after start_s = 10 s"),
            std::string::npos);
}

TEST(ParseStudy, WithoutATrialToLearnFromItIsRefused) {
  EXPECT_NE(message_of(kMinimal + "use = \"validation\"\n").find("no [[trial]] has use"),
            std::string::npos);
}

TEST(ParseStudy, AnUnknownBuiltInModelIsRefusedWithTheOneThereIs) {
  EXPECT_NE(message_of(kMinimal + "[model]\nbuiltin = \"arm26\"\n").find("expected arm4"),
            std::string::npos);
}

TEST(ParseStudy, ADelayInMillisecondsIsRefused) {
  EXPECT_NE(message_of(kMinimal + "[emg]\ndelay_s = 60\n").find("expected 0 to 0.3 s"),
            std::string::npos);
}

}  // namespace
}  // namespace myoid::pipeline
