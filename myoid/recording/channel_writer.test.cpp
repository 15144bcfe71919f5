#include "myoid/recording/channel_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/text_file.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/tables/csv_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ChannelWriter : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

  /// Writes a storage text to another file and returns that file's text.
  std::string written(const std::string& text, const std::string& name) {
    const Storage storage = parse_storage(text, "in.sto");
    write_channels(file(name), rows_of(storage.data), statement_of(storage));
    return read_text_file(file(name));
  }

  test::TemporaryFolder folder_;
};

constexpr const char* kMicrovolts =
    "raw surface EMG microvolt 2000 Hz\nversion=1\nnRows=2\nnColumns=3\ninDegrees=no\nendheader\n"
    "time\tBIC\tTRI\n0\t-1.01\t2.49\n0.0005\t-0.7\t3.11\n";

TEST_F(ChannelWriter, MicrovoltsStayMicrovoltsAndAreNeverCalledSI) {
  const std::string text = written(kMicrovolts, "b.sto");
  EXPECT_TRUE(text.starts_with("raw surface EMG microvolt 2000 Hz\n"));
  EXPECT_THAT(text, HasSubstr("\nunit=uV\n"));
  EXPECT_THAT(text, HasSubstr("\n0\t-1.01\t2.49\n"));
  EXPECT_THAT(text, Not(HasSubstr("S.I.")));
  // A reader of EMG finds the same voltages in both files.
  const EmgFile emg = read_emg(file("b.sto"), "", false);
  EXPECT_EQ(emg.data.channels()[0].unit, Unit::volt);
  EXPECT_DOUBLE_EQ(emg.data.values()(0, 0), -1.01e-6);
}

TEST_F(ChannelWriter, ATableHasTheUnitInItsHeaderCellsAndReadsBackInVolts) {
  EXPECT_TRUE(written(kMicrovolts, "b.csv").starts_with("time_s,BIC [uV],TRI [uV]\n0,-1.01,2.49\n"));
  const CsvSeries table = read_csv_series(file("b.csv"));
  const ChannelStatement said = statement_of(table.data.channels(), file("b.csv"));
  EXPECT_THAT(said.units, ::testing::ElementsAre("V", "V"));
  write_channels(file("c.sto"), rows_of(table.data), said);
  EXPECT_THAT(read_text_file(file("c.sto")), HasSubstr("\nunit=V\n"));
  EXPECT_DOUBLE_EQ(read_emg(file("c.sto"), "", false).data.values()(1, 1), 3.11e-6);
}

TEST_F(ChannelWriter, DegreesAreSaidInBothKindsOfFile) {
  const std::string motion =
      "a motion\nversion=1\nnRows=1\nnColumns=2\ninDegrees=yes\nendheader\ntime\tknee\n0\t30.5\n";
  EXPECT_THAT(written(motion, "b.mot"), HasSubstr("\ninDegrees=yes\n"));
  EXPECT_TRUE(written(motion, "b.csv").starts_with("# inDegrees=yes\ntime_s,knee\n0,30.5\n"));
  const TimeSeries table = read_csv_series(file("b.csv")).data;
  write_channels(file("c.mot"), rows_of(table), statement_of(table.channels(), file("b.csv")));
  const Storage back = read_storage(file("c.mot"));
  EXPECT_TRUE(back.in_degrees);
  EXPECT_EQ(back.data.values()(0, 0), 30.5);
}

TEST_F(ChannelWriter, UnitsOfTheirOwnStandBesideTheChannelsAndComeBack) {
  const TimeSeries series(Eigen::VectorXd::Zero(1), {{"BIC", Unit::volt}, {"grip", Unit::newton}},
                          Eigen::MatrixXd::Constant(1, 2, 0.5));
  write_channels(file("b.sto"), rows_of(series), statement_of(series.channels(), "in.c3d"));
  const Storage back = read_storage(file("b.sto"));
  EXPECT_EQ(back.units.at("BIC"), "V");
  EXPECT_EQ(back.units.at("grip"), "N");
  EXPECT_THAT(read_text_file(file("b.sto")), HasSubstr("S.I."));
  // The force is no EMG, the voltage needs no --unit.
  const EmgFile emg = read_emg(file("b.sto"), "", false);
  ASSERT_EQ(emg.data.channel_count(), 1);
  EXPECT_EQ(emg.data.channels()[0].name, "BIC");
}

TEST_F(ChannelWriter, WhatHasNoUnitIsGivenNone) {
  const std::string text =
      written("x\nversion=1\nnRows=1\nnColumns=2\ninDegrees=no\nendheader\ntime\tq\n0\t1\n", "b.sto");
  EXPECT_THAT(text, Not(HasSubstr("S.I.")));
  EXPECT_THAT(text, Not(HasSubstr("[1]")));
}

}  // namespace
}  // namespace myoid::recording
