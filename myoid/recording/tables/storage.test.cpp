#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/tables/storage_writer.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"

namespace myoid::recording {
namespace {

const std::string kPlain =
    "Coordinates\nversion=1\nnRows=3\nnColumns=3\ninDegrees="
    "yes\n\nendheader\ntime\tq1\ttx\n0\t90\t1\n0.1\t180\t2\n0.2\t-45\t3\n";

std::string storage_message(const std::string& text) {
  return test::message_of<ReadError>([&] { (void)parse_storage(text, "f.sto"); });
}

TEST(ParseStorage, TheIndexOfADataFrameIsNoTime) {
  const std::string head = "DataType=double\nversion=3\nendheader\n\ttime\tknee\n";
  try {
    (void)parse_storage(head + "0\t0.5\t7\n1\t0.6\t8\n", "a.sto");
    ADD_FAILURE();
  } catch (const ReadError& error) {
    EXPECT_EQ(error.line(), 4U);
  }
  // Tabs before every row are none.
  const Storage shifted = parse_storage(head + "\t0.5\t7\n\t0.6\t8\n", "a.sto");
  EXPECT_DOUBLE_EQ(shifted.data.time_s()[1], 0.6);
  EXPECT_DOUBLE_EQ(shifted.data.values()(1, 0), 8.0);
}

TEST(ParseStorage, TimesThatRoundingMadeEqualAreEven) {
  std::string text = "EMG\nversion=1\nnRows=2000\nnColumns=2\ninDegrees=no\nendheader\ntime\tbiceps\n";
  for (int i = 0; i < 2000; ++i) text += fmt::format("{:.3f}\t{}\n", i / 2000.0, i);
  const Storage emg = parse_storage(text, "emg.sto");
  ASSERT_EQ(emg.data.sample_count(), 2000);
  EXPECT_NEAR(emg.data.mean_rate_hz(), 2000.0, 0.1);
  EXPECT_DOUBLE_EQ(emg.data.values()(1999, 0), 1999.0);
  EXPECT_EQ(emg.repairs.size(), 1U);
}

TEST(ParseStorage, ReadsVersionOne) {
  const Storage s = parse_storage(kPlain, "f.mot");
  EXPECT_EQ(s.title, "Coordinates");
  EXPECT_TRUE(s.in_degrees);
  EXPECT_TRUE(s.repairs.empty());
  EXPECT_EQ(s.data.column("tx"), Eigen::Vector3d(1, 2, 3));
}

TEST(ToSi, ConvertsAnglesOnly) {
  const TimeSeries si = to_si(parse_storage(kPlain, "f.mot"), [](const std::string& name) { return name == "q1"; });
  EXPECT_DOUBLE_EQ(si.values()(0, 0), kPi / 2.0);
  EXPECT_EQ(si.channels()[0].unit, Unit::radian);
  EXPECT_EQ(si.values()(2, 1), 3.0);
}

TEST(ParseStorage, ReadsSimmsKindAsDegrees) {
  const Storage s = parse_storage("name m\ndatacolumns 2\ndatarows 1\nrange 0 0\nendheader\ntime q\n0 10\n", "f.mot");
  EXPECT_TRUE(s.in_degrees);
  EXPECT_EQ(s.data.values()(0, 0), 10.0);
}

TEST(ParseStorage, ReadsVersionThreeWithThreeNumbersACell) {
  const Storage s = parse_storage(
      "DataType=Vec3\nversion=3\nOpenSimVersion=4.5\nendheader\ntime\ta\tb\n0\t1,2,3\t4,5,6\n0."
      "5\t7,8,9\t1,1,1\n",
      "f.sto");
  EXPECT_EQ(s.data.column("a_3"), Eigen::Vector2d(3, 9));
  EXPECT_EQ(s.data.channel_count(), 6);
}

TEST(ParseStorage, MendsWhatCanBeMendedAndSaysSo) {
  const Storage s = parse_storage(
      "x\r\nnRows=9\r\nnColumns="
      "2\r\nendheader\r\nTime\tq\tq\t\r\n0\t1\t2\t\r\n\r\n0\t1\t2\r\n1\tnan\t3\t4\r\n",
      "f.sto");
  EXPECT_EQ(s.data.sample_count(), 2);
  EXPECT_TRUE(std::isnan(s.data.values()(1, 0)));
  EXPECT_TRUE(s.data.find("q_2").has_value());
  std::string all;
  for (const Repair& r : s.repairs) all += std::to_string(r.line) + ": " + r.message + "\n";
  EXPECT_NE(all.find("5: column 'Time'"), std::string::npos) << all;
  EXPECT_NE(all.find("8: a time stands twice"), std::string::npos) << all;
  EXPECT_NE(all.find("9: more numbers"), std::string::npos) << all;
  EXPECT_NE(all.find("9: a value"), std::string::npos) << all;
  EXPECT_NE(all.find("says 9 rows"), std::string::npos) << all;
  EXPECT_NE(all.find("says 2 columns"), std::string::npos) << all;
  // A file of times alone, of which one repeats, has no value to move.
  EXPECT_EQ(parse_storage("x\nendheader\ntime\n0\n0\n1\n5\n", "f.sto").data.sample_count(), 3);
  // A lost row is no matter of columns.
  EXPECT_EQ(std::ranges::count_if(s.repairs, &Repair::lost), 1);
}

TEST(ParseStorage, ANumberThatStandsForAMissingValueIsAGapOfItsColumn) {
  const Storage s = parse_storage("x\nendheader\ntime\tq\tr\n0\t1\t2\n1\t-9999\t3\n2\t2\t9000\n", "f.sto");
  EXPECT_TRUE(std::isnan(s.data.values()(1, 0)));
  EXPECT_EQ(s.data.channels()[0].missing, -9999.0);
  EXPECT_EQ(s.data.channels()[1].missing, std::nullopt);
  EXPECT_EQ(s.repairs.size(), 1U);
  // A command that needs the number names the number.
  EXPECT_NE(test::message_of([&] { require_finite(s.data, "f.sto"); }).find("-9999"), std::string::npos);
}

TEST(ParseStorage, ReadsCommaDecimals) {
  const Storage s = parse_storage("x\nendheader\ntime\tq\n0\t1,5\n0,5\t2,25\n", "f.sto");
  EXPECT_EQ(s.data.values()(1, 0), 2.25);
  EXPECT_EQ(s.data.time_s()[1], 0.5);
}

TEST(ParseStorage, TellsTheLineOfWhatItRefuses) {
  EXPECT_NE(storage_message("x\nendheader\ntime\tq\n0\t1\n1\n").find("f.sto:5: expected 2 numbers, found 1"),
            std::string::npos);
  EXPECT_NE(storage_message("x\nendheader\ntime\tq\n0\tabc\n").find("f.sto:4: "), std::string::npos);
  EXPECT_NE(storage_message("x\nendheader\ntime\tq\n1\t1\n0\t1\n").find("f.sto:5: "), std::string::npos);
  EXPECT_NE(storage_message("x\nno header end\n").find("'endheader'"), std::string::npos);
  EXPECT_NE(storage_message("x\nendheader\nt\tq\n").find("'time'"), std::string::npos);
  EXPECT_NE(storage_message("x\nendheader\ntime\tq\n").find("no rows"), std::string::npos);
}

TEST(ParseStorage, AFileCutOffAnywhereGivesDataOrAnErrorButNeverACrash) {
  for (std::size_t n = 0; n < kPlain.size(); ++n) {
    try {
      (void)parse_storage(kPlain.substr(0, n), "f.mot");
    } catch (const ReadError&) {
    }
  }
}

TEST(FormatStorage, RoundTripsToTheLastBit) {
  Eigen::VectorXd time(3);
  time << 0.0, 1.0 / 3.0, 0.7;
  Eigen::MatrixXd values(3, 2);
  values << 0.1, 1e-17, -2.0 / 7.0, 1e5, 3.0, std::nextafter(1.0, 2.0);
  const TimeSeries series(time, {{"a"}, {"b"}}, values);
  const Storage back = parse_storage(format_storage(series, {.title = "t", .comments = {"made by hand"}}), "f.sto");
  EXPECT_EQ(back.data.values(), values);
  EXPECT_EQ(back.data.time_s(), time);
  EXPECT_TRUE(back.repairs.empty());
}

TEST(FormatStorage, WritesDegreesWhereAsked) {
  const TimeSeries series(Eigen::VectorXd::Zero(1), {{"q", Unit::radian}, {"x", Unit::meter}},
                          Eigen::RowVector2d(kPi, 2.0));
  const Storage back = parse_storage(format_storage(series, {.angles_in_degrees = true}), "f.mot");
  EXPECT_TRUE(back.in_degrees);
  EXPECT_DOUBLE_EQ(back.data.values()(0, 0), 180.0);
  EXPECT_EQ(back.data.values()(0, 1), 2.0);
}

TEST(FormatStorage, RefusesAGap) {
  EXPECT_THROW(
      (void)format_storage({Eigen::VectorXd::Zero(1), {{"q"}}, Eigen::MatrixXd::Constant(1, 1, std::nan(""))}, {}),
      InvalidInput);
}

TEST(ReadStorage, EveryResultFileOfTheSharedDataReads) {
  const auto root = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(root);
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const auto extension = entry.path().extension();
    if (extension != ".sto" && extension != ".mot") continue;
    if (std::filesystem::file_size(entry.path()) > 1000000) continue;
    const Storage s = read_storage(entry.path());
    EXPECT_GT(s.data.sample_count(), 0) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 50);
}

TEST(ParseStorage, LabelsMayMixTabsAndBlanks) {
  for (const char* labels :
       {"time\t\tq1\ttx", "time  q1\ttx", "time \t q1 \t\t tx\t", "time q1  tx", "time\t\tq1   tx", "time q1\ttx"}) {
    const Storage s =
        parse_storage("x\nversion=1\nendheader\n" + std::string(labels) + "\n0\t1\t2\n1\t3\t4\n", "f.sto");
    ASSERT_EQ(s.data.channel_count(), 2) << labels;
    EXPECT_EQ(s.data.column("q1"), Eigen::Vector2d(1, 3)) << labels;
    EXPECT_EQ(s.data.column("tx"), Eigen::Vector2d(2, 4)) << labels;
  }
}

TEST(ParseStorage, ASpreadsheetsSeparatorsAreNoPartOfTheHeader) {
  const std::string commas =
      "Coordinates,,\nversion=1,,\nnRows=2,,\nnColumns=3,,\ninDegrees=yes,,\nendheader,,\ntime,q1,tx\n0,90,1\n0.1,180,"
      "2\n";
  std::string semicolons = commas;
  std::ranges::replace(semicolons, ',', ';');
  std::ranges::replace(semicolons, '.', ',');
  for (const std::string& text : {commas, semicolons}) {
    const Storage s = parse_storage(text, "f.mot");
    EXPECT_TRUE(s.in_degrees);
    EXPECT_EQ(s.title, "Coordinates");
    EXPECT_EQ(s.data.column("q1"), Eigen::Vector2d(90, 180));
    EXPECT_DOUBLE_EQ(s.data.time_s()[1], 0.1);
    // Under the name of a table the header would be lost, and with it the degrees.
    EXPECT_THROW((void)parse_emg_table(text, "f.csv"), ReadError);
    EXPECT_THROW((void)parse_csv_series(text, "f.csv"), ReadError);
    EXPECT_THROW((void)parse_csv_table(text, "f.csv"), ReadError);
  }
}

TEST(ParseStorage, ACompleteLastRowNeedsNoLineEnd) {
  const std::string head = "x\nversion=1\nendheader\ntime\tq1\n0\t1.25\n1\t2.25\n";
  EXPECT_EQ(parse_storage(head + "2\t3.25", "f.sto").data.sample_count(), 3);
  EXPECT_EQ(parse_storage(head + "2\t3.2", "f.sto").data.sample_count(), 2);
  EXPECT_EQ(parse_storage(head + "2", "f.sto").data.sample_count(), 2);
}

TEST(ParseStorage, CommasBetweenCellsAreSeparatorsAndInsideThemDecimals) {
  const std::string head = "x\nversion=1\nendheader\n";
  for (const std::string labels : {"time,a,b\n", "time, a, b\n", "time\ta\tb\n"}) {
    const Storage commas = parse_storage(head + labels + "0,1.5,2\n0.5,3,4.25\n", "f.sto");
    EXPECT_EQ(channel_names(commas.data), "a, b") << labels;
    EXPECT_EQ(commas.data.values()(1, 1), 4.25) << labels;
    EXPECT_EQ(commas.data.time_s()[1], 0.5) << labels;
    EXPECT_EQ(commas.repairs.size(), 1U) << labels;
  }
  const Storage decimals = parse_storage(head + "time\ta\tb\n0\t1,5\t2\n0,5\t3\t4,25\n", "f.sto");
  EXPECT_EQ(decimals.data.values()(1, 1), 4.25);
  EXPECT_EQ(parse_storage(head + "time a b\n0 1,5 2,5\n", "f.sto").data.values()(0, 1), 2.5);
  // Both together are ambiguous.
  EXPECT_THROW((void)parse_storage(head + "time,a,b\n0,0,1,5,2,5\n", "f.sto"), ReadError);
}

}  // namespace
}  // namespace myoid::recording
