#include "myoid/recording/bids.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/bids_derivative.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

void put(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

const std::string kStem = "sub-01_task-lift_tracksys-omc";

void put_motion(const test::TemporaryFolder& folder, const std::string& angle_unit = "deg") {
  put(folder / (kStem + "_motion.json"), R"({"TaskName": "lift", "SamplingFrequency": 100})");
  put(folder / (kStem + "_channels.tsv"),
      "name\tcomponent\ttype\ttracked_point\tunits\n"
      "w_x\tx\tPOS\twrist\tmm\nw_y\ty\tPOS\twrist\tmm\nw_z\tz\tPOS\twrist\tmm\n"
      "elbow\tn/a\tJNTANG\telbow\t" +
          angle_unit + "\nacc\tx\tACCEL\twrist\tg\n");
  put(folder / (kStem + "_motion.tsv"), "1\t2\t3\t90\t0\nn/a\t2\t3\t45\t0\n");
}

TEST(Bids, MotionGivesMarkersAndAngles) {
  const test::TemporaryFolder folder;
  put_motion(folder);
  const BidsMotion motion = read_bids_motion(folder / (kStem + "_motion.tsv"));
  ASSERT_EQ(motion.markers.names, std::vector<std::string>{"wrist"});
  EXPECT_DOUBLE_EQ(motion.markers.positions_m(0, 2), 3e-3);
  EXPECT_TRUE(motion.markers.missing(1, 0));
  EXPECT_TRUE(std::isnan(motion.markers.positions_m(1, 2)));
  EXPECT_DOUBLE_EQ(motion.angles.column("elbow")[0], kPi / 2.0);
  EXPECT_DOUBLE_EQ(motion.angles.time_s()[1], 0.01);
  EXPECT_EQ(motion.repairs.size(), 1U);  // the accelerometer
  EXPECT_EQ(read_markers(folder / (kStem + "_motion.tsv")).markers.names, motion.markers.names);
}

TEST(Bids, LatenciesAreTheClockAndAnotherRateIsApartAtTheEnd) {
  const test::TemporaryFolder folder;
  const auto apart_s = [&](const std::string& json_hz, const std::string& channels_hz, bool with_latency) {
    put(folder / (kStem + "_motion.json"), R"({"SamplingFrequency": )" + json_hz + "}");
    const std::string end = "\tdeg\t" + channels_hz + "\n";
    put(folder / (kStem + "_channels.tsv"), "name\ttype\tunits\tsampling_frequency\n" +
                                                std::string(with_latency ? "t\tLATENCY\tn/a\tn/a\n" : "") +
                                                "elbow\tJNTANG" + end);
    std::string rows;
    for (int i = 0; i <= 200; ++i) rows += (with_latency ? std::to_string(0.01 * i) + "\t" : "") + "9\n";
    put(folder / (kStem + "_motion.tsv"), rows);
    const BidsMotion motion = read_bids_motion(folder / (kStem + "_motion.tsv"));
    EXPECT_NEAR(motion.angles.time_s()[200], with_latency ? 2.0 : 200.0 / std::stod(json_hz), 1e-9);
    double apart = 0.0;
    for (const Repair& repair : motion.repairs) apart = std::max(apart, repair.apart_s);
    return apart;
  };
  EXPECT_EQ(apart_s("100", "100", true), 0.0);
  EXPECT_NEAR(apart_s("200", "n/a", true), 1.0, 1e-9);
  EXPECT_NEAR(apart_s("100", "200", true), 1.0, 1e-9);
  EXPECT_NEAR(apart_s("200", "100", false), 1.0, 1e-9);
  EXPECT_EQ(apart_s("200", "n/a", false), 0.0);
  put(folder / (kStem + "_channels.tsv"), "name\ttype\tunits\nt\tLATENCY\ts\nelbow\tJNTANG\tdeg\n");
  put(folder / (kStem + "_motion.tsv"), "0\t9\n0.02\t9\n0.01\t9\n");
  EXPECT_THROW(static_cast<void>(read_bids_motion(folder / (kStem + "_motion.tsv"))), ReadError);
}

TEST(Bids, WhatIsMissingIsSaid) {
  const test::TemporaryFolder folder;
  const auto file = folder / (kStem + "_motion.tsv");
  put_motion(folder, "furlong");
  EXPECT_THROW(static_cast<void>(read_bids_motion(file)), ReadError);
  put_motion(folder);
  put(file, "1\t2\t3\n");
  EXPECT_THROW(static_cast<void>(read_bids_motion(file)), ReadError);
  put_motion(folder);
  put(folder / (kStem + "_motion.json"), "{}");
  EXPECT_THROW(static_cast<void>(read_bids_motion(file)), ReadError);
  put_motion(folder);
  std::filesystem::remove(folder / (kStem + "_channels.tsv"));
  EXPECT_THROW(static_cast<void>(read_bids_motion(file)), ReadError);
}

TEST(Bids, EmgChannelsHaveTheirUnitMuscleAndStatusFromTheTable) {
  const test::TemporaryFolder folder;
  put(folder / "sub-01_task-lift_emg.csv", "time,E1,E2,E3,T\n0,1,2,3,0\n0.001,4,5,6,0\n0.002,1,1,1,0\n");
  put(folder / "sub-01_task-lift_channels.tsv",
      "name\ttype\tunits\ttarget_muscle\tstatus\nE1\tEMG\tmV\tbiceps brachii\tgood\n"
      "E2\tEMG\tuV\ttriceps brachii\tgood\nE3\tEMG\tuV\tn/a\tbad\nT\tTRIG\tn/a\tn/a\tgood\n");
  const EmgFile emg = read_emg(folder / "sub-01_task-lift_emg.csv", "", false);
  ASSERT_EQ(emg.data.channel_count(), 2);
  EXPECT_DOUBLE_EQ(emg.data.column("E1")[1], 4e-3);
  EXPECT_DOUBLE_EQ(emg.data.column("E2")[1], 5e-6);
  EXPECT_EQ(emg.target_muscle.at("E2"), "triceps brachii");
  EXPECT_EQ(emg.repairs.size(), 2U);
  put(folder / "sub-01_task-lift_channels.tsv",
      "name\ttype\tunits\tsampling_frequency\nE1\tEMG\tmV\t2000\nE2\tEMG\tuV\t2000\n");
  const EmgFile other = read_emg(folder / "sub-01_task-lift_emg.csv", "", false);
  ASSERT_EQ(other.repairs.size(), 1U);
  EXPECT_NEAR(other.repairs[0].apart_s, 1e-3, 1e-9);
}

TEST(Bids, ResultsBecomeADerivativeThatIsReadAgain) {
  const test::TemporaryFolder folder;
  const auto results = folder / "results";
  std::filesystem::create_directories(results / "flex 1");
  put(results / "parameters.csv", "muscle,parameter,estimate,reason\nBIC,v_max,0.5,\"a, b\"\n");
  put(results / "flex 1" / "ik.mot",
      "ik\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\ntime\telbow\tbase_tx\n"
      "0\t90\t0.5\n0.01\t45\t0.25\n");
  const auto files = write_bids_derivative(results, folder / "out", "S-01");
  EXPECT_EQ(files.size(), 6U);
  EXPECT_EQ(read_text_file(folder / "out/sub-S01/sub-S01_desc-identified_parameters.tsv"),
            "muscle\tparameter\testimate\treason\nBIC\tv_max\t0.5\ta, b\n");
  EXPECT_NE(read_text_file(folder / "out/dataset_description.json").find("\"derivative\""), std::string::npos);
  const BidsMotion motion =
      read_bids_motion(folder / "out/sub-S01/motion/sub-S01_task-flex1_tracksys-model_motion.tsv");
  EXPECT_DOUBLE_EQ(motion.angles.column("elbow")[0], kPi / 2.0);
  EXPECT_NEAR(motion.angles.time_s()[1], 0.01, 1e-15);
  EXPECT_THROW(static_cast<void>(write_bids_derivative(folder / "none", folder / "x", "1")), ReadError);
  EXPECT_THROW(static_cast<void>(write_bids_derivative(results, folder / "x", "")), InvalidInput);
}

}  // namespace
}  // namespace myoid::recording
