#include "myoid/recording/recorded_day.h"

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/c3d/c3d_writer.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

TEST(RecordedDay, OfAnEdfFileIsItsStart) {
  const test::TemporaryFolder folder;
  const auto day = [&](const std::string& date) {
    write_file(folder / "a.edf", std::string(168, ' ') + date + std::string(100, ' '));
    return recorded_day(folder / "a.edf");
  };
  EXPECT_EQ(day("12.03.25"), "2025-03-12");
  EXPECT_EQ(day("31.12.99"), "1999-12-31");
  EXPECT_EQ(day("01.01.85"), "") << "kept secret";
  EXPECT_EQ(day("31.02.25"), "") << "no such day";
  EXPECT_EQ(day("X       "), "");
}

TEST(RecordedDay, OfAC3dFileIsTheTrialsDate) {
  const test::TemporaryFolder folder;
  C3dFile file;
  file.point_rate_hz = 100.0;
  file.point_unit = "mm";
  file.point_labels = {"A"};
  file.points = C3dFile::Rows::Constant(5, 4, 8.0F);
  file.points.col(3).setZero();
  const auto day = [&] {
    write_c3d(folder / "a.c3d", file);
    return recorded_day(folder / "a.c3d");
  };
  EXPECT_EQ(day(), "");
  C3dGroup trial{.id = 7, .name = "TRIAL"};
  trial.parameters = {{.name = "DATE", .type = C3dType::integer, .dimensions = {3}, .numbers = {2010.0, 3.0, 12.0}}};
  file.groups = {trial};
  EXPECT_EQ(day(), "2010-03-12");
}

TEST(RecordedDay, OfAForeignFileIsRead) {
  const std::filesystem::path file = std::filesystem::path(test::data_folder()) / "c3d/others/1123x01EMG.c3d";
  MYOID_REQUIRE_DATA(file);
  EXPECT_EQ(recorded_day(file), "2010-03-12");
}

TEST(RecordedDay, OfOtherFormatsIsUnsaid) { EXPECT_EQ(recorded_day("none.trc"), ""); }

}  // namespace
}  // namespace myoid::recording
