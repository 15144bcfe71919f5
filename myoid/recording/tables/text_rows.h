#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/analog_channels.h"
#include "myoid/ground/files/number_text.h"

namespace myoid::recording {

/// Receives the pieces of a text in order.
using TextSink = std::function<void(std::string_view)>;

/// Writes the text of the rows [first, first + count) to `at` and returns the place behind it.
using RowText = std::function<char*(Eigen::Index first, Eigen::Index count, NumberText& numbers, char* at)>;

/// Writes `rows` rows of `cells` numbers each. Blocks of rows are made on as many threads as the
/// program may use and go to `sink` in order. A block has room for NumberText::kRoom bytes and a
/// separator per number. If blocks throw, the exception of the first one is rethrown.
void write_rows(Eigen::Index rows, Eigen::Index cells, const RowText& text, const TextSink& sink);

/// A table that is asked for in blocks of rows, so that it need not fit into memory as doubles.
struct RowSource {
  Eigen::Index rows = 0;
  std::vector<Channel> channels;
  /// Returns times and values (one column a channel) of the rows [first, first + count).
  std::function<void(Eigen::Index first, Eigen::Index count, Eigen::VectorXd& time_s, Eigen::MatrixXd& values)> read;
};

/// Returns the rows of a series or of channels. The source refers to them: they must outlive it.
[[nodiscard]] RowSource rows_of(const TimeSeries& series);
[[nodiscard]] RowSource rows_of(const AnalogChannels& channels);
/// Returns the rows of the named channels. Throws InvalidInput listing the available names.
[[nodiscard]] RowSource rows_of(const AnalogChannels& channels, const std::vector<std::string>& names);

}  // namespace myoid::recording
