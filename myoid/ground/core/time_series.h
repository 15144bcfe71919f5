#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/units.h"

namespace myoid::inline ground {

struct Channel {
  std::string name;
  Unit unit = Unit::dimensionless;
  /// The number that stands for a missing value in the file; the samples are NaN.
  std::optional<double> missing = std::nullopt;

  friend bool operator==(const Channel&, const Channel&) = default;
};

/// Samples of several channels on one clock. Rows are samples, columns are channels.
/// Invariant: `time_s` strictly increases and is finite; `values` has time_s.size() rows and channels.size() columns;
/// channel names are unique and not empty. Values may be NaN (a gap) only between `recording` and `signals`.
class TimeSeries {
 public:
  TimeSeries() = default;

  /// Throws InvalidInput if the invariant does not hold, naming the offending row or channel.
  TimeSeries(Eigen::VectorXd time_s, std::vector<Channel> channels, Eigen::MatrixXd values);

  [[nodiscard]] const Eigen::VectorXd& time_s() const { return time_s_; }
  [[nodiscard]] const std::vector<Channel>& channels() const { return channels_; }
  [[nodiscard]] const Eigen::MatrixXd& values() const { return values_; }

  [[nodiscard]] Eigen::Index sample_count() const { return time_s_.size(); }
  [[nodiscard]] Eigen::Index channel_count() const { return values_.cols(); }
  [[nodiscard]] bool empty() const { return time_s_.size() == 0; }

  /// Returns the column of the channel of this name; empty if there is none.
  [[nodiscard]] std::optional<Eigen::Index> find(std::string_view name) const;

  /// Returns the column of the channel of this name. Throws InvalidInput listing the names there are.
  [[nodiscard]] Eigen::Index index(std::string_view name) const;

  /// Samples of one channel. Throws like `index`.
  [[nodiscard]] Eigen::VectorXd column(std::string_view name) const;

  /// Returns the mean sampling interval [s]; 0 with fewer than two samples.
  [[nodiscard]] double mean_interval_s() const;

  /// Returns 1 / mean_interval_s; 0 with fewer than two samples.
  [[nodiscard]] double mean_rate_hz() const;

  /// Returns true if no interval departs from the mean by more than `tolerance` of it.
  [[nodiscard]] bool is_uniform(double tolerance = 1e-3) const;

  /// Rows with start_s <= time <= end_s.
  [[nodiscard]] TimeSeries slice(double start_s, double end_s) const;

  /// Returns the named channels, in the order asked for. Throws like `index`.
  [[nodiscard]] TimeSeries select(const std::vector<std::string>& names) const;

 private:
  Eigen::VectorXd time_s_;
  std::vector<Channel> channels_;
  Eigen::MatrixXd values_;
};

/// Returns "a, b, c" of the channel names, for messages; cut with "..." after `most`.
[[nodiscard]] std::string channel_names(const TimeSeries& series, std::size_t most = 30);

/// Throws InvalidInput unless every channel carries `unit`; `what` names the series in the message.
void require_unit(const TimeSeries& series, Unit unit, std::string_view what);

/// Returns ", where the file has -9999, which stands for a missing value", for a message about a gap; else "".
[[nodiscard]] std::string gap_text(const Channel& channel);

/// Throws InvalidInput, naming channel and time, if a value is NaN or infinite.
void require_finite(const TimeSeries& series, std::string_view what);

}  // namespace myoid::inline ground
