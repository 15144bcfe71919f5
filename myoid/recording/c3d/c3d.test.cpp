#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/c3d/c3d_description.h"
#include "myoid/recording/c3d/c3d_file.h"
#include "myoid/recording/c3d/c3d_layout.h"
#include "myoid/recording/c3d/c3d_parameters.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_signals.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/c3d/make_c3d.h"

#include "tests/support/c3d_texts.h"
#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_c3d.h"

namespace myoid::recording {
namespace {

/// A small file: 3 markers, one of them missing in frame 2, and 2 channels at twice the rate.
/// Numbers are multiples of the integer step, so that integers hold them too.
C3dFile small_file() {
  C3dFile file;
  file.point_rate_hz = 50.0;
  file.first_frame = 11;
  file.point_unit = "mm";
  file.point_scale = 0.25F;
  file.point_labels = {"A", "B", "Long name with blanks"};
  file.points.resize(4, 12);
  for (Eigen::Index k = 0; k < 4; ++k) {
    for (Eigen::Index m = 0; m < 3; ++m) {
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        file.points(k, 4 * m + axis) =
            0.25F * static_cast<float>(100 * (k + 1) + 10 * m + axis) * (axis == 1 ? -1.0F : 1.0F);
      file.points(k, 4 * m + 3) = k == 1 && m == 2 ? -1.0F : 259.0F;
    }
  }
  file.analog_per_frame = 2;
  file.channels = {{"EMG", "mV", 0.0, 0.5}, {"Fz", "N", 2048.0, -1.5}};
  file.analog.resize(8, 2);
  for (Eigen::Index i = 0; i < 8; ++i) {
    file.analog(i, 0) = static_cast<float>(i * i - 20);
    file.analog(i, 1) = static_cast<float>(2000 + 3 * i);
  }
  file.events = {{1.5, "Foot Strike", "Left", "S1"}, {2.25, "Foot Off", "Right", "S1"}};
  return file;
}

void expect_same(const C3dFile& a, const C3dFile& b) {
  EXPECT_EQ(a.point_labels, b.point_labels);
  EXPECT_EQ(a.point_unit, b.point_unit);
  EXPECT_EQ(a.point_rate_hz, b.point_rate_hz);
  EXPECT_EQ(a.first_frame, b.first_frame);
  EXPECT_EQ(a.analog_per_frame, b.analog_per_frame);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.events, b.events);
  ASSERT_EQ(a.points.rows(), b.points.rows());
  ASSERT_EQ(a.points.cols(), b.points.cols());
  ASSERT_EQ(a.analog.rows(), b.analog.rows());
  ASSERT_EQ(a.analog.cols(), b.analog.cols());
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.analog, b.analog);
}

std::filesystem::path data(const std::string& file) { return test::data_folder() / "c3d" / file; }

bool noted(const std::vector<Repair>& repairs, std::string_view words) {
  for (const Repair& r : repairs) {
    if (r.message.find(words) != std::string::npos) return true;
  }
  return false;
}

TEST(C3d, EveryProcessorAndKindOfSampleHoldsTheSameFile) {
  const C3dFile file = small_file();
  for (const auto processor : {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::sgi}) {
    for (const bool integer : {false, true}) {
      const auto bytes = format_c3d(file, {.processor = processor, .integer = integer});
      EXPECT_EQ(bytes.size() % 512, 0U);
      const C3dFile back = parse_c3d(bytes, "small.c3d");
      EXPECT_EQ(back.processor, processor);
      EXPECT_EQ(back.integer, integer);
      EXPECT_TRUE(back.repairs.empty()) << back.repairs[0].message;
      expect_same(back, file);
    }
  }
}

TEST(C3d, TheSixVariantsOfTheSampleDecodeToTheSameBits) {
  MYOID_REQUIRE_DATA(data(""));
  const C3dFile reference = read_c3d(data("sample01/Eb015pr.c3d"));
  for (const char* name : {"pi", "si", "sr", "vi", "vr"}) {
    SCOPED_TRACE(name);
    const C3dFile file = read_c3d(data(std::string("sample01/Eb015") + name + ".c3d"));
    expect_same(file, reference);
    EXPECT_EQ(file.integer, name[1] == 'i');
  }
  for (const char* name : {"TESTAPI", "TESTBPI", "TESTCPI", "TESTDPI"}) {
    SCOPED_TRACE(name);
    expect_same(read_c3d(data(std::string("sample08/") + name + ".c3d")), reference);
  }
}

TEST(C3d, TheSampleHoldsThePublishedNumbers) {
  MYOID_REQUIRE_DATA(data(""));
  const C3dFile file = read_c3d(data("sample01/Eb015si.c3d"));
  EXPECT_EQ(file.frame_count(), 450);
  EXPECT_EQ(file.point_labels.size(), 26U);
  EXPECT_EQ(file.channels.size(), 16U);
  EXPECT_EQ(file.analog_rate_hz(), 200.0);
  ASSERT_EQ(file.events.size(), 3U);  // in the header, by 4-letter labels
  std::vector<Repair> repairs;
  const MarkerSeries markers = c3d_markers(file, repairs);
  // Published to three decimals of a millimeter.
  EXPECT_NEAR(markers.positions_m(10, 0), 0.250833, 5e-7);
  EXPECT_NEAR(markers.positions_m(10, 1), 0.225833, 5e-7);
  EXPECT_NEAR(markers.positions_m(10, 2), 0.036167, 5e-7);
  EXPECT_EQ(markers.time_s[10], 0.2);
  const TimeSeries analog = c3d_analog(file);
  EXPECT_NEAR(analog.values()(0, 0), -26.66, 1e-3);
  EXPECT_EQ(analog.values()(0, 1), 0.0);
  EXPECT_NEAR(analog.values()(0, 2), -20.832, 1e-3);
  EXPECT_EQ(analog.channels()[0].unit, Unit::newton);
  EXPECT_EQ(analog.channels()[3].unit, Unit::newton_meter);
}

TEST(C3d, EveryFileOfTheCollectionGivesDataAndSurvivesWriting) {
  MYOID_REQUIRE_DATA(data(""));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data(""))) {
    const std::string extension = entry.path().extension().string();
    if (!equal_ignoring_case(extension, ".c3d")) continue;
    SCOPED_TRACE(entry.path().string());
    if (entry.file_size() == 0) {
      EXPECT_THROW(static_cast<void>(read_c3d(entry.path())), ReadError);
      continue;
    }
    C3dFile file = read_c3d(entry.path());
    EXPECT_GT(file.frame_count(), 0);
    const C3dFile back = parse_c3d(format_c3d(file), "back.c3d");
    // A position that is no number becomes a missing one: the only change.
    for (Eigen::Index k = 0; k < file.points.rows(); ++k) {
      for (Eigen::Index p = 0; p < file.points.cols(); p += 4) {
        if (!file.points.block<1, 3>(k, p).allFinite()) file.points.block<1, 4>(k, p) << 0.0F, 0.0F, 0.0F, -1.0F;
      }
    }
    expect_same(back, file);
  }
}

TEST(C3d, MissingAndZeroMarkersAreGapsAndDerivedPointsAreNoMarkers) {
  C3dFile file = small_file();
  file.points(0, 0) = file.points(0, 1) = file.points(0, 2) = 0.0F;
  file.points(3, 5) = std::nanf("");
  C3dGroup group{.id = 1, .name = "POINT"};
  C3dParameter angles{.name = "ANGLES", .type = C3dType::text, .dimensions = {22, 1}};
  angles.text = "Long name with blanks ";
  group.parameters.push_back(angles);
  file.groups.push_back(group);
  std::vector<Repair> repairs;
  const MarkerSeries markers = c3d_markers(file, repairs);
  ASSERT_EQ(markers.names, (std::vector<std::string>{"A", "B"}));
  EXPECT_TRUE(markers.missing(0, 0));
  EXPECT_TRUE(markers.missing(3, 1));
  EXPECT_FALSE(markers.missing(1, 1));
  EXPECT_EQ(markers.time_s[0], 0.2);  // frame 11 at 50 Hz
  EXPECT_TRUE(noted(repairs, "exactly 0 0 0"));
  EXPECT_TRUE(noted(repairs, "angles"));
}

TEST(C3d, AMarkerOfNinesAloneIsMissingAndThisIsSaid) {
  for (const auto& [x, y, missing] : {std::tuple{-9999.0F, -9999.0F, true},
                                      {-999.9F, -999.9F, true},
                                      {999999.0F, 999999.0F, true},
                                      {-9999.0F, 200.0F, false},
                                      {-32768.0F, -32768.0F, false},
                                      {998.0F, 998.0F, false}}) {
    C3dFile file = small_file();
    file.points(1, 0) = file.points(1, 2) = x;
    file.points(1, 1) = y;
    std::vector<Repair> repairs;
    EXPECT_EQ(c3d_markers(file, repairs).missing(1, 0), missing) << x << " " << y;
    EXPECT_EQ(noted(repairs, "nines alone"), missing) << x << " " << y;
  }
}

TEST(C3d, ASubjectsPrefixGoesOnlyWhereTheNamesStayApart) {
  C3dFile file = small_file();
  file.point_labels = {"S1:A", "S1:B", "box:C"};
  std::vector<Repair> repairs;
  EXPECT_EQ(c3d_markers(file, repairs).names, (std::vector<std::string>{"A", "B", "C"}));
  file.point_labels = {"S1:A", "S2:A", "box:C"};
  EXPECT_EQ(c3d_markers(file, repairs).names, file.point_labels);
}

TEST(C3d, MoreThan255NamesAndMoreThan65535FramesComeBack) {
  C3dFile file;
  file.point_rate_hz = 119.88;  // no whole number, and no float either
  file.point_unit = "m";
  const Eigen::Index frames = 70000;
  for (int c = 0; c < 300; ++c) file.channels.push_back({"channel " + std::to_string(c), "V", 0.0, 1.0});
  file.points.resize(frames, 4);
  file.point_labels = {"only"};
  file.analog.resize(frames, 300);
  for (Eigen::Index k = 0; k < frames; ++k) {
    file.points.row(k) << static_cast<float>(k), 1.0F, 2.0F, 0.0F;
    file.analog.row(k).setConstant(static_cast<float>(k) * 0.5F);
  }
  const auto bytes = format_c3d(file);
  C3dFile back = parse_c3d(bytes, "long.c3d");
  EXPECT_NEAR(back.point_rate_hz, file.point_rate_hz, 1e-5);  // 24 bits
  back.point_rate_hz = file.point_rate_hz;
  expect_same(back, file);
}

// The convention of long lists: TIMES2, LABELS2, ... for every further 255.
TEST(C3d, AnyNumberOfEventsComesBack) {
  for (const std::size_t count : {255U, 256U, 511U, 40000U}) {
    C3dFile file = small_file();
    file.events.clear();
    for (std::size_t i = 0; i < count; ++i)
      file.events.push_back(
          {0.25 * static_cast<double>(i), "Strike " + std::to_string(i % 7), i % 2 == 0 ? "Left" : "Right", "S1"});
    const C3dFile back = parse_c3d(format_c3d(file), "events.c3d");
    ASSERT_EQ(back.events.size(), count);
    EXPECT_EQ(back.events, file.events);
    EXPECT_TRUE(back.repairs.empty()) << back.repairs[0].message;
    const C3dParameter* const second = back.find("EVENT", "TIMES2");
    ASSERT_EQ(second != nullptr, count > 255);
    if (count == 256U) {
      EXPECT_EQ(second->dimensions, (std::vector<std::uint8_t>{2, 1}));
    }
    // With fewer events no parameter of the long list remains.
    file.groups = back.groups;
    file.events.resize(3);
    EXPECT_EQ(parse_c3d(format_c3d(file), "fewer.c3d").find("EVENT", "TIMES2"), nullptr);
  }
  C3dFile file = small_file();
  file.events.assign(65536, {0.0, "E", "", ""});
  EXPECT_THROW((void)format_c3d(file), InvalidInput);
}

TEST(C3d, AScaleOfZeroIsNamedWithItsChannel) {
  C3dFile file = small_file();
  file.channels[1].scale = 0.0;
  const C3dFile back = parse_c3d(format_c3d(file), "zero.c3d");
  EXPECT_TRUE(std::ranges::any_of(back.repairs, [](const Repair& repair) {
    return repair.message == "ANALOG:SCALE is 0 for 1 of 2 channels, which read 0 in every sample: Fz";
  }));
}

TEST(C3d, UnsignedSamplesAndOffsetsAreRead) {
  C3dFile file = small_file();
  file.channels[0].offset = 32768.0;
  file.analog.col(0).array() += 40000.0F;
  for (const bool integer : {false, true}) {
    const C3dFile back = parse_c3d(format_c3d(file, {.integer = integer}), "unsigned.c3d");
    expect_same(back, file);
  }
}

TEST(C3d, CountsThatDisagreeAreSettledByTheSizeOfTheFile) {
  const auto good = format_c3d(small_file());
  const auto with_word = [&](std::size_t word, unsigned value) {
    auto bytes = good;
    bytes[2 * (word - 1)] = static_cast<std::byte>(value & 255U);
    bytes[2 * (word - 1) + 1] = static_cast<std::byte>(value >> 8U);
    return bytes;
  };
  // Points, analog samples, last frame, first data block, analog samples a channel.
  for (const auto& [word, value] :
       {std::pair<std::size_t, unsigned>{2, 30}, {3, 70}, {5, 900}, {9, 0}, {9, 9999}, {10, 7}, {10, 0}}) {
    SCOPED_TRACE(word);
    const C3dFile back = parse_c3d(with_word(word, value), "counts.c3d");
    expect_same(back, small_file());
    EXPECT_FALSE(back.repairs.empty());
  }
}

TEST(C3d, AFileCutOffGivesItsWholeFramesWithANote) {
  C3dFile file = small_file();
  file.points = file.points.replicate(50, 1).eval();
  file.analog = file.analog.replicate(50, 1).eval();
  auto bytes = format_c3d(file);
  bytes.resize(bytes.size() - 3000);
  const C3dFile back = parse_c3d(bytes, "cut.c3d");
  EXPECT_TRUE(noted(back.repairs, "cut off"));
  EXPECT_TRUE(back.repairs.back().lost);
  EXPECT_LT(back.frame_count(), 200);
  EXPECT_GT(back.frame_count(), 100);
  EXPECT_EQ(back.points, file.points.topRows(back.frame_count()));
  EXPECT_EQ(back.analog, file.analog.topRows(2 * back.frame_count()));
  bytes.resize(700);
  EXPECT_THROW(static_cast<void>(parse_c3d(bytes, "cut.c3d")), ReadError);
}

TEST(C3d, WithoutParametersTheHeaderSuffices) {
  auto bytes = format_c3d(small_file(), {.processor = C3dProcessor::sgi});
  bytes[0] = std::byte{0};
  std::fill(bytes.begin() + 512, bytes.begin() + 1024, std::byte{0});
  const C3dFile back = parse_c3d(bytes, "bare.c3d");
  EXPECT_EQ(back.points, small_file().points);
  EXPECT_EQ(back.point_labels[2], "point_3");
  EXPECT_TRUE(noted(back.repairs, "parameter section"));
}

TEST(C3d, NoBytesWhateverMakeAnythingButAReadError) {
  const auto good = format_c3d(small_file());
  std::mt19937_64 random(7);
  int read = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    auto bytes = good;
    const int flips = 1 + static_cast<int>(random() % 8);
    for (int i = 0; i < flips; ++i) {
      // Mostly in header and parameters, which hold the structure.
      const std::size_t at = random() % (random() % 4 == 0 ? bytes.size() : 1200);
      bytes[at] = static_cast<std::byte>(random());
    }
    if (random() % 5 == 0) bytes.resize(random() % bytes.size() + 1);
    try {
      const C3dFile file = parse_c3d(bytes, "garbage.c3d");
      std::vector<Repair> repairs;
      if (file.frame_count() > 0 && !marker_columns(file).empty()) {
        try {
          static_cast<void>(c3d_markers(file, repairs));
        } catch (const InvalidInput&) {
        }
      }
      ++read;
    } catch (const ReadError&) {
    }
  }
  EXPECT_GT(read, 1000);  // most damage is not fatal
}

TEST(C3d, AByteSourceGivesTheBytesOfTheFile) {
  const test::TemporaryFolder folder;
  write_c3d(folder / "small.c3d", small_file());
  const auto bytes = format_c3d(small_file());
  ByteSource source(folder / "small.c3d");
  ASSERT_EQ(source.size(), bytes.size());
  const auto part = source.view(500, 20);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), bytes.begin() + 500));
  EXPECT_EQ(read_bytes(folder / "small.c3d"), std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

TEST(C3d, TheHeaderAloneTellsTheProcessor) {
  for (const auto processor : {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::sgi}) {
    const auto bytes = format_c3d(small_file(), {.processor = processor});
    EXPECT_EQ(guess_processor(bytes, bytes.size()), processor);
    EXPECT_EQ(read_c3d_header(bytes, {processor}).points, 3U);
  }
}

TEST(C3d, ParametersComeBackAndDamageCostsNoneThatCanBeRead) {
  C3dGroup group{.id = 5, .name = "MANUFACTURER", .description = "who made it", .locked = true};
  group.parameters = {
      {.name = "COMPANY", .description = "name", .type = C3dType::text, .dimensions = {4}, .text = "Acme"},
      {.name = "VERSION", .locked = true, .type = C3dType::real, .dimensions = {2, 1}, .numbers = {1.5, -2.25}},
      {.name = "YEAR", .type = C3dType::integer, .numbers = {-7}},
      {.name = "FLAGS", .type = C3dType::byte, .dimensions = {3}, .numbers = {0, 128, 255}}};
  for (const auto processor : {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::sgi}) {
    const auto bytes = format_c3d_parameters({group}, {processor});
    std::vector<Repair> repairs;
    EXPECT_EQ(parse_c3d_parameters(bytes, 4, bytes.size(), {processor}, repairs), std::vector{group});
    EXPECT_TRUE(repairs.empty());
    std::size_t year = 0;
    while (static_cast<char>(bytes[year]) != 'Y' || static_cast<char>(bytes[year + 1]) != 'E') ++year;
    // The distance behind YEAR swapped, leading out of the section, into a value, to the begin of
    // its own values; 0 says that YEAR is the last record.
    for (const unsigned distance : {0x0700U, 0xFFFFU, 0x20U, 2U, 0U}) {
      auto changed = bytes;
      C3dBytes{processor}.put_u16(&changed[year + 4], static_cast<std::uint16_t>(distance));
      repairs.clear();
      EXPECT_EQ(parse_c3d_parameters(changed, 4, changed.size(), {processor}, repairs), std::vector{group}) << distance;
      EXPECT_TRUE(noted(repairs, "damaged at")) << distance;
    }
    // A name that is no text: only YEAR is lost.
    auto changed = bytes;
    changed[year] = std::byte{1};
    repairs.clear();
    C3dGroup rest = group;
    rest.parameters.erase(rest.parameters.begin() + 2);
    EXPECT_EQ(parse_c3d_parameters(changed, 4, changed.size(), {processor}, repairs), std::vector{rest});
    EXPECT_TRUE(noted(repairs, "next record"));
  }
}

TEST(C3d, AUnitThatItsFieldCutsShortIsCompleted) {
  for (const auto& [text, to_m] :
       {std::pair{"mete", 1.0}, {"MET", 1.0}, {"millim", 1e-3}, {"mil", 1e-3}, {"centim", 1e-2}}) {
    C3dFile file = small_file();
    file.point_unit = text;
    const C3dFile back = parse_c3d(format_c3d(file), "cut.c3d");
    EXPECT_TRUE(noted(back.repairs, "cut short")) << text;
    std::vector<Repair> repairs;
    EXPECT_DOUBLE_EQ(c3d_markers(back, repairs).positions_m(0, 0), to_m * static_cast<double>(file.points(0, 0)))
        << text;
  }
  C3dFile file = small_file();
  file.point_unit = "furlong";
  EXPECT_EQ(parse_c3d(format_c3d(file), "unit.c3d").point_unit, "furlong");
}

TEST(C3d, MIsReadAsMillimetersOnlyWhereNoLaboratoryIsLongEnough) {
  C3dFile file = small_file();
  file.point_unit = "m";
  // Its points lie 5 apart: a room of 5 m.
  const C3dFile room = parse_c3d(format_c3d(file), "m.c3d");
  EXPECT_EQ(room.point_unit, "m");
  EXPECT_TRUE(room.repairs.empty());
  for (Eigen::Index c = 0; c < 12; c += 4) file.points.middleCols(c, 3) *= 40.0F;
  const C3dFile cut = parse_c3d(format_c3d(file), "m.c3d");
  EXPECT_EQ(cut.point_unit, "mm");
  EXPECT_TRUE(noted(cut.repairs, "distance"));
}

TEST(C3d, PosesOfSegmentsAloneAreToldByNameWithTheRemedy) {
  C3dFile file = small_file();
  C3dGroup rotation{.id = 40, .name = "ROTATION"};
  rotation.parameters = {{.name = "USED", .type = C3dType::integer, .numbers = {2}},
                         test::c3d_texts("LABELS", 10, {"pelvis_4X4", "r_arm_4X4"})};
  file.groups.push_back(rotation);
  const C3dFile beside = parse_c3d(format_c3d(file), "both.c3d");
  EXPECT_EQ(beside.points, file.points);
  EXPECT_TRUE(noted(beside.repairs, "2 segments (group ROTATION: pelvis_4X4, r_arm_4X4)"));
  // Without points and channels the file holds nothing else.
  C3dFile poses;
  poses.groups = {rotation};
  const C3dHeader header{.first_frame = 1, .last_frame = 4, .data_block = 3, .rate_hz = 100.0F};
  try {
    static_cast<void>(find_c3d_layout(header, poses, 4096, "theia.c3d", poses.repairs));
    FAIL() << "no error";
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("theia.c3d"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("make landmarks"), std::string::npos);
  }
}

TEST(C3d, TextOfUnknownOriginBecomesUtf8) {
  EXPECT_EQ(to_utf8("Muskel \xB5V"), "Muskel µV");
  EXPECT_EQ(to_utf8("µV  "), "µV");
  EXPECT_EQ(to_utf8("a\x01"
                    "b"),
            "a b");
  EXPECT_EQ(parse_file_unit("\xB5V")->to_si, 1e-6);
  EXPECT_EQ(parse_file_unit("ntmm")->unit, Unit::newton_meter);
  // A N m is 1000 N mm, 100 N cm, a thousandth of a kN m.
  for (const auto& [word, to_si] : {std::pair{"Nmm", 1e-3},
                                    {"N·mm", 1e-3},
                                    {"N.cm", 1e-2},
                                    {"kNm", 1e3},
                                    {"N\u22c5m", 1.0},
                                    {"kgf*m", kStandardGravity}}) {
    ASSERT_TRUE(parse_file_unit(word)) << word;
    EXPECT_EQ(*parse_file_unit(word), (ScaledUnit{Unit::newton_meter, to_si})) << word;
  }
  EXPECT_FALSE(parse_file_unit("d.u."));
}

TEST(C3d, TheReaderOfFilesAndTheReaderOfMemoryAgree) {
  const test::TemporaryFolder folder;
  const auto path = folder / "small.c3d";
  write_c3d(path, small_file());
  expect_same(read_c3d(path), small_file());
  EXPECT_THROW(static_cast<void>(read_c3d(folder / "none.c3d")), ReadError);
  EXPECT_THROW(static_cast<void>(read_c3d(folder.path())), ReadError);
}

// 240 frames a second with times in ms step by 4 and 5 ms.
TEST(MakeC3d, RoundedTimesAreEvenAndALostFrameIsNot) {
  MarkerSeries markers;
  markers.names = {"a"};
  markers.time_s.resize(100);
  for (Eigen::Index k = 0; k < 100; ++k)
    markers.time_s[k] = std::round(1000.0 * static_cast<double>(k) / 240.0) / 1000.0;
  markers.positions_m = Eigen::MatrixXd::Constant(100, 3, 0.1);
  EXPECT_EQ(make_c3d(markers, TimeSeries()).point_rate_hz, 240.0);
  for (Eigen::Index k = 50; k < 100; ++k) markers.time_s[k] += 0.004;
  EXPECT_THROW((void)make_c3d(markers, TimeSeries()), InvalidInput);
}

TEST(C3d, MarkersAndAnalogMadeIntoAFileComeBackInSi) {
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(5, 1.0, 1.04);
  markers.names = {"M"};
  markers.positions_m.resize(5, 3);
  markers.positions_m.setConstant(0.5);
  markers.positions_m.row(2).setConstant(std::nan(""));
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(50, 2, 0.25);
  const TimeSeries analog(Eigen::VectorXd::LinSpaced(50, 1.0, 1.049), {{"EMG", Unit::volt}, {"M", Unit::newton_meter}},
                          values);
  const C3dFile back = parse_c3d(format_c3d(make_c3d(markers, analog)), "made.c3d");
  std::vector<Repair> repairs;
  const MarkerSeries m = c3d_markers(back, repairs);
  EXPECT_NEAR(m.time_s[4], 1.04, 1e-12);
  EXPECT_EQ(m.positions_m(0, 1), 0.5);
  EXPECT_TRUE(m.missing(2, 0));
  const TimeSeries a = c3d_analog(back);
  EXPECT_EQ(a.sample_count(), 50);
  EXPECT_NEAR(a.time_s()[49], 1.049, 1e-12);
  EXPECT_EQ(a.values(), values);  // 250 N mm and 0.25 V are exact in 32 bits, 1e-3 * 250 in 64
  EXPECT_EQ(a.channels(), analog.channels());
}

}  // namespace
}  // namespace myoid::recording
