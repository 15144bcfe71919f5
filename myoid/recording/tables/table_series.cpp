#include "myoid/recording/tables/table_series.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/recording/tables/instrument_names.h"
#include "myoid/recording/tables/table_clock.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

/// The place of a channel's samples and their number up to the last one that is no gap.
struct TableChannel {
  std::string name;
  std::optional<ScaledUnit> unit;
  Eigen::Index column = 0;  ///< Column of TableNumbers::values.
  Eigen::Index samples = 0;
  std::size_t clock = 0;
};

struct TableClock {
  Eigen::VectorXd time_s;
  std::vector<std::size_t> channels;
};

class TableSeries {
 public:
  TableSeries(const TableText& text, const TableLayout& layout, const std::filesystem::path& path)
      : layout_(layout), path_(path), numbers_(read_rows(text, rows_of(layout), path)) {
    series_.repairs = layout.repairs;
    series_.repairs.insert(series_.repairs.end(), numbers_.repairs.begin(), numbers_.repairs.end());
  }

  CsvSeries read() {
    find_channels();
    switch (layout_.clocks()) {
      case Clocks::of_rows:
        clock_of_rows();
        break;
      case Clocks::of_time_columns:
        clocks_of_time_columns();
        break;
      case Clocks::of_rates:
        clocks_of_rates();
        break;
    }
    drop_empty_channels();
    for (const std::size_t clock : clocks_in_order()) add_clock(clocks_[clock]);
    state_clocks();
    add_events();
    return std::move(series_);
  }

 private:
  void note(std::size_t line, std::string message) { series_.repairs.push_back({line, std::move(message)}); }

  void find_channels() {
    std::vector<std::string> names, left_out;
    for (const TableColumn& column : layout_.columns) {
      if (column.kind == Kind::channel) names.push_back(column.name);
      if (column.kind == Kind::left_out) left_out.push_back(column.name);
    }
    if (!left_out.empty())
      note(layout_.names_line + 1, fmt::format("columns that are left out: {}", fmt::join(left_out, ", ")));
    compare_count(layout_.channels_said, names.size(), "channels", series_.repairs);
    if (layout_.plain) require_own_names(names);
    names = unique_names(names, "channel", layout_.names_line + 1, series_.repairs);
    std::size_t k = 0;
    for (const TableColumn& column : layout_.columns) {
      if (column.kind != Kind::channel) continue;
      const auto x = numbers_.values.col(static_cast<Eigen::Index>(k));
      Eigen::Index samples = x.size();
      const bool may_end = !layout_.plain || (column.name.empty() && !x.array().isFinite().any());
      while (may_end && samples > 0 && !std::isfinite(x[samples - 1])) --samples;
      channels_.push_back({names[k], column.unit, static_cast<Eigen::Index>(k), samples, 0});
      ++k;
    }
  }

  void require_own_names(const std::vector<std::string>& names) const {
    for (std::size_t c = 0; c < names.size(); ++c) {
      const auto here = names.begin() + static_cast<std::ptrdiff_t>(c);
      if (!names[c].empty() && std::find(names.begin(), here, names[c]) != here)
        throw ReadError(path_, layout_.names_line + 1, fmt::format("two columns are named '{}'; rename one", names[c]));
    }
  }

  void clock_of_rows() {
    clocks_.push_back({row_times(layout_, numbers_, path_, series_.repairs), {}});
    for (std::size_t c = 0; c < channels_.size(); ++c) clocks_[0].channels.push_back(c);
  }

  // --- a time column for each channel ---

  /// Returns the seconds of a time column up to its end; throws if they do not increase.
  [[nodiscard]] Eigen::VectorXd times_of(const TableColumn& column, Eigen::Index k) const {
    const auto cells = numbers_.clock.col(k);
    Eigen::Index count = cells.size();
    while (count > 0 && !std::isfinite(cells[count - 1])) --count;
    while (count > 1 && cells[count - 1] == 0.0) --count;  // filled up with zeros
    const Eigen::VectorXd time = (column.unit ? column.unit->to_si : 1.0) * cells.head(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      if (!std::isfinite(time[i]))
        throw ReadError(path_, numbers_.lines[at(i)], fmt::format("a time of column '{}' is missing", column.name));
      if (i > 0 && time[i] <= time[i - 1])
        throw ReadError(
            path_, numbers_.lines[at(i)],
            fmt::format("time of column '{}' does not increase: {} s after {} s", column.name, time[i], time[i - 1]));
    }
    return time;
  }

  /// Returns true for equal times; one clock may have a few more at the end.
  static bool same_clock(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const Eigen::Index n = std::min(a.size(), b.size());
    if (n < 2) return a.size() == b.size();
    const double interval = (a[n - 1] - a[0]) / static_cast<double>(n - 1);
    return (a.head(n) - b.head(n)).cwiseAbs().maxCoeff() < 0.1 * interval;
  }

  /// Cuts zeros behind the last time off a channel.
  void cut_zeros(TableChannel& channel, Eigen::Index end) {
    if (channel.samples <= end) return;
    const auto behind = numbers_.values.col(channel.column).segment(end, channel.samples - end).array();
    if (!(behind == 0.0).all()) return;
    note(numbers_.lines[at(end)], fmt::format("zeros behind the end of '{}' are left out", channel.name));
    channel.samples = end;
  }

  std::size_t clock_for(Eigen::VectorXd time) {
    for (std::size_t k = 0; k < clocks_.size(); ++k) {
      if (!same_clock(clocks_[k].time_s, time)) continue;
      if (time.size() > clocks_[k].time_s.size()) clocks_[k].time_s = std::move(time);
      return k;
    }
    clocks_.push_back({std::move(time), {}});
    return clocks_.size() - 1;
  }

  void clocks_of_time_columns() {
    std::size_t channel = 0;
    Eigen::Index k = 0;
    std::optional<std::size_t> clock;
    Eigen::Index end = 0;
    const auto next_clock = [&](const TableColumn& column) {
      Eigen::VectorXd time = times_of(column, k);
      end = time.size();
      clock = clock_for(std::move(time));
    };
    // Channels before the first time column use its clock.
    for (const TableColumn& column : layout_.columns) {
      if (column.kind == Kind::time) {
        next_clock(column);
        break;
      }
      if (is_clock(column.kind)) ++k;
    }
    k = 0;
    for (const TableColumn& column : layout_.columns) {
      if (column.kind == Kind::time) {
        next_clock(column);
        state_uneven_step(times_of(column, k), numbers_.lines, column.name, series_.repairs);
      }
      if (is_clock(column.kind)) ++k;
      if (column.kind != Kind::channel) continue;
      TableChannel& c = channels_[channel];
      cut_zeros(c, end);
      if (c.samples > end)
        throw ReadError(path_, numbers_.lines[at(c.samples - 1)],
                        fmt::format("'{}' has a value where its time column has none", c.name));
      c.clock = *clock;
      clocks_[*clock].channels.push_back(channel++);
    }
  }

  // --- a stated rate for each channel ---

  void clocks_of_rates() {
    std::map<double, std::size_t> known;
    std::size_t channel = 0;
    for (const TableColumn& column : layout_.columns) {
      if (column.kind != Kind::channel) continue;
      const double rate = column.rate_hz > 0.0 ? column.rate_hz : layout_.rate_hz;
      if (!(rate > 0.0))
        throw ReadError(
            path_, layout_.names_line + 1,
            fmt::format("channel '{}' has no sampling rate, which the others state", channels_[channel].name));
      const auto [it, fresh] = known.try_emplace(rate, clocks_.size());
      if (fresh) {
        clocks_.push_back({Eigen::VectorXd(numbers_.values.rows()), {}});
        for (Eigen::Index i = 0; i < numbers_.values.rows(); ++i)
          clocks_.back().time_s[i] = static_cast<double>(i) / rate;
      }
      channels_[channel].clock = it->second;
      compare_length(channels_[channel], rate);
      clocks_[it->second].channels.push_back(channel++);
    }
  }

  /// Notes a length that the rate contradicts. Wireless sensors send packets, so that a channel may
  /// be longer or shorter by a few of them.
  void compare_length(const TableChannel& channel, double rate) {
    constexpr double kPackets_s = 0.06;
    if (!layout_.length_s || channel.samples == 0) return;
    const double length = static_cast<double>(channel.samples) / rate;
    if (std::abs(length - *layout_.length_s) > std::max(kPackets_s, 0.005 * *layout_.length_s))
      note(0, fmt::format("the header says {:.6g} s, '{}' has {:.6g} s: the file may be cut off", *layout_.length_s,
                          channel.name, length));
  }

  // --- channels and clocks together ---

  void drop_empty_channels() {
    std::vector<std::string> empty;
    for (TableClock& clock : clocks_) {
      std::erase_if(clock.channels, [&](std::size_t c) {
        if (channels_[c].samples > 0) return false;
        empty.push_back(channels_[c].name);
        return true;
      });
    }
    if (!empty.empty()) note(0, fmt::format("left out, since they have no samples: {}", fmt::join(empty, ", ")));
    if (empty.size() == channels_.size()) throw ReadError(path_, 0, "there are no columns of numbers beside the time");
  }

  /// Returns the clocks that have channels, the first one by `first_clock`.
  [[nodiscard]] std::vector<std::size_t> clocks_in_order() const {
    std::vector<std::vector<Channel>> lists;
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < clocks_.size(); ++k) {
      if (clocks_[k].channels.empty() && clocks_.size() > 1) continue;
      order.push_back(k);
      lists.emplace_back();
      for (const std::size_t c : clocks_[k].channels)
        lists.back().push_back({channels_[c].name, channels_[c].unit ? channels_[c].unit->unit : Unit::dimensionless});
    }
    if (order.empty()) return order;
    const auto best = order.begin() + static_cast<std::ptrdiff_t>(first_clock(lists));
    std::rotate(order.begin(), best, best + 1);
    return order;
  }

  void add_clock(const TableClock& clock) {
    Eigen::Index samples = clock.time_s.size();
    Eigen::Index longest = 0;
    for (const std::size_t c : clock.channels) {
      longest = std::max(longest, channels_[c].samples);
      samples = std::min(samples, channels_[c].samples);
    }
    if (longest > samples) note(0, fmt::format("the channels differ in length; all are cut to {} samples", samples));
    ClockedChannels group;
    std::vector<Channel> channels;
    // Moves the numbers if one series takes all of them, so that they need not be copied.
    const bool all = clock.channels.size() == channels_.size() && samples == numbers_.values.rows();
    Eigen::MatrixXd values =
        all ? std::move(numbers_.values) : Eigen::MatrixXd(samples, static_cast<Eigen::Index>(clock.channels.size()));
    for (std::size_t k = 0; k < clock.channels.size(); ++k) {
      const TableChannel& c = channels_[clock.channels[k]];
      channels.push_back({c.name, c.unit ? c.unit->unit : Unit::dimensionless, numbers_.missing[at(c.column)]});
      group.has_unit.push_back(c.unit.has_value());
      if (first_clock_) series_.to_si.push_back(c.unit ? c.unit->to_si : 0.0);
      const auto column = static_cast<Eigen::Index>(k);
      if (!all) values.col(column) = numbers_.values.col(c.column).head(samples);
      if (c.unit && c.unit->to_si != 1.0) values.col(column) *= c.unit->to_si;
    }
    group.data = TimeSeries(clock.time_s.head(samples), std::move(channels), std::move(values));
    ClockedChannels& place = first_clock_ ? series_ : series_.other_clocks.emplace_back();
    place = std::move(group);
    first_clock_ = false;
  }

  void state_clocks() {
    if (series_.other_clocks.empty()) return;
    std::vector<std::vector<Channel>> lists{series_.data.channels()};
    std::vector<double> rates{series_.data.mean_rate_hz()};
    for (const ClockedChannels& group : series_.other_clocks) {
      lists.push_back(group.data.channels());
      rates.push_back(group.data.mean_rate_hz());
    }
    note(layout_.names_line + 1, clocks_text(lists, rates));
  }

  void add_events() {
    const Eigen::VectorXd& time = series_.data.time_s();
    std::size_t behind = 0;
    series_.events = layout_.events;
    for (const TableRemark& remark : numbers_.remarks) {
      if (static_cast<Eigen::Index>(remark.row) >= time.size()) {
        ++behind;
        continue;
      }
      series_.events.push_back(
          {time[static_cast<Eigen::Index>(remark.row)], remark.text, layout_.columns[remark.column].name, ""});
    }
    if (behind > 0) note(0, fmt::format("{} remarks behind the last sample are left out", behind));
  }

  const TableLayout& layout_;
  const std::filesystem::path& path_;
  TableNumbers numbers_;
  CsvSeries series_;
  std::vector<TableChannel> channels_;
  std::vector<TableClock> clocks_;
  bool first_clock_ = true;
};

}  // namespace

std::size_t first_clock(const std::vector<std::vector<Channel>>& clocks) {
  std::vector<std::pair<int, int>> worth;
  for (const std::vector<Channel>& channels : clocks) {
    std::pair<int, int> w{0, 0};
    for (const Channel& channel : channels) {
      const bool emg = lower(channel.name).find("emg") != std::string::npos && !named_as_no_emg(channel.name);
      w.first += emg ? 1 : 0;
      w.second += channel.unit == Unit::volt ? 1 : 0;
    }
    worth.push_back(w);
  }
  return static_cast<std::size_t>(std::ranges::max_element(worth) - worth.begin());
}

std::string clocks_text(const std::vector<std::vector<Channel>>& clocks, const std::vector<double>& rates_hz) {
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> all;
  for (std::size_t k = 0; k < clocks.size(); ++k) {
    std::vector<std::string> names;
    for (const Channel& channel : clocks[k])
      if (names.size() < kNamed) names.push_back(channel.name);
    const std::size_t more = clocks[k].size() - names.size();
    all.push_back(fmt::format("{:.7g} Hz: {}{}", rates_hz[k], fmt::join(names, ", "),
                              more > 0 ? fmt::format(" and {} more", more) : ""));
  }
  return fmt::format("the channels have {} clocks: {}", clocks.size(), fmt::join(all, "; "));
}

CsvSeries channels_of_table(const TableText& text, const TableLayout& layout, const std::filesystem::path& path) {
  return TableSeries(text, layout, path).read();
}

}  // namespace myoid::recording
