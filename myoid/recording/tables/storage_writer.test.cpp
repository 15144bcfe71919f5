#include "myoid/recording/tables/storage_writer.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

/// 30 000 rows of three channels with 16-bit counts, enough for several blocks.
AnalogChannels counted() {
  AnalogCounts counts;
  AnalogCounts::Columns<std::int16_t> values(30'000, 3);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    values.row(i) << static_cast<std::int16_t>((i * 7919) % 65536 - 32768), static_cast<std::int16_t>(i % 100),
        static_cast<std::int16_t>(-i);
  counts.values = values;
  counts.scales = {{.scale = 3.0517578125e-4, .to_si = 1e-6}, {.offset = 50.0, .scale = -0.1}, {}};
  counts.rate_hz = 1500.0;
  return {{{"EMG", Unit::volt}, {"force", Unit::newton}, {"raw"}}, std::move(counts)};
}

TEST(TableWriter, ALongStorageFileReadsBackToTheSameDoubles) {
  const test::TemporaryFolder folder;
  const AnalogChannels channels = counted();
  write_storage(folder / "long.sto", rows_of(channels), {.title = "long"});
  const Storage back = read_storage(folder / "long.sto");
  EXPECT_EQ(back.data.time_s(), channels.time_s());
  EXPECT_EQ(back.data.values(), channels.series().values());
  // Each line consists of the shortest texts of its numbers.
  const std::string text = read_text_file(folder / "long.sto");
  const auto lines = split_lines(text);
  ASSERT_GT(lines.size(), 30'000U);
  for (const std::size_t row : {0U, 1U, 50U, 29'999U}) {
    const auto r = static_cast<Eigen::Index>(row);
    std::string line = format_number(back.data.time_s()[r]);
    for (Eigen::Index c = 0; c < 3; ++c) line += "\t" + format_number(back.data.values()(r, c));
    EXPECT_EQ(lines[lines.size() - 30'000 + row], line);
  }
}

TEST(TableWriter, ATableKeepsItsGaps) {
  const test::TemporaryFolder folder;
  TimeSeries series(Eigen::Vector3d(0.0, 0.1, 0.2), {{"a", Unit::volt}},
                    Eigen::Vector3d(1.0, std::numeric_limits<double>::quiet_NaN(), -0.25));
  write_csv(folder / "gap.csv", rows_of(series), {"made by hand"});
  EXPECT_EQ(read_text_file(folder / "gap.csv"), "# made by hand\ntime_s,a [V]\n0,1\n0.1,\n0.2,-0.25\n");
  EXPECT_TRUE(std::isnan(read_csv_series(folder / "gap.csv").data.values()(1, 0)));
}

TEST(TableWriter, AStorageFileWithAGapIsNotWritten) {
  const test::TemporaryFolder folder;
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(50'000, 2);
  values(49'000, 1) = values(49'500, 0) = std::numeric_limits<double>::infinity();
  const TimeSeries series(Eigen::VectorXd::LinSpaced(50'000, 0.0, 49.999), {{"a"}, {"b"}}, values);
  try {
    write_storage(folder / "gap.sto", rows_of(series), {.title = "gap"});
    FAIL() << "was written";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("channel 'b'"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "a part was left behind";
}

}  // namespace
}  // namespace myoid::recording
