#include "myoid/study/study_settings.h"

#include <string>

#include <gtest/gtest.h>

#include "myoid/study/setting_reader.h"

#include "tests/support/message_of.h"

namespace myoid::study {
namespace {

Study settings_of(const std::string& text) {
  const toml::table root = parse_toml(text, "dir/study.toml");
  return read_spec<Study>({root, "dir/study.toml", "study"}, "dir");
}

std::string settings_message(const std::string& text) {
  return test::message_of([&] { (void)settings_of(text); });
}

TEST(StudySettings, AModelIsAFileOrBuiltIn) {
  EXPECT_NE(settings_message("[model]\nfile = \"a.osim\"\nbuiltin = \"arm4\"\n").find("not both"), std::string::npos);
  const Study study = settings_of("[model]\nfile = \"a.osim\"\n");
  EXPECT_EQ(study.model.builtin, "");
  EXPECT_EQ(study.model.file, "dir/a.osim");
}

TEST(StudySettings, AMisspeltKeyIsRefusedWithTheNearestKnownOne) {
  const std::string message = settings_message("[emg]\nlowpas_hz = 6\n");
  EXPECT_NE(message.find("'lowpass_hz'"), std::string::npos) << message;
}

TEST(StudySettings, ARateThatNoMachineCanHoldIsRefusedWithTheRange) {
  EXPECT_NE(settings_message("[motion]\nrate_hz = 1e9\n").find("expected 10 to 2000 Hz"), std::string::npos);
}

TEST(StudySettings, AnUnknownBuiltInModelIsRefusedWithThoseThereAre) {
  EXPECT_NE(settings_message("[model]\nbuiltin = \"arm26\"\n").find("arm4, none"), std::string::npos);
}

TEST(StudySettings, ALengthInCentimetersOrMillimetersIsRefusedByItsKey) {
  EXPECT_NE(settings_message("[model]\nforearm_length_m = 25\n").find("forearm_length_m"), std::string::npos);
  EXPECT_NE(settings_message("[model]\nforearm_length_m = 25\n").find("in cm?"), std::string::npos);
  EXPECT_NE(settings_message("[model]\nupper_arm_length_m = 300\n").find("in mm?"), std::string::npos);
  EXPECT_EQ(settings_of("[model]\nforearm_length_m = 0.25\n").model.forearm_length_m, 0.25);
  EXPECT_NE(settings_message("[model]\nheld_mass = { body = \"hand\", at_m = [0, -32, 0] }\n").find(" 32 m "),
            std::string::npos);
}

TEST(StudySettings, ADelayInMillisecondsIsRefused) {
  EXPECT_NE(settings_message("[emg]\ndelay_s = 60\n").find("expected 0 to 0.3 s"), std::string::npos);
  EXPECT_EQ(settings_of("[emg]\ndelay_s = 0.06\n").emg.delay_s, 0.06);
  EXPECT_EQ(settings_of("[emg]\ndelay_s = \"estimate\"\n").emg.delay_s, std::nullopt);
}

TEST(StudySettings, AngularErrorsAreGivenInDegrees) {
  const Study study = settings_of("[identify]\nangle_sd_deg = 180\nangle_rate_sd_degps = 90\n");
  EXPECT_EQ(study.identify.angle_sd_deg, 180.0);
  EXPECT_EQ(study.identify.angle_rate_sd_degps, 90.0);
}

TEST(StudySettings, AJointNamedTwiceIsRefused) {
  EXPECT_NE(settings_message("[model]\ncoordinate = [\"knee\", \"knee\"]\n").find("'knee'"), std::string::npos);
}

TEST(StudySettings, AMisspeltWordIsRefusedWithTheNearestKnownOne) {
  EXPECT_NE(settings_message("[identify]\nfolds = \"trail\"\n").find("'trial'"), std::string::npos);
  EXPECT_NE(settings_message("[phases]\nexclude = [\"regular\"]\n").find("found \"regular\""), std::string::npos);
}

TEST(StudySettings, ACutOffSaysHowToSmooth) {
  const Study study = settings_of("[motion]\ncutoff_hz = 8\n");
  EXPECT_EQ(study.motion.smoothing, Smoothing::cutoff);
  EXPECT_EQ(study.motion.cutoff_hz, 8.0);
  EXPECT_NE(settings_message("[motion]\nsmoothing = \"none\"\ncutoff_hz = 8\n").find("smoothing"), std::string::npos);
}

}  // namespace
}  // namespace myoid::study
