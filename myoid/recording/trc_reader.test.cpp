#include "myoid/recording/trc_reader.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/trc_writer.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"

namespace myoid::recording {
namespace {

using testing::HasSubstr;

MarkerSeries two_markers() {
  MarkerSeries m;
  m.time_s = Eigen::Vector2d(0.0, 0.01);
  m.names = {"a", "b"};
  m.positions_m.resize(2, 6);
  m.positions_m << 0.1, 0.2, 0.3, 1.0 / 3.0, -0.5, 0.25, NAN, NAN, NAN, 0.4, 0.5, 0.6;
  return m;
}

std::string trc_message(const std::string& text) {
  return test::message_of<ReadError>([&] { (void)parse_trc(text, "f.trc"); });
}

TEST(Trc, RoundTripsWithItsGaps) {
  const MarkerFile back = parse_trc(format_trc(two_markers(), "f.trc"), "f.trc");
  EXPECT_TRUE(back.repairs.empty());
  EXPECT_EQ(back.markers.names, two_markers().names);
  EXPECT_TRUE(back.markers.missing(1, 0));
  EXPECT_FALSE(back.markers.missing(1, 1));
  // Millimeters in the file: one rounding each way.
  EXPECT_NEAR(back.markers.positions_m(0, 3), 1.0 / 3.0, 1e-16);
}

TEST(Trc, BecomesMetersWhateverTheUnit) {
  std::string text = format_trc(two_markers(), "f.trc");
  text.replace(text.find("\tmm\t"), 4, "\tm\t");
  EXPECT_DOUBLE_EQ(parse_trc(text, "f.trc").markers.positions_m(0, 0), 100.0);
}

TEST(Trc, AMarkerBeyondTheEarthIsMissingAndNamed) {
  MarkerSeries markers = two_markers();
  for (const double far_m : {1e5, 1e7, 1e297}) {
    markers.positions_m(1, 3) = far_m;
    const MarkerFile file = parse_trc(format_trc(markers, "f.trc"), "f.trc");
    EXPECT_EQ(file.markers.missing(1, 1), far_m > 1e6);
    EXPECT_EQ(file.repairs.size(), far_m > 1e6 ? 1U : 0U);
  }
}

TEST(Trc, UnitsAreReadInAnyCase) {
  for (const auto& [word, factor] : {std::pair("M", 1000.0), std::pair("MM", 1.0), std::pair("Cm", 10.0)}) {
    std::string text = format_trc(two_markers(), "f.trc");
    text.replace(text.find("\tmm\t"), 4, "\t" + std::string(word) + "\t");
    EXPECT_NEAR(parse_trc(text, "f.trc").markers.positions_m(0, 0), 0.1 * factor, 1e-12) << word;
  }
}

/// The rows of the file, from line 7 on, each with `before` in front.
std::string with_before_rows(const std::string& text, const std::string& before) {
  std::string result;
  std::size_t line = 0;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = text.find('\n', at) + 1;
    result += (line >= 6 ? before : "") + text.substr(at, end - at);
    at = end;
  }
  return result;
}

TEST(Trc, RowsThatBeginWithATabAreNotShifted) {
  const std::string text = format_trc(two_markers(), "f.trc");
  const MarkerFile file = parse_trc(with_before_rows(text, "\t"), "f.trc");
  EXPECT_EQ(file.markers.time_s, two_markers().time_s);
  EXPECT_NEAR(file.markers.positions_m(0, 4), -0.5, 1e-15);
  EXPECT_EQ(file.repairs.at(0).line, 7U);
  // Without the times no rate explains the columns.
  std::string other = with_before_rows(text, "\t");
  other.replace(other.find("\n100\t"), 5, "\n250\t");
  EXPECT_THAT(trc_message(other), HasSubstr("f.trc:7: "));
}

TEST(Trc, AColumnOfFramesIsNoTime) {
  // The frame's number stands twice: its steps of 1 contradict the rate of 100 Hz.
  std::string text = format_trc(two_markers(), "f.trc");
  text.replace(text.find("\n1\t0"), 4, "\n1\t1");
  text.replace(text.find("\n2\t0.01"), 7, "\n2\t2");
  EXPECT_THAT(trc_message(text), HasSubstr("100 Hz"));
}

TEST(Trc, AMarkerAtExactlyZeroIsMissingAndThisIsSaid) {
  std::string text = format_trc(two_markers(), "f.trc");
  text.replace(text.find("100\t200\t300"), 11, "0\t0\t0");
  const MarkerFile file = parse_trc(text, "f.trc");
  EXPECT_TRUE(file.markers.missing(0, 0));
  EXPECT_EQ(file.repairs.at(0).line, 7U);
}

TEST(Trc, AMarkerOfNinesAloneIsMissingAndThisIsSaid) {
  for (const auto& [cells, missing] : {std::pair("-9999\t-9999\t-9999", true), {"-9999\t200\t-9999", false}}) {
    std::string text = format_trc(two_markers(), "f.trc");
    text.replace(text.find("100\t200\t300"), 11, cells);
    const MarkerFile file = parse_trc(text, "f.trc");
    EXPECT_EQ(file.markers.missing(0, 0), missing) << cells;
    EXPECT_EQ(file.repairs.size(), missing ? 1U : 0U) << cells;
  }
}

TEST(Trc, MendsCarriageReturnsAMissingBlankLineAndWrongCounts) {
  const std::string text =
      "PathFileType\t4\t(X/Y/"
      "Z)\tC:\\lab\\f."
      "trc\r\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\r\n100\t100\t7\t3\tmm\r\n"
      "Frame#\tTimes\ta\t\tb\r\n\t\tX0\tY0\tZ0\r\n1\t0\t1\t2\t3\t4\t5\t6\t\t\t\r\n2\t0."
      "01\t1\t2\tNaN\t4\t5\t6\r\n";
  const MarkerFile file = parse_trc(text, "f.trc");
  EXPECT_EQ(file.markers.frame_count(), 2);
  EXPECT_EQ(file.markers.names.size(), 2U);
  EXPECT_TRUE(file.markers.missing(1, 0));
  EXPECT_EQ(file.repairs.size(), 5U);  // 3 markers, Times, X0, a lone NaN, 7 frames
  EXPECT_EQ(std::ranges::count_if(file.repairs, &Repair::lost), 1);
}

TEST(Trc, MarkersWithoutNamesAreNamedByTheirPlace) {
  const std::string head = "PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n";
  const std::string rows = "1\t0\t1\t2\t3\t4\t5\t6\t7\t8\t9\n2\t0.01\t1\t2\t3\t4\t5\t6\t7\t8\t9\n";
  const std::string axes = "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\n\n";
  struct Case {
    const char *count, *labels;
    std::vector<std::string> names;
  };
  for (const Case& one : {
           Case{"0", "Frame#\tTime\t\n", {"marker_1", "marker_2", "marker_3"}},
           Case{"3", "\n", {"marker_1", "marker_2", "marker_3"}},
           Case{"3", "Frame#\tTime\ta\t\t\t\t\t\tc\t\t\n", {"a", "marker_2", "c"}},
           Case{"3", "Frame#\tTime\ta\t\t\tb\t\t\t\t\t\n", {"a", "b", "marker_3"}},
       }) {
    for (const std::string& line : {axes, std::string()}) {
      const MarkerFile file =
          parse_trc(head + "100\t100\t2\t" + one.count + "\tmm\n" + one.labels + line + rows, "f.trc");
      EXPECT_EQ(file.markers.names, one.names) << one.labels;
      ASSERT_EQ(file.markers.frame_count(), 2) << one.labels;
      EXPECT_DOUBLE_EQ(file.markers.positions_m(1, 8), 0.009) << one.labels;
      EXPECT_THAT(file.repairs, testing::Contains(testing::Field(&Repair::message, HasSubstr("no name"))));
    }
  }
}

// Pipelines of video name every axis. Read as markers, the second label would take the second marker's columns.
TEST(Trc, ThreeLabelsForEachMarkerAreOneMarker) {
  const std::string head = "PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n";
  const std::string rows = "1\t0\t1\t2\t3\t4\t5\t6\n2\t0.01\t1\t2\t3\t4\t5\t6\n";
  for (const char* axes : {"", "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"}) {
    const MarkerFile file = parse_trc(
        head + "100\t100\t2\t2\tmm\nFrame#\tTime\tNose_x\tNose_y\tNose_z\tHip_x\tHip_y\tHip_z\n" + axes + rows,
        "f.trc");
    EXPECT_THAT(file.markers.names, testing::ElementsAre("Nose", "Hip"));
    ASSERT_EQ(file.markers.frame_count(), 2);
    EXPECT_DOUBLE_EQ(file.markers.position(1, 1).y(), 0.005);
    EXPECT_THAT(file.repairs, testing::Contains(testing::Field(&Repair::message, HasSubstr("'Nose_y'"))));
  }
}

TEST(Trc, LabelsWithBlanksBetweenThemAreTwo) {
  const MarkerFile file = parse_trc(
      "PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n100\t100\t2\t3\tmm\n"
      "Frame#\tTime\thip left\t\t\tr_ankle         l_ankle\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\n"
      "1\t0\t1\t2\t3\t4\t5\t6\t7\t8\t9\n2\t0.01\t1\t2\t3\t4\t5\t6\t7\t8\t9\n",
      "f.trc");
  EXPECT_THAT(file.markers.names, testing::ElementsAre("hip left", "r_ankle", "l_ankle"));
}

// 240 frames a second with two decimals: 0, 0, 0.01, 0.01, 0.02, ...
TEST(Trc, RoundedTimesThatStandTwiceLoseNoFrame) {
  const auto file_with = [](double time_scale) {
    std::string text =
        "PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n240\t240\t24\t1\tmm\n"
        "Frame#\tTime\ta\n\t\tX1\tY1\tZ1\n\n";
    for (int k = 0; k < 24; ++k)
      text += fmt::format("{}\t{:.2f}\t{}\t1\t1\n", k + 1, 1.0 + time_scale * k / 240.0, k + 1);
    return parse_trc(text, "f.trc");
  };
  const MarkerFile rounded = file_with(1.0);
  ASSERT_EQ(rounded.markers.frame_count(), 24);
  EXPECT_DOUBLE_EQ(rounded.markers.time_s[7], 1.0 + 7.0 / 240.0);
  EXPECT_DOUBLE_EQ(rounded.markers.positions_m(7, 0), 0.008);
  EXPECT_THAT(rounded.repairs, testing::ElementsAre(testing::Field(&Repair::message, HasSubstr("those of 240 Hz"))));
  // Times that are not those of the rate say nothing about the frames that share one.
  const MarkerFile slower = file_with(0.5);
  EXPECT_LT(slower.markers.frame_count(), 24);
  EXPECT_TRUE(std::ranges::none_of(slower.repairs, &Repair::lost));
  EXPECT_DOUBLE_EQ(slower.markers.positions_m(0, 0), 0.001);
}

TEST(Trc, TellsWhatItRefusesAndWhere) {
  const std::string good = format_trc(two_markers(), "f.trc");
  std::string bad = good;
  bad.replace(bad.find("\tmm\t"), 4, "\tinch\t");
  EXPECT_NE(trc_message(bad).find("f.trc:3: Units: found 'inch'"), std::string::npos);
  bad = good;
  bad.replace(bad.find("300"), 3, "3x0");
  EXPECT_NE(trc_message(bad).find("f.trc:7: "), std::string::npos) << trc_message(bad);
  EXPECT_NE(trc_message("name,x\n1,2\n").find("expected 'PathFileType'"), std::string::npos);
}

TEST(Trc, CutOffAnywhereItGivesDataOrAnErrorButNeverACrash) {
  const std::string good = format_trc(two_markers(), "f.trc");
  for (std::size_t n = 0; n < good.size(); ++n) {
    try {
      (void)parse_trc(good.substr(0, n), "f.trc");
    } catch (const ReadError&) {
    }
  }
}

TEST(Trc, FilesOfRealLaboratoriesRead) {
  const auto root = test::data_folder();
  MYOID_REQUIRE_DATA(root / "trc");
  EXPECT_GT(read_trc(root / "trc/Knee.trc").markers.frame_count(), 100);
  EXPECT_GT(read_trc(root / "trc/UpperLimbStatic.trc").markers.frame_count(), 10);
  EXPECT_THROW((void)read_trc(root / "trc/10002-20130626160334-Unnamed.trc"),
               ReadError);  // no marker in it
  EXPECT_GT(read_trc(root / "elbow-emg/load2p75_T1_imu_landmarks.trc").markers.frame_count(), 5000);
  EXPECT_GT(read_trc(root / "box-lift/markers.trc").markers.frame_count(), 10);
  EXPECT_THROW((void)read_trc(root / "trc/Empty.trc"), ReadError);
  EXPECT_THROW((void)read_trc(root / "trc/Truncated.trc"), ReadError);
}

TEST(RotationToYUp, TurnsTheVerticalUpAndKeepsHandedness) {
  for (const char up : {'x', 'y', 'z'}) {
    const Mat3 R = myoid::rotation_to_y_up(up);
    EXPECT_EQ(R.determinant(), 1.0);
    EXPECT_EQ(Vec3(R * Vec3::Unit(up - 'x')), Vec3::UnitY());
  }
}

}  // namespace
}  // namespace myoid::recording
