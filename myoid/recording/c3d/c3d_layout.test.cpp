#include "myoid/recording/c3d/c3d_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_writer.h"

#include "tests/support/whole_c3d.h"

namespace myoid::recording {
namespace {

/// One point and few frames, so that the padding of the last block hides the number of frames.
C3dFile frames_from(std::int64_t first, Eigen::Index count) {
  C3dFile file;
  file.point_rate_hz = 100.0;
  file.first_frame = first;
  file.point_unit = "mm";
  file.point_labels = {"only"};
  file.points.resize(count, 4);
  for (Eigen::Index k = 0; k < count; ++k) file.points.row(k) << static_cast<float>(k), 2, 3, 0;
  return file;
}

TEST(C3dLayout, AFewFramesComeBackWhereverTheyBegin) {
  for (const std::int64_t first : {1, 2, 65533, 65534, 65535, 65536, 70000, 200000}) {
    for (const Eigen::Index count : {1, 3}) {
      SCOPED_TRACE(testing::Message() << count << " from " << first);
      const C3dFile file = frames_from(first, count);
      const C3dFile back = parse_c3d(format_c3d(file), "late.c3d");
      EXPECT_EQ(back.first_frame, first);
      EXPECT_EQ(back.points, file.points);
      EXPECT_TRUE(back.repairs.empty()) << back.repairs[0].message;
    }
  }
}

TEST(C3dLayout, AHeaderThatWrapsItsFramesGivesWayToTheActualOnes) {
  auto bytes = format_c3d(frames_from(70000, 3));
  const auto set_word = [&](std::size_t word, unsigned value) {
    bytes[2 * (word - 1)] = static_cast<std::byte>(value & 255U);
    bytes[2 * (word - 1) + 1] = static_cast<std::byte>(value >> 8U);
  };
  set_word(4, 70000 - 65536);
  set_word(5, 70002 - 65536);
  const C3dFile back = parse_c3d(bytes, "wrapped.c3d");
  EXPECT_EQ(back.first_frame, 70000);
  EXPECT_EQ(back.frame_count(), 3);
}

/// The rule itself: a header of one point, a parameter TRIAL:ACTUAL_START_FIELD and _END_FIELD.
C3dLayout layout_of(std::int64_t header_last,
                    std::int64_t actual_last,
                    std::uint64_t data_bytes,
                    std::vector<Repair>& repairs) {
  C3dFile file = parse_c3d(format_c3d(frames_from(65534, actual_last - 65533)), "actual.c3d");
  C3dHeader header;
  header.points = 1;
  header.first_frame = 65534;
  header.last_frame = header_last;
  header.scale = -1.0F;
  header.data_block = static_cast<std::size_t>(number_at(file.find("POINT", "DATA_START"), 0).value_or(3.0));
  header.rate_hz = 100.0F;
  return find_c3d_layout(header, file, (header.data_block - 1) * 512 + data_bytes, "f.c3d", repairs);
}

TEST(C3dLayout, TheSizeOfTheFileHasTheLastWordAndTheNoteNamesWhoIsBelieved) {
  std::vector<Repair> repairs;
  // 16 bytes a frame. TRIAL says 67 frames, which 512 bytes cannot hold; the header says 2.
  const C3dLayout small = layout_of(65535, 65600, 512, repairs);
  EXPECT_EQ(small.frames, 2);
  ASSERT_FALSE(repairs.empty());
  EXPECT_THAT(repairs[0].message, testing::HasSubstr("ACTUAL_END_FIELD says 67 frames"));
  repairs.clear();
  EXPECT_EQ(layout_of(65535, 65600, 1536, repairs).frames, 67);
}

}  // namespace
}  // namespace myoid::recording
