#include "myoid/recording/c3d_recording.h"

#include <gtest/gtest.h>

#include "myoid/recording/c3d_frames.h"
#include "myoid/recording/c3d_reader.h"
#include "myoid/recording/c3d_signals.h"
#include "myoid/recording/c3d_writer.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

/// Larger than a part (1 MB), with gaps, a plate's worth of odd counts and another first frame.
C3dFile large_file() {
  C3dFile file;
  file.point_rate_hz = 200.0;
  file.first_frame = 11;
  file.point_unit = "mm";
  file.point_scale = 0.1F;
  file.point_labels = {"A", "B", "C"};
  file.analog_per_frame = 5;
  for (int c = 0; c < 7; ++c)
    file.channels.push_back({"E" + std::to_string(c), c < 5 ? "mV" : "N", 3.0 * c, 0.25 + c});
  const Eigen::Index frames = 70001;
  file.points.resize(frames, 12);
  file.analog.resize(5 * frames, 7);
  unsigned state = 1;
  const auto next = [&] {
    state = state * 1664525U + 1013904223U;
    return static_cast<float>(static_cast<int>(state >> 16U) - 32768);
  };
  for (Eigen::Index i = 0; i < file.points.size(); ++i)
    file.points.data()[i] = i % 4 == 3 ? (i % 28 == 27 ? -1.0F : 0.0F) : 0.1F * next();
  for (Eigen::Index i = 0; i < file.analog.size(); ++i) file.analog.data()[i] = next();
  return file;
}

/// The same recording by two ways: the table of the whole file and what is made of it, and part by
/// part from the bytes.
TEST(C3dRecording, PartByPartGivesWhatTheWholeTableGives) {
  const test::TemporaryFolder folder;
  const C3dFile large = large_file();
  for (const auto processor : {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::sgi}) {
    for (const bool integer : {false, true}) {
      SCOPED_TRACE(static_cast<int>(processor) + (integer ? 100 : 0));
      const auto path = folder / "a.c3d";
      write_c3d(path, large, {processor, integer});
      const C3dFile table = read_c3d(path);
      std::vector<Repair> repairs = table.repairs;
      const MarkerSeries markers = c3d_markers(table, repairs);
      const TimeSeries analog = c3d_analog(table);
      const Recording found = read_c3d_recording(path);
      EXPECT_EQ(found.markers.names, markers.names);
      EXPECT_EQ(found.markers.time_s, markers.time_s);
      // NaN is not equal to itself: compare the bits.
      ASSERT_EQ(found.markers.positions_m.size(), markers.positions_m.size());
      EXPECT_EQ(std::memcmp(found.markers.positions_m.data(), markers.positions_m.data(),
                            sizeof(double) * static_cast<std::size_t>(markers.positions_m.size())),
                0);
      const TimeSeries channels = found.analog.series();
      EXPECT_EQ(channels.channels(), analog.channels());
      EXPECT_EQ(channels.time_s(), analog.time_s());
      EXPECT_EQ(channels.values(), analog.values());
      EXPECT_EQ(found.repairs.size(), repairs.size());
    }
  }
}

TEST(C3dRecording, UnsignedCountsReachBeyondTheSign) {
  const test::TemporaryFolder folder;
  C3dFile file;
  file.point_rate_hz = 100.0;
  file.point_unit = "mm";
  file.channels = {{"E", "V", 32768.0, 0.5}};
  file.analog.resize(3, 1);
  file.analog << 0.0F, 32768.0F, 65535.0F;
  file.points.resize(3, 0);
  C3dGroup group{1, "ANALOG", "", false, {}};
  group.parameters.push_back({"FORMAT", "", false, C3dType::text, {8}, "UNSIGNED", {}});
  file.groups = {group};
  write_c3d(folder / "a.c3d", file, {C3dProcessor::intel, true});
  std::vector<bool> has_unit;
  const Recording found = read_c3d_channels(folder / "a.c3d", has_unit);
  EXPECT_EQ(found.analog.series().values(), Eigen::Vector3d(-16384.0, 0.0, 16383.5));
  EXPECT_EQ(has_unit, std::vector<bool>{true});
  std::string unit;
  EXPECT_EQ(read_c3d_markers(folder / "a.c3d", unit).markers.frame_count(), 0);
  EXPECT_EQ(unit, "mm");
}

}  // namespace
}  // namespace myoid::recording
