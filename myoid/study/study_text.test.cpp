#include "myoid/study/study_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/study/read_study.h"
#include "myoid/study/setting_rows.h"

namespace myoid::study {
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
  EXPECT_EQ(j["emg"]["highpass_hz"], EmgSpec{}.chain.highpass_hz);
  EXPECT_EQ(j["muscle"][0]["emg"], "biceps");
  EXPECT_EQ(j["trial"][0]["held_mass_kg"], 2.5);
  EXPECT_EQ(j["trial"][0]["markers"], "t.trc");
  EXPECT_EQ(j["sharing"]["exponent"], SharingSpec{}.exponent);
}

/// Every setting has another value than its default.
const char* const kEverything = R"(
[subject]
name = "S \"01\""
mass_kg = 61.5
sex = "female"
notes = ["right-handed", "Jürgen"]
[model]
file = "models/arm.osim"
upper_arm_length_m = 0.31
forearm_length_m = 0.25
plane = "horizontal"
forearm_rotations = true
coordinate = ["knee", "ankle"]
held_mass = { body = "hand", at_m = [0.0, -0.1, 0.25] }
[motion]
cutoff_hz = 7.5
rate_hz = 200
[markers]
up = "z"
rename = { R_elbow = "r_elbow", "with space" = "s" }
weight = { r_wrist = 5.0 }
undo_swaps = false
fill_gaps = false
[ik]
unlock = ["a"]
lock = ["b", "c"]
calibrate = { window_s = [1, 2], free = ["d", "e"], hold = ["e"] }
[emg]
kind = "envelope"
unit = "uV"
rectify = false
notch = "none"
whitening = false
highpass_hz = 30
lowpass_hz = 5
as_published = true
normalise_window_s = 1
mvc_effort = 0.9
mvc_effort_sd = 0.06
delay_s = 0.03
[sync]
emg_trigger = "T"
motion_trigger = "start"
trigger_file = "../pulses.csv"
match = "falling"
search_s = 1
loads_offset_s = 0.25
loads_drift_ppm = 12
[load_cell]
channels = ["1", "2", "3", "4", "5", "6"]
calibration = "matrix.txt"
sign = -1
zero_s = [0.5, 1.5]
instrument = "handle.osim"
frame = "cell"
body = "hand"
lowpass_hz = 12
[sharing]
objective = "stress"
exponent = 3
reserve_nm = 0.5
[phases]
search = false
exclude = ["rest", "isometric"]
[identify]
method = ["force", "torque"]
muscles = ["BIC"]
gain = false
cross_validate = false
folds = "block"
next_movements = 7
starts = 5
eccentric = "smooth"
normalised = true
lag = "shared"
muscle_law = "model"
tendon = "elastic"
delay_per_channel = true
angle_sd_deg = 0.1
angle_rate_sd_degps = 0.7
[beliefs]
moment_arm_sd = 0.02
moment_arm_slope_sd = 0.03
tendon_strain = 0
torque_scale_sd = 0.01
crosstalk_sd = 0
gain_drift_sd = 0.3
effort_sd = 0.04
model_error_sd = 0.05
strength_sd = 0.8
[[muscle]]
name = "BIC"
osim = ["BIClong", "BICshort"]
emg = "biceps"
start = { max_isometric_force = 900.0, eccentric_plateau = 1.5 }
fixed = ["eccentric_plateau"]
[[muscle]]
name = "BRA"
emg = { same_as = "BIC" }
[[parameter]]
name = "emg_shape"
of = ["biceps"]
free = true
value = 0.1
lower = -1.0
upper = 1.0
prior_mean = 0.2
prior_sd = 0.8
tie = true
[[trial]]
name = "t"
markers = "t.c3d"
emg = "e.sto"
use = "isometric"
held_mass_kg = 2.5
condition = "slow"
external_torque = "torque.sto"
external_loads = "loads.xml"
force_plates = { bodies = ["hand", ""], least_force_n = 20, lowpass_hz = 9 }
start_s = 1
end_s = 3.25
sync = { offset_s = "estimate", offset_sd_s = 0.01, drift_ppm = 50 }
[[trial]]
name = "u"
motion = "/far/u.mot"
emg = "u.sto"
load_cell = "u.c3d"
[[trial]]
name = "v"
motion = "v.mot"
emg = "v.sto"
lengths = "l.sto"
velocities = "v_l.sto"
moment_arms = ["knee.sto", "/far/ankle.sto"]
torques = "id.sto"
forces = "f.sto"
[[norm]]
name = "adults"
file = "norm.csv"
trials = ["t"]
[truth]
file = "truth.csv"
)";

TEST(StudyToml, ReadWrittenAndReadAgainIsTheSameStudy) {
  for (const std::filesystem::path file : {"dir/study.toml", "study.toml", "/top/study.toml"}) {
    const Study study = parse_study(kEverything, file);
    EXPECT_EQ(parse_study(study_toml(study), file), study) << study_toml(study);
    EXPECT_EQ(study.trials[0].markers, file.parent_path() / "t.c3d");
    EXPECT_EQ(study.trials[2].given.moment_arms[0], file.parent_path() / "knee.sto");
    EXPECT_EQ(study.trials[2].given.moment_arms[1], "/far/ankle.sto");
  }
}

TEST(StudyToml, AStudyOfDefaultsIsWrittenWhole) {
  const Study study = parse_study(
      "[[muscle]]\nname = \"B\"\nemg = \"b\"\n[[trial]]\nname = \"t\"\nmarkers = \"t.trc\"\n"
      "emg = \"t.sto\"\n[identify]\ndynamics = true\n",
      "dir/study.toml");
  EXPECT_EQ(parse_study(study_toml(study), "dir/study.toml"), study) << study_toml(study);
  EXPECT_NE(study_toml(study).find("delay_s = \"estimate\""), std::string::npos);
}

TEST(StudyJson, EverySettingOfTheReferenceStandsInIt) {
  const nlohmann::json j = nlohmann::json::parse(study_json(parse_study(kEverything, "study.toml")));
  for (const SettingTable& table : setting_tables()) {
    const std::string name =
        table.name.substr(table.name.rfind('[') + 1, table.name.find(']') - table.name.rfind('[') - 1);
    const nlohmann::json& written = j.at(name).is_array() ? j.at(name)[0] : j.at(name);
    for (const SettingRow& row : table.rows)
      EXPECT_TRUE(written.contains(row.key.substr(0, row.key.find('.')))) << name << row.key;
  }
}

}  // namespace
}  // namespace myoid::study
