#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/time_series.h"

namespace myoid::recording {

/// From a stored count to a sample: (count - offset) * scale in the unit as written; in SI times
/// `to_si`, and more by `base`.
struct CountScale {
  double offset = 0.0;
  double scale = 1.0;
  double to_si = 1.0;
  double base = -0.0;  ///< The zero that changes no number: -0.0 + x is x, of -0.0 too.
};

/// Times of samples: those of record r are begin_s[r] + i interval_s, i = 0 .. per_record - 1.
struct RecordClock {
  std::vector<double> begin_s;
  Eigen::Index per_record = 1;
  double interval_s = 0.0;
};

/// Counts as a file holds them, one column for each channel.
struct AnalogCounts {
  template <typename T>
  using Columns = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

  std::variant<Columns<std::int16_t>, Columns<std::uint16_t>, Columns<float>> values;
  std::vector<CountScale> scales;
  double first_sample = 0.0;  ///< Sample i is at (first_sample + i) / rate_hz ...
  double rate_hz = 1.0;
  std::optional<RecordClock> records;  ///< ... unless the records say their own times.
};

/// The analog channels of a recording, kept as compactly as its file holds them: 16-bit integers
/// take a quarter of the memory of doubles, reals a half. What is asked for becomes doubles in SI.
class AnalogChannels {
 public:
  AnalogChannels() = default;
  /// Channels that are doubles already.
  AnalogChannels(TimeSeries series);  // NOLINT(google-explicit-constructor): is one of the kinds
  /// Throws InvalidInput unless every column has a name and a scale, the names are unique and the
  /// times of the records increase.
  AnalogChannels(std::vector<Channel> channels, AnalogCounts counts);

  [[nodiscard]] const std::vector<Channel>& channels() const;
  [[nodiscard]] Eigen::Index sample_count() const;
  [[nodiscard]] Eigen::Index channel_count() const {
    return static_cast<Eigen::Index>(channels().size());
  }
  [[nodiscard]] bool empty() const { return sample_count() == 0; }
  [[nodiscard]] std::optional<Eigen::Index> find(std::string_view name) const;

  [[nodiscard]] Eigen::VectorXd time_s() const { return time_s(0, sample_count()); }
  [[nodiscard]] Eigen::VectorXd time_s(Eigen::Index first, Eigen::Index count) const;
  /// All channels: 8 bytes a sample.
  [[nodiscard]] TimeSeries series() const;
  /// The named channels. Throws InvalidInput listing the names there are.
  [[nodiscard]] TimeSeries select(const std::vector<std::string>& names) const;
  /// Rows [first, first + count) of these columns, in SI.
  [[nodiscard]] Eigen::MatrixXd rows(Eigen::Index first,
                                     Eigen::Index count,
                                     const std::vector<Eigen::Index>& columns) const;
  /// Of the named channels. Throws like `select`.
  [[nodiscard]] std::vector<Eigen::Index> columns_of(const std::vector<std::string>& names) const;
  /// No sample is NaN or infinite.
  [[nodiscard]] bool all_finite() const;
  /// Columns in the unit as written, before they become SI; of channels that were doubles, SI.
  [[nodiscard]] Eigen::MatrixXd as_written(const std::vector<Eigen::Index>& columns) const;

 private:
  [[nodiscard]] TimeSeries converted(const std::vector<Eigen::Index>& columns) const;

  TimeSeries series_;  ///< Empty where there are counts.
  std::vector<Channel> channels_;
  std::optional<AnalogCounts> counts_;
};

}  // namespace myoid::recording
