#include "myoid/ground/core/time_series.h"

#include <cmath>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"

namespace myoid::inline ground {

TimeSeries::TimeSeries(Eigen::VectorXd time_s, std::vector<Channel> channels, Eigen::MatrixXd values)
    : time_s_(std::move(time_s)), channels_(std::move(channels)), values_(std::move(values)) {
  if (values_.rows() != time_s_.size() || values_.cols() != static_cast<Eigen::Index>(channels_.size())) {
    throw InvalidInput("time series: {} x {} values for {} times and {} channels", values_.rows(), values_.cols(),
                       time_s_.size(), channels_.size());
  }
  std::unordered_set<std::string_view> seen;
  for (const Channel& channel : channels_) {
    if (channel.name.empty()) throw InvalidInput("time series: a channel has no name");
    if (!seen.insert(channel.name).second) {
      throw InvalidInput("time series: two channels are named '{}'; names must be unique", channel.name);
    }
  }
  for (Eigen::Index i = 0; i < time_s_.size(); ++i) {
    if (!std::isfinite(time_s_[i])) {
      throw InvalidInput("time series: the time of sample {} is not a number", i + 1);
    }
    if (i > 0 && time_s_[i] <= time_s_[i - 1]) {
      throw InvalidInput("time series: time does not increase at sample {}: {} s after {} s", i + 1, time_s_[i],
                         time_s_[i - 1]);
    }
  }
}

std::optional<Eigen::Index> TimeSeries::find(std::string_view name) const {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].name == name) return static_cast<Eigen::Index>(i);
  }
  return std::nullopt;
}

Eigen::Index TimeSeries::index(std::string_view name) const {
  if (const auto found = find(name)) return *found;
  throw InvalidInput("no channel named '{}'{}", name, not_among(name, channels_, &Channel::name));
}

Eigen::VectorXd TimeSeries::column(std::string_view name) const { return values_.col(index(name)); }

double TimeSeries::mean_interval_s() const {
  const Eigen::Index n = time_s_.size();
  return n < 2 ? 0.0 : (time_s_[n - 1] - time_s_[0]) / static_cast<double>(n - 1);
}

double TimeSeries::mean_rate_hz() const {
  const double dt = mean_interval_s();
  return dt > 0.0 ? 1.0 / dt : 0.0;
}

bool TimeSeries::is_uniform(double tolerance) const {
  const double dt = mean_interval_s();
  for (Eigen::Index i = 1; i < time_s_.size(); ++i) {
    if (std::abs(time_s_[i] - time_s_[i - 1] - dt) > tolerance * dt) return false;
  }
  return true;
}

TimeSeries TimeSeries::slice(double start_s, double end_s) const {
  Eigen::Index first = 0;
  while (first < time_s_.size() && time_s_[first] < start_s) ++first;
  Eigen::Index last = time_s_.size();
  while (last > first && time_s_[last - 1] > end_s) --last;
  return {time_s_.segment(first, last - first), channels_, values_.middleRows(first, last - first)};
}

TimeSeries TimeSeries::select(const std::vector<std::string>& names) const {
  std::vector<Channel> channels;
  Eigen::MatrixXd values(values_.rows(), static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Eigen::Index column = index(names[i]);
    channels.push_back(channels_[static_cast<std::size_t>(column)]);
    values.col(static_cast<Eigen::Index>(i)) = values_.col(column);
  }
  return {time_s_, std::move(channels), std::move(values)};
}

std::string channel_names(const TimeSeries& series, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < series.channels().size(); ++i) {
    if (i == most) return text + ", ...";
    if (i > 0) text += ", ";
    text += series.channels()[i].name;
  }
  return text.empty() ? "(none)" : text;
}

void require_unit(const TimeSeries& series, Unit unit, std::string_view what) {
  for (const Channel& channel : series.channels()) {
    if (channel.unit != unit) {
      throw InvalidInput("{}: channel '{}' is in [{}], expected [{}]", what, channel.name, symbol(channel.unit),
                         symbol(unit));
    }
  }
}

std::string gap_text(const Channel& channel) {
  return channel.missing ? fmt::format(", where the file has {}, which stands for a missing value", *channel.missing)
                         : "";
}

void require_finite(const TimeSeries& series, std::string_view what) {
  for (Eigen::Index column = 0; column < series.channel_count(); ++column) {
    for (Eigen::Index row = 0; row < series.sample_count(); ++row) {
      if (!std::isfinite(series.values()(row, column))) {
        const Channel& channel = series.channels()[static_cast<std::size_t>(column)];
        throw InvalidInput("{}: channel '{}' is not a number at {} s{}; fill the gaps first", what, channel.name,
                           series.time_s()[row], gap_text(channel));
      }
    }
  }
}

}  // namespace myoid::inline ground
