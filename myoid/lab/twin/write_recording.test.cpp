#include "myoid/lab/twin/write_recording.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/toml_table.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/trc_reader.h"
#include "myoid/study/read_study.h"
#include "myoid/study/run_identity.h"

#include "tests/support/temporary_folder.h"

namespace myoid::lab {
namespace {

namespace fs = std::filesystem;

class WriteRecording : public ::testing::Test {
 protected:
  static VirtualRecording recording(std::uint64_t seed, Level level) {
    Protocol protocol = parse_protocol(R"(
name = "a \"quoted\" name"
[subject]
name = "S\\1"
[[trial]]
name = "mvc"
kind = "mvc"
hold_s = 1
[[trial]]
name = "loaded"
kind = "flexion"
held_mass_kg = 2
duration_s = 3.5
frequency_hz = 1
[[trial]]
name = "ramp"
kind = "isometric_ramp"
)",
                                       "p.toml");
    protocol.level = level;
    protocol.truth = default_protocol(level).truth;
    return make_virtual_recording(protocol, seed);
  }

  static std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  test::TemporaryFolder folder_;
  fs::path directory_ = folder_ / "recording";
};

TEST_F(WriteRecording, FilesReadBackToTheBit) {
  const VirtualRecording made = recording(1, Level::noise_free);
  write_virtual_recording(made, directory_);
  for (const VirtualTrial& trial : made.trials) {
    const std::string& name = trial.protocol.name;
    const recording::MarkerFile trc = recording::read_trc(directory_ / (name + ".trc"));
    EXPECT_TRUE(trc.repairs.empty());
    EXPECT_EQ(trc.markers.names, trial.markers.names);
    EXPECT_EQ(trc.markers.time_s, trial.markers.time_s);
    // Through millimeters and back: two roundings of a number up to 2 m.
    EXPECT_LE((trc.markers.positions_m - trial.markers.positions_m).cwiseAbs().maxCoeff(), 5e-16);
    EXPECT_EQ(recording::read_emg(directory_ / (name + "_emg.sto"), "", true).data.values(), trial.emg.values());
    if (trial.external_torque) {
      const recording::Storage torque = recording::read_storage(directory_ / (name + "_torque.sto"));
      EXPECT_EQ(torque.data.column("elbow_flexion_moment"), trial.external_torque->column("elbow_flexion_moment"));
      EXPECT_FALSE(torque.in_degrees);
    }
    EXPECT_TRUE(fs::exists(directory_ / "truth" / (name + "_activation.sto")));
  }
  EXPECT_EQ(body::read_osim(directory_ / "model.osim").muscles.size(), 4U);
}

TEST_F(WriteRecording, SameSeedSameBytes) {
  write_virtual_recording(recording(3, Level::noisy), directory_ / "a");
  write_virtual_recording(recording(3, Level::noisy), directory_ / "b");
  write_virtual_recording(recording(4, Level::noisy), directory_ / "c");
  write_virtual_recording(recording(3, Level::different), directory_ / "a/person", {.format = RecordingFormat::c3d});
  write_virtual_recording(recording(3, Level::different), directory_ / "b/person", {.format = RecordingFormat::c3d});
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(directory_ / "a")) {
    if (!entry.is_regular_file()) continue;
    const fs::path relative = fs::relative(entry.path(), directory_ / "a");
    EXPECT_EQ(content(entry.path()), content(directory_ / "b" / relative)) << relative;
    ++files;
  }
  // Four for the person, seven a trial, and a torque for each of two with a dynamometer; at L2 one
  // C3D instead of two files, and the heads.
  EXPECT_EQ(files, 2 * (4 + 3 * 7 + 2));
  EXPECT_NE(content(directory_ / "a" / "truth.csv"), content(directory_ / "c" / "truth.csv"));
  EXPECT_NE(content(directory_ / "a" / "loaded.trc"), content(directory_ / "c" / "loaded.trc"));
}

TEST_F(WriteRecording, AC3dFileHoldsMarkersAndEmg) {
  const VirtualRecording made = recording(1, Level::noisy);
  write_virtual_recording(made, directory_, {.format = RecordingFormat::c3d});
  for (const VirtualTrial& trial : made.trials) {
    const fs::path file = directory_ / (trial.protocol.name + ".c3d");
    const MarkerSeries markers = recording::read_markers(file).markers;
    const TimeSeries emg = recording::read_emg(file, "V", true).data;
    EXPECT_EQ(markers.names, trial.markers.names);
    // The last frame has but one sample of the EMG and is left out. Reals of 32 bits.
    const Eigen::Index frames = markers.frame_count();
    ASSERT_EQ(frames, trial.markers.frame_count() - 1);
    EXPECT_LE((markers.positions_m - trial.markers.positions_m.topRows(frames)).cwiseAbs().maxCoeff(), 2e-7);
    ASSERT_EQ(emg.sample_count(), 10 * frames);
    for (const Channel& channel : trial.emg.channels())
      EXPECT_LE(
          (emg.column(channel.name) - trial.emg.column(channel.name).head(emg.sample_count())).cwiseAbs().maxCoeff(),
          1e-9);
  }
  const std::string study = content(directory_ / "study.toml");
  EXPECT_NE(study.find("emg = \"loaded.c3d\""), std::string::npos);
  EXPECT_FALSE(fs::exists(directory_ / "loaded.trc"));
}

TEST_F(WriteRecording, TheStudyNamesWhatIsThere) {
  write_virtual_recording(recording(1, Level::noisy), directory_);
  const toml::table study = parse_toml(content(directory_ / "study.toml"), "study.toml");
  EXPECT_EQ(study["subject"]["name"].value<std::string>(), "S\\1-1");
  EXPECT_EQ(study["emg"]["kind"].value<std::string>(), "raw");
  EXPECT_EQ(study["model"]["held_mass"]["body"].value<std::string>(), "forearm_hand");
  EXPECT_LT(study["model"]["held_mass"]["at_m"][1].value<double>(), -0.3);
  EXPECT_EQ(study["muscle"][1]["emg"]["same_as"].value<std::string>(), "BIC");
  const toml::array& trials = *study["trial"].as_array();
  ASSERT_EQ(trials.size(), 3U);
  for (const toml::node& node : trials) {
    const toml::table& trial = *node.as_table();
    for (const char* key : {"markers", "emg", "external_torque"}) {
      if (const auto file = trial[key].value<std::string>()) {
        EXPECT_TRUE(fs::exists(directory_ / *file)) << *file;
      }
    }
  }
  EXPECT_EQ(trials[1].as_table()->get("held_mass_kg")->value<double>(), 2.0);
  EXPECT_TRUE(trials[2].as_table()->contains("external_torque"));
}

TEST_F(WriteRecording, AnotherSeedIsAnotherPersonForTheCommandsThatCompare) {
  const auto person = [&](std::uint64_t seed, Level level) {
    const fs::path place = directory_ / fmt::format("{}.{}", seed, static_cast<int>(level));
    write_virtual_recording(recording(seed, level), place);
    return study::identity_of(study::read_study(place / "study.toml"));
  };
  const study::RunIdentity first = person(1, Level::noisy);
  EXPECT_EQ(study::differences(first, person(2, Level::noisy)).other.size(), 1U);
  EXPECT_TRUE(study::differences(first, person(1, Level::noise_free)).other.empty());
}

TEST_F(WriteRecording, TruthHasARowForEveryParameter) {
  const VirtualRecording made = recording(1, Level::noisy);
  std::istringstream rows(truth_csv(made));
  std::map<std::string, double> values;
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "muscle,parameter,unit,value");
  while (std::getline(rows, row)) {
    const std::size_t last = row.rfind(',');
    const std::size_t second = row.find(',', row.find(',') + 1);
    values[row.substr(0, second)] = std::stod(row.substr(last + 1));
  }
  const auto voluntary = static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](const auto& value) {
    return value.first.find(",voluntary_") != std::string::npos;
  }));
  // Torque, angle and three powers of four muscles and of both directions of the elbow.
  EXPECT_EQ(voluntary, 5U * (4U + 2U));
  EXPECT_EQ(values.size() - voluntary, 4U * 8U + 1U + 4U * 3U + 3U);
  EXPECT_EQ(values.at("BRA,max_isometric_force"), made.truth.muscles[1].max_isometric_force_n);
  EXPECT_EQ(values.at("TRI,eccentric_curvature_product"), made.truth.muscles[3].eccentric_curvature_product);
  EXPECT_EQ(values.at("subject,emg_delay"), made.truth.emg_delay_s);
  // P = (V_ml - 1) V_sh / (S (1 + V_sh))
  const auto& tri = made.truth.muscles[3];
  EXPECT_NEAR(values.at("TRI,eccentric_slope_ratio"),
              (tri.eccentric_plateau - 1.0) * tri.concentric_curvature /
                  (tri.eccentric_curvature_product * (1.0 + tri.concentric_curvature)),
              1e-12);
  EXPECT_EQ(values.at("BIC,length_activation"), made.truth.beside.length_activation);
  EXPECT_EQ(values.at("BRD,emg_exponent"), made.truth.instruments.exponent[2]);
  EXPECT_EQ(values.at("elbow_flexion,joint_viscosity"), 0.0);
}

TEST_F(WriteRecording, ExactActivationsHaveNoExponentAndAVmaxThatIsNotDrawnIsKnown) {
  VirtualRecording made = recording(1, Level::noise_free);
  made.truth.instruments.exponent.fill(1.4);
  std::istringstream rows(truth_csv(made));
  int exponents = 0;
  for (std::string row; std::getline(rows, row);) {
    if (row.find(",emg_exponent,") == std::string::npos) continue;
    ++exponents;
    EXPECT_EQ(std::stod(row.substr(row.rfind(',') + 1)), 1.0) << row;
  }
  EXPECT_EQ(exponents, 4);
  const auto held = [&](const std::string& folder) {
    write_virtual_recording(made, directory_ / folder);
    const toml::table study = parse_toml(content(directory_ / folder / "study.toml"), "study.toml");
    return study["muscle"][0]["fixed"][0].value<std::string>();
  };
  EXPECT_EQ(held("known"), "max_shortening_speed");
  made.protocol.truth.vary.push_back("max_shortening_speed");
  EXPECT_EQ(held("drawn"), "tendon_slack_length");
}

TEST_F(WriteRecording, LeavesAUsedFolderAloneUnlessToldOtherwise) {
  fs::create_directories(directory_);
  std::ofstream(directory_ / "mine.txt") << "x";
  const VirtualRecording made = recording(1, Level::noise_free);
  EXPECT_THROW(write_virtual_recording(made, directory_), InvalidInput);
  EXPECT_FALSE(fs::exists(directory_ / "study.toml"));
  EXPECT_NO_THROW(write_virtual_recording(made, directory_, {.overwrite = true}));
  EXPECT_TRUE(fs::exists(directory_ / "mine.txt"));
  EXPECT_THROW(write_virtual_recording(made, directory_ / "mine.txt"), InvalidInput);
}

}  // namespace
}  // namespace myoid::lab
