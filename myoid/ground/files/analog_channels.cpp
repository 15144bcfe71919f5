#include "myoid/ground/files/analog_channels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground {
namespace {

Eigen::Index rows_of(const AnalogCounts& counts) {
  return std::visit([](const auto& values) { return values.rows(); }, counts.values);
}

/// Converts rows [first, first + count) of one column.
template <typename Out>
void convert(
    const AnalogCounts& counts, Eigen::Index column, Eigen::Index first, Eigen::Index count, bool to_si, Out&& out) {
  const CountScale& scale = counts.scales[static_cast<std::size_t>(column)];
  std::visit(
      [&](const auto& values) {
        const auto stored = values.col(column).segment(first, count).template cast<double>().array();
        if (to_si) {
          out = (scale.base + (stored - scale.offset) * scale.scale * scale.to_si).matrix();
        } else {
          out = ((stored - scale.offset) * scale.scale).matrix();
        }
      },
      counts.values);
}

double time_of(const RecordClock& clock, Eigen::Index sample) {
  return clock.begin_s[static_cast<std::size_t>(sample / clock.per_record)] +
         static_cast<double>(sample % clock.per_record) * clock.interval_s;
}

void require_times(const RecordClock& clock, Eigen::Index samples) {
  if (static_cast<Eigen::Index>(clock.begin_s.size()) * clock.per_record != samples)
    throw InvalidInput("{} records of {} samples for {} samples", clock.begin_s.size(), clock.per_record, samples);
  for (Eigen::Index i = 1; i < samples; ++i) {
    if (!(time_of(clock, i) > time_of(clock, i - 1)))
      throw InvalidInput("time does not increase: {} s after {} s", time_of(clock, i), time_of(clock, i - 1));
  }
}

}  // namespace

AnalogChannels::AnalogChannels(TimeSeries series) : series_(std::move(series)) {}

AnalogChannels::AnalogChannels(std::vector<Channel> channels, AnalogCounts counts)
    : channels_(std::move(channels)), counts_(std::move(counts)) {
  const auto columns =
      static_cast<std::size_t>(std::visit([](const auto& values) { return values.cols(); }, counts_->values));
  if (columns != channels_.size() || columns != counts_->scales.size() || !(counts_->rate_hz > 0.0)) {
    throw InvalidInput("{} columns of counts, {} channels, {} scales, {} Hz", columns, channels_.size(),
                       counts_->scales.size(), counts_->rate_hz);
  }
  if (counts_->records) require_times(*counts_->records, rows_of(*counts_));
  // Names follow the rules of a TimeSeries.
  static_cast<void>(TimeSeries(Eigen::VectorXd::Zero(1), channels_,
                               Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(channels_.size()))));
}

const std::vector<Channel>& AnalogChannels::channels() const { return counts_ ? channels_ : series_.channels(); }

Eigen::Index AnalogChannels::sample_count() const { return counts_ ? rows_of(*counts_) : series_.sample_count(); }

std::optional<Eigen::Index> AnalogChannels::find(std::string_view name) const {
  const std::vector<Channel>& list = channels();
  const auto it = std::find_if(list.begin(), list.end(), [&](const Channel& c) { return c.name == name; });
  if (it == list.end()) return std::nullopt;
  return static_cast<Eigen::Index>(it - list.begin());
}

Eigen::VectorXd AnalogChannels::time_s(Eigen::Index first, Eigen::Index count) const {
  if (!counts_) return series_.time_s().segment(first, count);
  Eigen::VectorXd time(count);
  for (Eigen::Index i = 0; i < count; ++i)
    time[i] = counts_->records ? time_of(*counts_->records, first + i)
                               : (counts_->first_sample + static_cast<double>(first + i)) / counts_->rate_hz;
  return time;
}

Eigen::MatrixXd AnalogChannels::rows(Eigen::Index first,
                                     Eigen::Index count,
                                     const std::vector<Eigen::Index>& columns) const {
  Eigen::MatrixXd values(count, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    auto out = values.col(static_cast<Eigen::Index>(k));
    if (counts_) {
      convert(*counts_, columns[k], first, count, true, out);
    } else {
      out = series_.values().col(columns[k]).segment(first, count);
    }
  }
  return values;
}

TimeSeries AnalogChannels::converted(const std::vector<Eigen::Index>& columns) const {
  std::vector<Channel> chosen;
  for (const Eigen::Index column : columns) chosen.push_back(channels_[static_cast<std::size_t>(column)]);
  return {time_s(), std::move(chosen), rows(0, sample_count(), columns)};
}

TimeSeries AnalogChannels::series() const {
  if (!counts_) return series_;
  std::vector<Eigen::Index> all(channels_.size());
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return converted(all);
}

TimeSeries AnalogChannels::select(const std::vector<std::string>& names) const {
  return counts_ ? converted(columns_of(names)) : series_.select(names);
}

std::vector<Eigen::Index> AnalogChannels::columns_of(const std::vector<std::string>& names) const {
  std::vector<Eigen::Index> columns;
  for (const std::string& name : names) {
    const auto column = find(name);
    if (!column) {
      const TimeSeries list(Eigen::VectorXd::Zero(1), channels(), Eigen::MatrixXd::Zero(1, channel_count()));
      columns.push_back(list.index(name));  // throws, listing the available names
    } else {
      columns.push_back(*column);
    }
  }
  return columns;
}

bool AnalogChannels::all_finite() const {
  if (!counts_) return series_.values().allFinite();
  const auto* reals = std::get_if<AnalogCounts::Columns<float>>(&counts_->values);
  return (reals == nullptr || reals->allFinite()) &&
         std::all_of(counts_->scales.begin(), counts_->scales.end(), [](const CountScale& scale) {
           // Counts are below 1e39.
           return std::isfinite(scale.base + scale.offset) &&
                  std::abs(scale.scale) * std::max(1.0, std::abs(scale.to_si)) < 1e250;
         });
}

Eigen::MatrixXd AnalogChannels::as_written(const std::vector<Eigen::Index>& columns) const {
  Eigen::MatrixXd values(sample_count(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    auto out = values.col(static_cast<Eigen::Index>(k));
    if (counts_) {
      convert(*counts_, columns[k], 0, sample_count(), false, out);
    } else {
      out = series_.values().col(columns[k]);
    }
  }
  return values;
}

}  // namespace myoid::inline ground
