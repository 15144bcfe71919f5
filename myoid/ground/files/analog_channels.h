#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"

namespace myoid::inline ground {

/// Scale from a stored count to a sample: (count - offset) * scale in the unit as written; times
/// `to_si`, plus `base`, in SI.
struct CountScale {
  double offset = 0.0;
  double scale = 1.0;
  double to_si = 1.0;
  double base = -0.0;  ///< -0.0 changes no number: -0.0 + x is x, even for x = -0.0.
};

/// Times of samples: record r has begin_s[r] + i interval_s, i = 0 .. per_record - 1.
struct RecordClock {
  std::vector<double> begin_s;
  Eigen::Index per_record = 1;
  double interval_s = 0.0;
};

/// Counts as stored in a file, one column a channel.
struct AnalogCounts {
  template <typename T>
  using Columns = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

  std::variant<Columns<std::int16_t>, Columns<std::uint16_t>, Columns<float>> values;
  std::vector<CountScale> scales;
  double first_sample = 0.0;  ///< Without records sample i is at (first_sample + i) / rate_hz.
  double rate_hz = 1.0;
  std::optional<RecordClock> records;  ///< Times of the records, if the file states them.
};

/// The analog channels of a recording in the file's own numbers: 16-bit integers take a quarter of
/// the memory of doubles, reals a half. Only requested samples become doubles in SI.
class AnalogChannels {
 public:
  AnalogChannels() = default;
  /// Takes channels that are doubles.
  AnalogChannels(TimeSeries series);  // NOLINT(google-explicit-constructor): is one of the kinds
  /// Takes counts. Throws InvalidInput unless every column has a name and a scale, the names are
  /// unique and the times of the records increase.
  AnalogChannels(std::vector<Channel> channels, AnalogCounts counts);

  [[nodiscard]] const std::vector<Channel>& channels() const;
  [[nodiscard]] Eigen::Index sample_count() const;
  [[nodiscard]] Eigen::Index channel_count() const { return static_cast<Eigen::Index>(channels().size()); }
  [[nodiscard]] bool empty() const { return sample_count() == 0; }
  [[nodiscard]] std::optional<Eigen::Index> find(std::string_view name) const;

  [[nodiscard]] Eigen::VectorXd time_s() const { return time_s(0, sample_count()); }
  [[nodiscard]] Eigen::VectorXd time_s(Eigen::Index first, Eigen::Index count) const;
  /// Returns all channels as doubles in SI, 8 bytes a sample.
  [[nodiscard]] TimeSeries series() const;
  /// Returns the named channels. Throws InvalidInput listing the available names.
  [[nodiscard]] TimeSeries select(const std::vector<std::string>& names) const;
  /// Returns rows [first, first + count) of these columns, in SI.
  [[nodiscard]] Eigen::MatrixXd rows(Eigen::Index first,
                                     Eigen::Index count,
                                     const std::vector<Eigen::Index>& columns) const;
  /// Returns the columns of the named channels. Throws like `select`.
  [[nodiscard]] std::vector<Eigen::Index> columns_of(const std::vector<std::string>& names) const;
  /// Returns true if no sample is NaN or infinite.
  [[nodiscard]] bool all_finite() const;
  /// Returns columns in the unit as written; channels given as doubles are in SI.
  [[nodiscard]] Eigen::MatrixXd as_written(const std::vector<Eigen::Index>& columns) const;

 private:
  [[nodiscard]] TimeSeries converted(const std::vector<Eigen::Index>& columns) const;

  TimeSeries series_;  ///< Empty if the channels are counts.
  std::vector<Channel> channels_;
  std::optional<AnalogCounts> counts_;
};

}  // namespace myoid::inline ground
