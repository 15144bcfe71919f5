#include "myoid/recording/emg_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/c3d/c3d_writer.h"

#include "tests/support/plate_recording.h"
#include "tests/support/repair_lines.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

const std::string kBody = "endheader\ntime\tbiceps\n0\t100\n0.001\t-50\n";

TEST(ReadEmg, TakesTheUnitFromTheTitle) {
  const test::TemporaryFolder folder;
  write_file(folder / "e.sto", "raw surface EMG microvolt 2000 Hz\n" + kBody);
  const EmgFile file = read_emg(folder / "e.sto", "", false);
  EXPECT_DOUBLE_EQ(file.data.values()(0, 0), 100e-6);
  EXPECT_EQ(file.data.channels()[0].unit, Unit::volt);
}

TEST(ReadEmg, TheUnitThatTheFileStatesHoldsAgainstAnotherOneAndThatIsSaid) {
  const test::TemporaryFolder folder;
  write_file(folder / "e.sto", "raw surface EMG microvolt 2000 Hz\n" + kBody);
  const EmgFile file = read_emg(folder / "e.sto", "V", false);
  EXPECT_DOUBLE_EQ(file.data.values()(0, 0), 100e-6);
  EXPECT_NE(file.unit_conflict.find("in uV"), std::string::npos) << file.unit_conflict;
  EXPECT_EQ(read_emg(folder / "e.sto", "uV", false).unit_conflict, "");
  EXPECT_EQ(read_emg(folder / "e.sto", "V", true).unit_conflict, "");
}

TEST(ReadEmg, VoltsThatNoAmplifierGivesTakeTheUnitGivenAndThatIsSaid) {
  const test::TemporaryFolder folder;
  write_file(folder / "title.sto", "raw surface EMG V 2000 Hz\n" + kBody);
  write_file(folder / "column.csv", "time,biceps [V]\n0,100\n0.001,-50\n0.002,20\n");
  for (const char* name : {"title.sto", "column.csv"}) {
    EXPECT_DOUBLE_EQ(read_emg(folder / name, "", false).data.values()(0, 0), 100.0) << name;
    const EmgFile file = read_emg(folder / name, "uV", false);
    EXPECT_DOUBLE_EQ(file.data.values()(0, 0), 100e-6) << name;
    EXPECT_EQ(file.unit_conflict, "") << name;
    EXPECT_FALSE(file.repairs.empty()) << name;
  }
  write_file(folder / "small.csv", "time,biceps [V]\n0,1\n0.001,-0.5\n0.002,0.2\n");
  EXPECT_DOUBLE_EQ(read_emg(folder / "small.csv", "uV", false).data.values()(0, 0), 1.0);
}

TEST(ReadEmg, WithoutAUnitItAsksForOne) {
  const test::TemporaryFolder folder;
  write_file(folder / "e.sto", "EMG\n" + kBody);
  try {
    (void)read_emg(folder / "e.sto", "", false);
    FAIL();
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("unit = \"uV\""), std::string::npos);
  }
  EXPECT_DOUBLE_EQ(read_emg(folder / "e.sto", "mV", false).data.values()(0, 0), 0.1);
  EXPECT_EQ(read_emg(folder / "e.sto", "", true).data.values()(0, 0), 100.0);
}

TEST(ReadEmg, NamesTheChannelsOfAC3dFileThatItLeavesOut) {
  const test::TemporaryFolder folder;
  C3dFile c3d = test::plate_recording(2);
  c3d.channels.push_back({"EMG", "V", 0.0, 1.0});
  c3d.channels.push_back({"Torque", "Nm", 0.0, 1.0});
  c3d.analog.conservativeResize(Eigen::NoChange, 8);
  c3d.analog.rightCols(2).setConstant(0.5F);
  write_c3d(folder / "f.c3d", c3d);
  const EmgFile file = read_emg(folder / "f.c3d", "", false);
  ASSERT_EQ(file.data.channel_count(), 1);
  EXPECT_THAT(test::repair_lines(file.repairs), testing::HasSubstr("left out: Fx, Fy, Fz, Mx, My, Mz, Torque\n"));
}

}  // namespace
}  // namespace myoid::recording
