#include "myoid/recording/c3d/c3d_events.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_writer.h"

#include "tests/support/c3d_texts.h"
#include "tests/support/whole_c3d.h"

namespace myoid::recording {
namespace {

C3dFile one_point() {
  C3dFile file;
  file.point_rate_hz = 100.0;
  file.point_unit = "mm";
  file.point_labels = {"only"};
  file.points = C3dFile::Rows::Constant(2, 4, 1.0F);
  return file;
}

TEST(C3dEvents, EventsOfEveryPlaceAreReadOnce) {
  // KINARM: a group EVENTS, whose first number of a pair is not used.
  C3dFile file = one_point();
  C3dGroup events{.id = 41, .name = "EVENTS"};
  events.parameters = {{.name = "USED", .type = C3dType::integer, .numbers = {2}},
                       test::c3d_texts("LABELS", 9, {"TARGET_ON", "GO"}),
                       {.name = "TIMES", .type = C3dType::real, .dimensions = {2, 2}, .numbers = {7, 0.25, 7, 1.5}}};
  file.groups.push_back(events);
  const std::vector<Event> kinarm{{0.25, "TARGET_ON", "", ""}, {1.5, "GO", "", ""}};
  const C3dFile alone = parse_c3d(format_c3d(file), "kinarm.c3d");
  EXPECT_EQ(alone.events, kinarm);
  // Written events are in EVENT too; reading does not double them.
  EXPECT_EQ(parse_c3d(format_c3d(alone), "again.c3d").events, kinarm);
  // Beside a group EVENT, in minutes and seconds.
  file.events = {{90.0, "Lift", "Left", ""}, {0.25, "TARGET_ON", "Right", ""}};
  const C3dFile both = parse_c3d(format_c3d(file), "both.c3d");
  ASSERT_EQ(both.events.size(), 3U);
  EXPECT_EQ(both.events[0], file.events[0]);
  EXPECT_EQ(both.events[1], file.events[1]);
  EXPECT_EQ(both.events[2].label, "GO");
}

TEST(C3dEvents, EventsWithoutTimesAreNamed) {
  C3dFile file = one_point();
  C3dGroup events{.id = 41, .name = "EVENTS"};
  events.parameters = {{.name = "USED", .type = C3dType::integer, .numbers = {2}},
                       test::c3d_texts("LABELS", 9, {"TARGET_ON", "GO"})};
  file.groups.push_back(events);
  const C3dFile back = parse_c3d(format_c3d(file), "timeless.c3d");
  EXPECT_TRUE(back.events.empty());
  EXPECT_TRUE(std::ranges::any_of(
      back.repairs, [](const Repair& repair) { return repair.message == "EVENTS: 2 events have no TIMES; left out"; }));
}

TEST(C3dEvents, TheSectionBehindTheDataIsRead) {
  C3dFile file = one_point();
  auto bytes = format_c3d(file);
  const C3dBytes number{C3dProcessor::intel};
  const std::size_t at = bytes.size();
  number.put_u16(&bytes[294], 12345);
  number.put_u16(&bytes[296], static_cast<std::uint16_t>(at / 512 + 1));
  bytes.resize(at + 512);
  bytes[at] = std::byte{90};
  number.put_u16(&bytes[at + 3], 2);  // events
  number.put_u16(&bytes[at + 5], 4);  // bytes of a label
  for (std::size_t i = 0; i < 2; ++i) {
    std::byte* record = &bytes[at + 11 + i * 13];
    for (std::size_t k = 0; k < 4; ++k) record[k] = static_cast<std::byte>("GO  STOP"[4 * i + k]);
    ASSERT_TRUE(number.put_real(record + 4, i == 0 ? 0.5F : 0.75F));
  }
  const C3dFile back = parse_c3d(bytes, "section.c3d");
  EXPECT_EQ(back.events, (std::vector<Event>{{0.5, "GO", "", ""}, {0.75, "STOP", "", ""}}));
  number.put_u16(&bytes[at + 3], 999);
  const auto repairs = parse_c3d(bytes, "section.c3d").repairs;
  EXPECT_TRUE(std::any_of(repairs.begin(), repairs.end(),
                          [](const Repair& r) { return r.message.find("says 999 events") != std::string::npos; }));
}

}  // namespace
}  // namespace myoid::recording
