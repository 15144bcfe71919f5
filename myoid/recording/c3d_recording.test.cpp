#include "myoid/recording/c3d_recording.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_frames.h"
#include "myoid/recording/c3d/c3d_writer.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

/// A file larger than a part (1 MB), with gaps, an odd number of channels and a late first frame.
C3dFile large_file() {
  C3dFile file;
  file.point_rate_hz = 200.0;
  file.first_frame = 11;
  file.point_unit = "mm";
  file.point_scale = 0.1F;
  file.point_labels = {"A", "B", "C"};
  file.analog_per_frame = 5;
  for (int c = 0; c < 7; ++c) file.channels.push_back({"E" + std::to_string(c), c < 5 ? "mV" : "N", 3.0 * c, 0.25 + c});
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

/// Compares with the numbers that were written, computed here.
TEST(C3dRecording, PartByPartEverySampleIsInItsPlace) {
  const test::TemporaryFolder folder;
  const C3dFile large = large_file();
  for (const auto processor : {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::sgi}) {
    for (const bool integer : {false, true}) {
      SCOPED_TRACE(static_cast<int>(processor) + (integer ? 100 : 0));
      const auto path = folder / "a.c3d";
      write_c3d(path, large, {processor, integer});
      const Recording found = read_c3d_recording(path);
      EXPECT_EQ(found.markers.names, large.point_labels);
      ASSERT_EQ(found.markers.frame_count(), large.points.rows());
      EXPECT_NEAR(found.markers.time_s[0], 10.0 / 200.0, 1e-12);  // its first frame is number 11
      EXPECT_NEAR(found.markers.time_s[70000], 70010.0 / 200.0, 1e-9);
      Eigen::Index wrong = 0;
      for (Eigen::Index i = 0; i < found.markers.frame_count(); ++i) {
        for (Eigen::Index m = 0; m < 3; ++m) {
          const bool missing = large.points(i, 4 * m + 3) < 0.0F;
          if (found.markers.missing(i, m) != missing) ++wrong;
          // Whole steps of 0.1 mm, as reals of 24 bits: up to 3.3 m.
          for (Eigen::Index axis = 0; axis < 3 && !missing; ++axis) {
            const double written_m = 1e-3 * static_cast<double>(large.points(i, 4 * m + axis));
            if (!(std::abs(found.markers.position(i, m)[axis] - written_m) < 1e-6)) ++wrong;
          }
        }
      }
      EXPECT_EQ(wrong, 0);
      const TimeSeries channels = found.analog.series();
      ASSERT_EQ(channels.sample_count(), large.analog.rows());
      EXPECT_NEAR(channels.time_s()[0], 50.0 / 1000.0, 1e-12);
      for (Eigen::Index c = 0; c < 7; ++c) {
        const double to_si = c < 5 ? 1e-3 : 1.0;
        const Eigen::VectorXd expected = (large.analog.col(c).cast<double>().array() - 3.0 * static_cast<double>(c)) *
                                         (0.25 + static_cast<double>(c)) * to_si;
        EXPECT_LT((channels.values().col(c) - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff())
            << c;
      }
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
