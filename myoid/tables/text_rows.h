#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/time_series.h"
#include "myoid/files/analog_channels.h"
#include "myoid/files/number_text.h"

namespace myoid::recording {

/// Where pieces of a text go, one after the other.
using TextSink = std::function<void(std::string_view)>;

/// Text of the rows [first, first + count), written at `at`; returns the place behind it.
using RowText =
    std::function<char*(Eigen::Index first, Eigen::Index count, NumberText& numbers, char* at)>;

/// Writes the text of `rows` rows of `cells` numbers each, in blocks that are made on as many
/// threads as there may be and go to `sink` in order. There is room for NumberText::kRoom bytes a
/// number and a separator behind it. What is thrown for a block comes from the first block that
/// throws.
void write_rows(Eigen::Index rows, Eigen::Index cells, const RowText& text, const TextSink& sink);

/// A table that is asked for in blocks of rows, so that it need not stand in memory as doubles.
struct RowSource {
  Eigen::Index rows = 0;
  std::vector<Channel> channels;
  /// Times and values (a column for each channel) of the rows [first, first + count).
  std::function<void(
      Eigen::Index first, Eigen::Index count, Eigen::VectorXd& time_s, Eigen::MatrixXd& values)>
      read;
};

/// The rows of a series or of channels, to which the source refers: they must outlive it.
[[nodiscard]] RowSource rows_of(const TimeSeries& series);
[[nodiscard]] RowSource rows_of(const AnalogChannels& channels);
/// Of the named channels alone. Throws InvalidInput listing the names there are.
[[nodiscard]] RowSource rows_of(const AnalogChannels& channels,
                                const std::vector<std::string>& names);

}  // namespace myoid::recording
