#include "myoid/recording/tables/text_rows.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/ground/files/text_file.h"

namespace myoid::recording {
namespace {

using Limit = oneapi::tbb::global_control;

/// Rows "r r r ...", one number a cell.
RowText numbers_of_the_row(Eigen::Index cells) {
  return [cells](Eigen::Index first, Eigen::Index count, NumberText& numbers, char* at) {
    for (Eigen::Index row = first; row < first + count; ++row) {
      for (Eigen::Index c = 0; c < cells; ++c) {
        at = numbers.put(at, static_cast<double>(row));
        *at++ = c + 1 < cells ? ' ' : '\n';
      }
    }
    return at;
  };
}

TEST(TextRows, StandInOrderWhateverTheBlocksAndThreads) {
  for (const std::size_t threads : {1, 3}) {
    const Limit limit(Limit::max_allowed_parallelism, threads);
    for (const Eigen::Index cells : {1, 7, 40'000}) {
      const Eigen::Index rows = cells > 1000 ? 9 : 100'000;
      std::string text;
      write_rows(rows, cells, numbers_of_the_row(cells), [&](std::string_view t) { text += t; });
      const std::vector<std::string_view> lines = split_lines(text);
      ASSERT_EQ(static_cast<Eigen::Index>(lines.size()), rows);
      for (std::size_t r = 0; r < lines.size(); ++r)
        ASSERT_TRUE(lines[r].starts_with(std::to_string(r))) << r << ": " << lines[r].substr(0, 20);
      EXPECT_EQ(split_words(lines.back()).size(), static_cast<std::size_t>(cells));
    }
  }
  int pieces = 0;
  write_rows(0, 3, numbers_of_the_row(3), [&](std::string_view) { ++pieces; });
  EXPECT_EQ(pieces, 0);
}

TEST(TextRows, TheFirstBlockThatThrowsIsHeardAndWhatIsBeforeItWasWritten) {
  const Limit limit(Limit::max_allowed_parallelism, 3);
  for (int again = 0; again < 5; ++again) {
    std::string text;
    const RowText spoiled = [&](Eigen::Index first, Eigen::Index count, NumberText& n, char* at) {
      if (first + count > 60'000) throw std::runtime_error(std::to_string(first));
      return numbers_of_the_row(1)(first, count, n, at);
    };
    try {
      write_rows(200'000, 1, spoiled, [&](std::string_view t) { text += t; });
      FAIL() << "was written";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(split_lines(text).size(), std::stoul(error.what()));
    }
  }
}

TEST(RowSource, OfCountsIsThatOfTheirSeries) {
  AnalogCounts counts;
  AnalogCounts::Columns<std::int16_t> values(4, 3);
  values << 1, 2, 3, -4, 5, 6, 7, -8, 9, 10, 11, 12;
  counts.values = values;
  counts.scales = {{.offset = 2.0, .scale = 0.1, .to_si = 1e-3}, {.scale = 3.0, .base = 0.7}, {}};
  counts.records = RecordClock{.begin_s = {0.0, 2.5}, .per_record = 2, .interval_s = 0.5};
  const AnalogChannels channels({{"a", Unit::volt}, {"b"}, {"c"}}, counts);
  const TimeSeries series = channels.series();
  EXPECT_EQ(series.time_s(), Eigen::Vector4d(0.0, 0.5, 2.5, 3.0));
  EXPECT_EQ(series.values()(1, 0), (-4.0 - 2.0) * 0.1 * 1e-3);
  EXPECT_EQ(series.values()(2, 1), 0.7 + 3.0 * -8.0);
  const RowSource rows = rows_of(channels, {"c", "a"});
  ASSERT_EQ(rows.channels.size(), 2U);
  EXPECT_EQ(rows.channels[0].name, "c");
  Eigen::VectorXd time_s, of_series_s;
  Eigen::MatrixXd read, of_series;
  rows.read(1, 2, time_s, read);
  rows_of(series).read(1, 2, of_series_s, of_series);
  EXPECT_EQ(time_s, of_series_s);
  EXPECT_EQ(read.col(0), of_series.col(2));
  EXPECT_EQ(read.col(1), of_series.col(0));
}

}  // namespace
}  // namespace myoid::recording
