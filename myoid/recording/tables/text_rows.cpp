#include "myoid/recording/tables/text_rows.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <numeric>
#include <utility>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include "myoid/ground/core/index.h"
#include "myoid/ground/core/parallel_in_order.h"

namespace myoid::recording {
namespace {

constexpr Eigen::Index kBlockNumbers = 16'384;
constexpr std::size_t kBlocksUnderWay = 8;

/// A block between the thread that makes it and the sink.
struct Block {
  std::unique_ptr<char[]> text;
  std::size_t size = 0;
  std::exception_ptr fault;
};

RowSource rows_of_columns(const AnalogChannels& channels, std::vector<Eigen::Index> columns) {
  RowSource source{channels.sample_count(), {}, {}};
  for (const Eigen::Index column : columns) source.channels.push_back(channels.channels()[at(column)]);
  source.read = [&channels, columns = std::move(columns)](Eigen::Index first, Eigen::Index count,
                                                          Eigen::VectorXd& time_s, Eigen::MatrixXd& values) {
    time_s = channels.time_s(first, count);
    values = channels.rows(first, count, columns);
  };
  return source;
}

}  // namespace

void write_rows(Eigen::Index rows, Eigen::Index cells, const RowText& text, const TextSink& sink) {
  const Eigen::Index in_block =
      std::clamp<Eigen::Index>(kBlockNumbers / std::max<Eigen::Index>(1, cells), 1, std::max<Eigen::Index>(1, rows));
  const auto count = static_cast<std::size_t>((rows + in_block - 1) / in_block);
  const std::size_t room = static_cast<std::size_t>(in_block * cells) * (NumberText::kRoom + 1) + NumberText::kRoom;
  const auto numbers = static_cast<std::size_t>(rows * cells);
  oneapi::tbb::enumerable_thread_specific<NumberText> kept([&] { return NumberText(numbers); });
  std::vector<Block> blocks(kBlocksUnderWay);
  const auto make = [&](std::size_t i, std::size_t slot) {
    Block& block = blocks[slot];
    if (!block.text) block.text = std::make_unique_for_overwrite<char[]>(room);
    const Eigen::Index first = static_cast<Eigen::Index>(i) * in_block;
    try {
      char* const end = text(first, std::min(in_block, rows - first), kept.local(), block.text.get());
      block.size = static_cast<std::size_t>(end - block.text.get());
    } catch (...) {
      block.fault = std::current_exception();
    }
  };
  const auto take = [&](std::size_t, std::size_t slot) {
    if (blocks[slot].fault) std::rethrow_exception(blocks[slot].fault);
    sink({blocks[slot].text.get(), blocks[slot].size});
  };
  parallel_in_order(count, blocks.size(), make, take);
}

RowSource rows_of(const TimeSeries& series) {
  return {series.sample_count(), series.channels(),
          [&series](Eigen::Index first, Eigen::Index count, Eigen::VectorXd& time_s, Eigen::MatrixXd& values) {
            time_s = series.time_s().segment(first, count);
            values = series.values().middleRows(first, count);
          }};
}

RowSource rows_of(const AnalogChannels& channels) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(channels.channel_count()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return rows_of_columns(channels, std::move(all));
}

RowSource rows_of(const AnalogChannels& channels, const std::vector<std::string>& names) {
  return rows_of_columns(channels, channels.columns_of(names));
}

}  // namespace myoid::recording
