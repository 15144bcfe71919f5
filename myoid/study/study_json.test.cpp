#include "myoid/study/study_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace myoid {
namespace {

TEST(StudyJson, HoldsWhatTheFileSaysAndTheDefaultsOfWhatItDoesNot) {
  const Study study = parse_study(R"(
[subject]
name = "S01"
mass_kg = 61.5
[model]
builtin = "arm4"
forearm_length_m = 0.25
[markers]
up = "z"
[ik]
lock = ["shoulder_flexion"]
[emg]
unit = "uV"
delay_s = 0.03
[[muscle]]
name = "BIC"
osim = ["BIC"]
emg = "biceps"
[[trial]]
name = "t"
markers = "t.trc"
emg = "t.sto"
held_mass_kg = 2.5
)",
                                  "study.toml");
  const nlohmann::json j = nlohmann::json::parse(study_json(study));
  EXPECT_EQ(j["subject"]["mass_kg"], 61.5);
  EXPECT_EQ(j["model"]["forearm_length_m"], 0.25);
  EXPECT_TRUE(j["model"]["upper_arm_length_m"].is_null());
  EXPECT_EQ(j["markers"]["up"], "z");
  EXPECT_EQ(j["ik"]["lock"], nlohmann::json({"shoulder_flexion"}));
  EXPECT_EQ(j["emg"]["delay_s"], 0.03);
  EXPECT_EQ(j["emg"]["unit"], "uV");
  EXPECT_EQ(j["emg"]["highpass_hz"], EmgSpec{}.highpass_hz);
  EXPECT_EQ(j["muscle"][0]["emg"], "biceps");
  EXPECT_EQ(j["trial"][0]["held_mass_kg"], 2.5);
  EXPECT_EQ(j["trial"][0]["markers"], "t.trc");
  EXPECT_EQ(j["sharing"]["exponent"], SharingSpec{}.exponent);
}

}  // namespace
}  // namespace myoid
