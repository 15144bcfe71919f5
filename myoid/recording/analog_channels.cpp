#include "myoid/recording/analog_channels.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::recording {
namespace {

Eigen::Index rows_of(const AnalogCounts& counts) {
  return std::visit([](const auto& values) { return values.rows(); }, counts.values);
}

/// One column in the unit as written, times `factor`.
template <typename Out>
void convert(const AnalogCounts& counts, Eigen::Index column, bool to_si, Out&& out) {
  const CountScale& scale = counts.scales[static_cast<std::size_t>(column)];
  std::visit(
      [&](const auto& values) {
        const auto count = values.col(column).template cast<double>().array();
        if (to_si) {
          out = ((count - scale.offset) * scale.scale * scale.to_si).matrix();
        } else {
          out = ((count - scale.offset) * scale.scale).matrix();
        }
      },
      counts.values);
}

}  // namespace

AnalogChannels::AnalogChannels(TimeSeries series) : series_(std::move(series)) {}

AnalogChannels::AnalogChannels(std::vector<Channel> channels, AnalogCounts counts)
    : channels_(std::move(channels)), counts_(std::move(counts)) {
  const auto columns = static_cast<std::size_t>(
      std::visit([](const auto& values) { return values.cols(); }, counts_->values));
  if (columns != channels_.size() || columns != counts_->scales.size() ||
      !(counts_->rate_hz > 0.0)) {
    throw InvalidInput(fmt::format("{} columns of counts, {} channels, {} scales, {} Hz", columns,
                                   channels_.size(), counts_->scales.size(), counts_->rate_hz));
  }
  // The names must be as a TimeSeries has them.
  static_cast<void>(
      TimeSeries(Eigen::VectorXd::Zero(1), channels_,
                 Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(channels_.size()))));
}

const std::vector<Channel>& AnalogChannels::channels() const {
  return counts_ ? channels_ : series_.channels();
}

Eigen::Index AnalogChannels::sample_count() const {
  return counts_ ? rows_of(*counts_) : series_.sample_count();
}

std::optional<Eigen::Index> AnalogChannels::find(std::string_view name) const {
  const std::vector<Channel>& list = channels();
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const Channel& c) { return c.name == name; });
  if (it == list.end()) return std::nullopt;
  return static_cast<Eigen::Index>(it - list.begin());
}

Eigen::VectorXd AnalogChannels::time_s() const {
  if (!counts_) return series_.time_s();
  Eigen::VectorXd time(sample_count());
  for (Eigen::Index i = 0; i < time.size(); ++i)
    time[i] = (counts_->first_sample + static_cast<double>(i)) / counts_->rate_hz;
  return time;
}

TimeSeries AnalogChannels::converted(const std::vector<Eigen::Index>& columns) const {
  std::vector<Channel> chosen;
  Eigen::MatrixXd values(sample_count(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    chosen.push_back(channels_[static_cast<std::size_t>(columns[k])]);
    convert(*counts_, columns[k], true, values.col(static_cast<Eigen::Index>(k)));
  }
  return {time_s(), std::move(chosen), std::move(values)};
}

TimeSeries AnalogChannels::series() const {
  if (!counts_) return series_;
  std::vector<Eigen::Index> all(channels_.size());
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return converted(all);
}

TimeSeries AnalogChannels::select(const std::vector<std::string>& names) const {
  if (!counts_) return series_.select(names);
  std::vector<Eigen::Index> columns;
  for (const std::string& name : names) {
    const auto column = find(name);
    if (!column) {
      const TimeSeries list(Eigen::VectorXd::Zero(1), channels_,
                            Eigen::MatrixXd::Zero(1, channel_count()));
      columns.push_back(list.index(name));  // throws, with the names there are
    } else {
      columns.push_back(*column);
    }
  }
  return converted(columns);
}

Eigen::MatrixXd AnalogChannels::as_written(const std::vector<Eigen::Index>& columns) const {
  Eigen::MatrixXd values(sample_count(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    auto out = values.col(static_cast<Eigen::Index>(k));
    if (counts_) {
      convert(*counts_, columns[k], false, out);
    } else {
      out = series_.values().col(columns[k]);
    }
  }
  return values;
}

}  // namespace myoid::recording
