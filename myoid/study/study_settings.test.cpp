#include "myoid/study/study_settings.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/message_of.h"

namespace myoid {
namespace {

Study settings_of(const std::string& text) {
  const toml::table root = recording::parse_toml(text, "dir/study.toml");
  recording::TomlTable table(root, "dir/study.toml", "study");
  Study study;
  read_settings(table, "dir", study);
  table.finish();
  return study;
}

std::string settings_message(const std::string& text) {
  return test::message_of([&] { (void)settings_of(text); });
}

TEST(StudySettings, WithoutAModelTheBuiltInArmIsUsed) {
  EXPECT_EQ(settings_of("").model.builtin, "arm4");
  const Study study = settings_of("[model]\nfile = \"a.osim\"\n");
  EXPECT_EQ(study.model.builtin, "");
  EXPECT_EQ(study.model.file, "dir/a.osim");
}

TEST(StudySettings, AMisspeltKeyIsRefusedWithTheNearestKnownOne) {
  const std::string message = settings_message("[emg]\nlowpas_hz = 6\n");
  EXPECT_NE(message.find("did you mean 'lowpass_hz'"), std::string::npos) << message;
}

TEST(StudySettings, ARateThatNoMachineCanHoldIsRefusedWithTheRange) {
  EXPECT_NE(settings_message("[motion]\nrate_hz = 1e9\n").find("expected 10 to 2000 Hz"),
            std::string::npos);
}

TEST(StudySettings, AnUnknownBuiltInModelIsRefusedWithTheOneThereIs) {
  EXPECT_NE(settings_message("[model]\nbuiltin = \"arm26\"\n").find("expected arm4"),
            std::string::npos);
}

TEST(StudySettings, ALengthInCentimetersOrMillimetersIsRefusedByItsKey) {
  EXPECT_NE(settings_message("[model]\nforearm_length_m = 25\n").find("forearm_length_m"),
            std::string::npos);
  EXPECT_NE(settings_message("[model]\nforearm_length_m = 25\n").find("is it in cm?"),
            std::string::npos);
  EXPECT_NE(settings_message("[model]\nupper_arm_length_m = 300\n").find("is it in mm?"),
            std::string::npos);
  EXPECT_EQ(settings_of("[model]\nforearm_length_m = 0.25\n").model.forearm_length_m, 0.25);
  EXPECT_NE(settings_message("[model]\nheld_mass = { body = \"hand\", at_m = [0, -32, 0] }\n")
                .find("32 m from the body's origin"),
            std::string::npos);
}

TEST(StudySettings, ADelayInMillisecondsIsRefused) {
  EXPECT_NE(settings_message("[emg]\ndelay_s = 60\n").find("expected 0 to 0.3 s"),
            std::string::npos);
  EXPECT_EQ(settings_of("[emg]\ndelay_s = 0.06\n").emg.delay_s, 0.06);
  EXPECT_EQ(settings_of("[emg]\ndelay_s = \"estimate\"\n").emg.delay_s, std::nullopt);
}

TEST(StudySettings, AngularErrorsAreGivenInDegrees) {
  const Study study = settings_of("[identify]\nangle_sd_deg = 180\nangle_rate_sd_degps = 90\n");
  EXPECT_DOUBLE_EQ(study.identify.angle_sd_rad, 3.14159265358979323846);
  EXPECT_DOUBLE_EQ(study.identify.angle_rate_sd_radps, 1.57079632679489661923);
}

TEST(StudySettings, AJointNamedTwiceIsRefused) {
  EXPECT_NE(settings_message("[model]\ncoordinate = [\"knee\", \"knee\"]\n")
                .find("'knee' is named twice"),
            std::string::npos);
}

}  // namespace
}  // namespace myoid
