// Damaged input for the readers: files cut off anywhere, one byte changed, and numbers that could be misunderstood.

#include <algorithm>
#include <clocale>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/toml_table.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/makers/marker_table.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/trc_reader.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"
#include "tests/support/repair_lines.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

const std::string kTrc =
    "PathFileType\t4\t(X/Y/Z)\tf.trc\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumF"
    "rames\n"
    "100\t100\t3\t2\tmm\t100\t1\t3\n"
    "Frame#\tTime\ta\t\t\tb\t\t\n"
    "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
    "\n"
    "1\t0\t1\t2\t3\t4\t5\t6\n"
    "2\t0.01\t1.5\t2.5\t3.5\t\t\t\n"
    "3\t0.02\t1\t2\t3\t4\t5\t6\n";
const std::string kVersionOne =
    "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees="
    "yes\n\nendheader\ntime\tq\ttx\n0\t90\t1\n0.1\t-1.5e1\t2\n";
const std::string kVectors =
    "DataType=Vec3\nversion=3\nOpenSimVersion=4.5\nendheader\ntime\ta\tb\n0\t1,2,3\t4,5,6\n0.5\t7,"
    "8,9\t1,1,1\n";
const std::string kTable = "Time (ms);biceps [mV];\"a;b\"\n0;1,5;2\n10;;3\n";

const std::string kNexus =
    "Devices\n1000\n,,EMG - V,\nFrame,Sub Frame,A,B\n,,V,mV\n7,0,0.1,0.2\n7,1,0.3,0.4\n8,0,1,2\n\n"
    "Trajectories\n500\n,,P:A,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n7,0,1,2,3\n8,0,,,\n";
const std::string kQualisys =
    "NO_OF_FRAMES\t2\nNO_OF_MARKERS\t2\nFREQUENCY\t200\nDATA_INCLUDED\t3D\nMARKER_NAMES\tA\tB\n"
    "1.5\t2\t3\t4\t5\t6\n1\t2\t3\t0\t0\t0\n";
const std::string kMotive =
    "Format Version,1.23,Export Frame Rate,100,Total Exported Frames,2,Length Units,Meters\n\n"
    ",,Rigid Body,Marker,Marker,Marker\n,,Hand,A,A,A\n,,1,2,2,2\n,,Rotation,Position,Position,"
    "Position\nFrame,Time,X,X,Y,Z\n0,0,9,1,2,3\n1,0.01,9,1,2,3\n";
const std::string kDiscover =
    "Application:, Trigno Discover (1.7.0)\nCollection Length (seconds):, 0.05\nS 1, , S 2\n"
    "sensor mode: 5, , sensor mode: 5\nEMG 1 (mV), ACC X (G), EMG 1 (mV)\n74 Hz, 37 Hz, 74 Hz\n"
    "1, 2, 3\n4, 5, 6\n7, , 8\n";
const std::string kNoraxon =
    "\"type\";\"frequency\";\"count\"\n\"record\";\"1000\";\"3\"\n\n\"time\";\"Activity\";\"E "
    "(uV)\"\n"
    "0,000;\"Rest\";1,5\n0,001;;2,5\n0,002;\"x\";3,5\n";
const std::string kPairs = "X[s],\"E 1 [V]\",X[s],\"ACC 1\"\n0,1,0,2\n0.5,3,1,4\n1,5,,\n1.5,6,,\n";

struct Format {
  std::string name;
  std::string text;
  std::function<void(std::string_view)> read;
};

std::vector<Format> formats() {
  return {{"trc", kTrc, [](std::string_view t) { (void)parse_trc(t, "f.trc"); }},
          {"storage 1", kVersionOne, [](std::string_view t) { (void)parse_storage(t, "f.mot"); }},
          {"storage 3", kVectors, [](std::string_view t) { (void)parse_storage(t, "f.sto"); }},
          {"table", kTable, [](std::string_view t) { (void)parse_csv_series(t, "f.csv"); }},
          {"devices", kNexus, [](std::string_view t) { (void)parse_emg_table(t, "f.csv"); }},
          {"trajectories", kNexus, [](std::string_view t) { (void)parse_marker_table(t, "f.csv"); }},
          {"Qualisys", kQualisys, [](std::string_view t) { (void)parse_marker_table(t, "f.tsv"); }},
          {"Motive", kMotive, [](std::string_view t) { (void)parse_marker_table(t, "f.csv"); }},
          {"Discover", kDiscover, [](std::string_view t) { (void)parse_emg_table(t, "f.csv"); }},
          {"Noraxon", kNoraxon, [](std::string_view t) { (void)parse_emg_table(t, "f.csv"); }},
          {"pairs", kPairs, [](std::string_view t) { (void)parse_emg_table(t, "f.csv"); }},
          {"toml", "a = 1\n[emg]\nunit = \"uV\"\nlist = [1, 2.5]\n",
           [](std::string_view t) { (void)parse_toml(t, "f.toml"); }}};
}

/// Reading gives data or a ReadError that begins with the path; anything else fails the test (or the process).
void expect_data_or_error(const Format& format, const std::string& text, const std::string& what) {
  try {
    format.read(text);
  } catch (const ReadError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("f.", 0), 0U) << format.name << ", " << what << ": " << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << format.name << ", " << what << ": " << error.what();
  }
}

template <class Action>
std::string refusal(Action&& action) {
  return test::message_of<ReadError>([&] { action(); });
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), replacement);
}

/// Found by fuzzing: a name longer than the system allows must not end the program.
TEST(AnyReader, ANameTooLongForTheSystemIsAReadErrorThatNamesIt) {
  for (const std::size_t length : {300U, 5000U}) {
    for (const char* ending : {".trc", ".c3d", ".csv", ".edf", ".anc", ".sto", "_emg.edf", "_motion.tsv", ".txt"}) {
      const std::string name = std::string(length, 'x') + ending;
      for (const auto& read : {+[](const std::string& n) { static_cast<void>(read_recording(n)); },
                               +[](const std::string& n) { static_cast<void>(read_markers(n)); },
                               +[](const std::string& n) { static_cast<void>(read_emg(n, "", false)); }}) {
        try {
          read(name);
          ADD_FAILURE() << "read " << ending;
        } catch (const ReadError& error) {
          EXPECT_EQ(std::string(error.what()).rfind(name, 0), 0U) << ending;
        }
      }
    }
  }
}

TEST(AnyReader, CutOffAtAnyByteGivesDataOrAnErrorThatNamesTheFile) {
  for (const Format& format : formats()) {
    format.read(format.text);  // the whole file is good
    for (std::size_t n = 0; n < format.text.size(); ++n)
      expect_data_or_error(format, format.text.substr(0, n), "cut at " + std::to_string(n));
  }
}

TEST(AnyReader, AnyByteReplacedByAnOddOneGivesDataOrAnErrorThatNamesTheFile) {
  const std::string odd{'\0', '\t', '\n', '\r', ' ', ',', '-', '+', '"', '=', '9', 'e', 'n', '\x7F', '\xC3', '\xFF'};
  for (const Format& format : formats()) {
    for (std::size_t n = 0; n < format.text.size(); ++n) {
      for (const char c : odd) {
        std::string text = format.text;
        text[n] = c;
        expect_data_or_error(format, text, "byte " + std::to_string(n) + " = " + std::to_string(int(c)));
      }
    }
  }
}

TEST(AnyReader, PiecesLostDoubledAndSwappedGiveDataOrAnErrorThatNamesTheFile) {
  std::mt19937_64 engine(20261121);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(engine() % n); };
  for (const Format& format : formats()) {
    for (int trial = 0; trial < 2000; ++trial) {
      std::string text = format.text;
      for (std::size_t edits = 1 + below(3); edits > 0 && !text.empty(); --edits) {
        const std::size_t at = below(text.size());
        const std::string piece = text.substr(at, 1 + below(12));
        switch (below(3)) {
          case 0:
            text.erase(at, piece.size());
            break;
          case 1:
            text.insert(at, piece);
            break;
          default:
            text.erase(at, piece.size());
            text.insert(below(text.size() + 1), piece);
        }
      }
      expect_data_or_error(format, text, "trial " + std::to_string(trial));
    }
  }
}

// --- Numbers that would be understood wrongly without a word
// ------------------------------------------------------------------

TEST(ParseStorage, BlanksAndCaseInTheHeaderDoNotTurnDegreesIntoRadians) {
  for (const std::string line : {"inDegrees = yes", "indegrees=YES", "InDegrees=true", "inDegrees yes"}) {
    EXPECT_TRUE(parse_storage(with(kVersionOne, "inDegrees=yes", line), "f.sto").in_degrees) << line;
  }
  for (const std::string line : {"inDegrees=no", "inDegrees = No"}) {
    EXPECT_FALSE(parse_storage(with(kVersionOne, "inDegrees=yes", line), "f.sto").in_degrees) << line;
  }
  EXPECT_NE(refusal([] {
              (void)parse_storage(with(kVersionOne, "inDegrees=yes", "inDegrees=maybe"), "f.sto");
            }).find("f.sto:5: inDegrees: found 'maybe'"),
            std::string::npos);
}

TEST(ParseStorage, AnEmptyCellNeverShiftsTheOthers) {
  const std::string head = "x\nendheader\ntime\ta\tb\n";
  EXPECT_NE(
      refusal([&] { (void)parse_storage(head + "0\t\t2\n", "f.sto"); }).find("f.sto:4: expected 3 numbers, found 2"),
      std::string::npos);
  EXPECT_NE(refusal([&] { (void)parse_storage(head + "0\t\t2\t3\t4\n", "f.sto"); }).find("f.sto:4: a cell"),
            std::string::npos);
  const Storage tabs = parse_storage(head + "0\t\t2\t3\n", "f.sto");
  EXPECT_EQ(test::lines_of(tabs.repairs), std::vector<std::size_t>{4});
  EXPECT_EQ(tabs.data.values().row(0), Eigen::RowVector2d(2, 3));
}

TEST(ParseStorage, ACommaInsideANumberIsNoSeparator) {
  const std::string head = "x\nendheader\ntime\ta\tb\n";
  EXPECT_NE(refusal([&] {
              (void)parse_storage(head + "0.5\t1,5\t2.5\n", "f.sto");
            }).find("f.sto:4: expected a number in column 2 ('a'), found '1,5'"),
            std::string::npos);
}

TEST(ParseStorage, AVectorOfTooFewElementsDoesNotBorrowFromTheNext) {
  EXPECT_NE(refusal([] {
              (void)parse_storage(with(kVectors, "1,2,3\t4,5,6", "1,2\t3,4,5,6"), "f.sto");
            }).find("f.sto:6: expected a number"),
            std::string::npos);
}

TEST(ParseStorage, ANumberTooLargeIsNotZero) {
  EXPECT_NE(
      refusal([] { (void)parse_storage(with(kVersionOne, "\t90\t", "\t1e999\t"), "f.sto"); }).find("found '1e999'"),
      std::string::npos);
  EXPECT_EQ(parse_storage(with(kVersionOne, "\t90\t", "\t1e-999\t"), "f.sto").data.values()(0, 0), 0.0);
}

TEST(ParseTrc, CommaDecimalsAreReadAndSaid) {
  const MarkerFile file = parse_trc(with(with(kTrc, "1.5\t2.5", "1,5\t2,5"), "0.01", "0,01"), "f.trc");
  EXPECT_DOUBLE_EQ(file.markers.positions_m(1, 0), 1.5e-3);
  EXPECT_EQ(file.markers.time_s[1], 0.01);
  EXPECT_EQ(test::lines_of(file.repairs), std::vector<std::size_t>{8});
}

TEST(ParseTrc, WithoutTheLineOfAxesTheFirstFrameIsNotLost) {
  const MarkerFile file = parse_trc(with(kTrc, "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n", ""), "f.trc");
  EXPECT_EQ(file.markers.frame_count(), 3);
  EXPECT_EQ(test::repair_lines(file.repairs), "5: the line X1 Y1 Z1 ... is missing\n");
}

TEST(ParseTrc, ARowThatEndsEarlyIsSaidAndTheLastOneOfACutFileLeftOut) {
  const MarkerFile inside = parse_trc(with(kTrc, "1\t0\t1\t2\t3\t4\t5\t6\n", "1\t0\t1\t2\t3\n"), "f.trc");
  EXPECT_TRUE(inside.markers.missing(0, 1));
  EXPECT_EQ(test::lines_of(inside.repairs), std::vector<std::size_t>{7});
  const MarkerFile cut = parse_trc(kTrc.substr(0, kTrc.size() - 4), "f.trc");  // "... 4 5" without the 6
  EXPECT_EQ(cut.markers.frame_count(), 2);
  EXPECT_EQ(test::lines_of(cut.repairs), (std::vector<std::size_t>{3, 9}));  // the larger loss first
}

TEST(ParseTrc, RefusesATimeThatIsNoTimeAndASecondColumnThatIsNone) {
  EXPECT_NE(refusal([] { (void)parse_trc(with(kTrc, "0.01", "nan"), "f.trc"); }).find("f.trc:8: "), std::string::npos);
  EXPECT_NE(refusal([] {
              (void)parse_trc(with(kTrc, "\tTime\t", "\t"), "f.trc");
            }).find("f.trc:4: expected the second column to be 'Time', found 'a'"),
            std::string::npos);
}

TEST(ParseTrc, NumbersWithoutAMarkerAreSaid) {
  EXPECT_EQ(test::lines_of(parse_trc(with(kTrc, "4\t5\t6\n2", "4\t5\t6\t7\n2"), "f.trc").repairs),
            std::vector<std::size_t>{7});
}

TEST(CsvSeries, TakesUnitsFromARowBelowTheHeader) {
  const CsvSeries s = parse_csv_series("time,biceps,angle\nms,[uV],deg\n0,100,180\n1,-50,90\n", "f.csv");
  EXPECT_EQ(s.data.time_s()[1], 1e-3);
  EXPECT_DOUBLE_EQ(s.data.column("biceps")[0], 1e-4);
  EXPECT_EQ(s.data.channels()[1].unit, Unit::radian);
}

TEST(CsvSeries, RefusesAClockInMillimetersAndTwoColumnsOfOneName) {
  EXPECT_NE(refusal([] {
              (void)parse_csv_series("# from the lab\ntime [mm],a\n0,1\n", "f.csv");
            }).find("f.csv:2: column 'time [mm]'"),
            std::string::npos);
  EXPECT_NE(refusal([] { (void)parse_csv_series("time,a,a\n0,1,1\n", "f.csv"); }).find("f.csv:1: two columns"),
            std::string::npos);
}

TEST(ReadEmg, AUnitIsAppliedOnceWhoeverStatesIt) {
  const test::TemporaryFolder folder;
  write_file(folder / "e.csv", "time,biceps [mV],triceps,force [N]\n0,2,3,100\n0.001,2,3,100\n");
  const EmgFile file = read_emg(folder / "e.csv", "mV", false);
  EXPECT_DOUBLE_EQ(file.data.column("biceps")[0], 2e-3);
  EXPECT_DOUBLE_EQ(file.data.column("triceps")[0], 3e-3);
  EXPECT_EQ(file.data.channel_count(), 2);  // newtons are no EMG
  EXPECT_EQ(file.repairs.size(), 2U);
  EXPECT_NE(refusal([&] { (void)read_emg(folder / "e.csv", "", false); }).find("e.csv"), std::string::npos);
}

TEST(ReadEmg, AnUnknownUnitIsNamedWithItsChannel) {
  const test::TemporaryFolder folder;
  for (const std::string unit : {"kV", "V2"}) {
    write_file(folder / "e.csv", fmt::format("time,TRI [V],BIC [{}]\n0,1,2\n0.001,1,3\n", unit));
    const std::string said = refusal([&] { (void)read_emg(folder / "e.csv", "", false); });
    EXPECT_NE(said.find(fmt::format("unit '{}' of channel BIC", unit)), std::string::npos) << said;
  }
  // In small letters or capitals alone the usual unit is meant, as in a C3D file.
  for (const std::string unit : {"millivolt", "millivolts", "Millivolt", "mv", "MV"}) {
    write_file(folder / "e.csv", fmt::format("time,BIC [{}]\n0,2\n0.001,3\n", unit));
    EXPECT_DOUBLE_EQ(read_emg(folder / "e.csv", "", false).data.column("BIC")[0], 2e-3) << unit;
  }
}

TEST(ReadTextFile, TellsTextFromWhatIsNone) {
  const test::TemporaryFolder folder;
  // An odd byte and half of a surrogate pair: no UTF-16.
  for (const std::string& bytes : {std::string("\xFF\xFEP\0a", 5), std::string("\xFF\xFE\0\xD8"
                                                                               "a\0",
                                                                               6)}) {
    write_file(folder / "a.trc", bytes);
    EXPECT_NE(refusal([&] { (void)read_trc(folder / "a.trc"); }).find("UTF-16"), std::string::npos);
  }
  // UTF-16 in both orders without its mark, as some loggers write it.
  const std::string table = "time,BIC [mV]\n0,1\n1,2\n";
  for (const bool low_first : {true, false}) {
    std::string bytes;
    for (const char c : table) bytes += low_first ? std::string{c, '\0'} : std::string{'\0', c};
    write_file(folder / "u.csv", bytes);
    EXPECT_DOUBLE_EQ(read_emg(folder / "u.csv", "", false).data.column("BIC")[1], 2e-3) << low_first;
  }
  write_file(folder / "b.sto", std::string("\x02\x50\0\0", 4));
  EXPECT_NE(refusal([&] { (void)read_storage(folder / "b.sto"); }).find("binary"), std::string::npos);
}

TEST(ReadTextFile, Utf16OfBothByteOrdersIsReadAsWhatItSays) {
  const test::TemporaryFolder folder;
  // a, u with diaeresis, euro, a letter beyond 16 bits (surrogates), in either order of bytes.
  const std::string little(
      "\xFF\xFE"
      "a\0\xFC\0\xAC\x20\x3D\xD8\x00\xDE",
      12);
  std::string big = little;
  for (std::size_t i = 0; i < big.size(); i += 2) std::swap(big[i], big[i + 1]);
  for (const std::string& bytes : {little, big}) {
    write_file(folder / "a.txt", bytes);
    EXPECT_EQ(read_text_file(folder / "a.txt"), "a\xC3\xBC\xE2\x82\xAC\xF0\x9F\x98\x80");
  }
}

TEST(AnyReader, AGermanLocaleChangesNothing) {
  const char* const before = std::setlocale(LC_ALL, nullptr);
  const std::string restore = before != nullptr ? before : "C";
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no locale de_DE.UTF-8 here";
  EXPECT_EQ(parse_storage(kVersionOne, "f.sto").data.values()(1, 0), -15.0);
  EXPECT_EQ(format_number(0.5), "0.5");
  std::setlocale(LC_ALL, restore.c_str());
}

TEST(AnyReader, EveryRecordingOfTheSharedDataReads) {
  const auto root = test::data_folder();
  MYOID_REQUIRE_DATA(root / "trc");
  // Rightly refused: no content, or no marker in it.
  const std::vector<std::string> refused{"Empty.trc", "Truncated.trc", "10002-20130626160334-Unnamed.trc"};
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    const bool odd = std::find(refused.begin(), refused.end(), entry.path().filename().string()) != refused.end();
    if (odd || (extension != ".trc" && extension != ".mot" && extension != ".sto") || entry.file_size() > 2000000)
      continue;
    ++count;
    try {
      if (extension == ".trc") {
        const Eigen::MatrixXd p = read_trc(entry.path()).markers.positions_m;
        EXPECT_GT(p.array().isFinite().count(), 0) << entry.path();
        EXPECT_LT(p.array().isFinite().select(p.array().abs(), 0.0).maxCoeff(), 10.0)
            << entry.path();  // meters: a laboratory's size
      } else {
        EXPECT_GT(read_storage(entry.path()).data.sample_count(), 0) << entry.path();
      }
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GT(count, 100);
}

TEST(ParseTrc, HeaderValuesTwoTabsApartAreReadInTheirOrder) {
  EXPECT_EQ(parse_trc(with(kTrc, "100\t100\t3\t2\tmm\t", "  100.0\t\t  100.0\t\t 3\t\t 2\t\t mm\t "), "f.trc").unit,
            "mm");
  const auto path = test::data_folder() / "gait-emg/markers_walk.trc";
  MYOID_REQUIRE_DATA(path);
  const MarkerFile file = read_trc(path);
  EXPECT_TRUE(file.repairs.empty()) << test::repair_lines(file.repairs);
  EXPECT_DOUBLE_EQ(file.markers.positions_m(0, 0), -0.652630);
}

}  // namespace
}  // namespace myoid::recording
