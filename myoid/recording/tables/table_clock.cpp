#include "myoid/recording/tables/table_clock.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

/// Finds the column of numbers.clock that holds the first column of a kind.
std::optional<Eigen::Index> clock_column(const TableLayout& layout, Kind kind) {
  Eigen::Index k = 0;
  for (const TableColumn& column : layout.columns) {
    if (column.kind == kind) return k;
    if (is_clock(column.kind)) ++k;
  }
  return std::nullopt;
}

const TableColumn& first_of(const TableLayout& layout, Kind kind) {
  for (const TableColumn& column : layout.columns)
    if (column.kind == kind) return column;
  throw InvalidInput("a table's layout lacks a column of its clock");
}

class RowClock {
 public:
  RowClock(const TableLayout& layout,
           const TableNumbers& numbers,
           const std::filesystem::path& path,
           std::vector<Repair>& repairs)
      : layout_(layout),
        numbers_(numbers),
        path_(path),
        repairs_(repairs),
        time_(clock_column(layout, Kind::time)),
        frame_(clock_column(layout, Kind::frame)),
        sub_frame_(clock_column(layout, Kind::sub_frame)) {}

  Eigen::VectorXd times() {
    if (frame_) {
      require_whole(*frame_, "frame");
      if (sub_frame_) require_whole(*sub_frame_, "sub-frame");
      check_order();
    }
    if (time_) return of_time_column();
    if (!(layout_.rate_hz > 0.0))
      throw ReadError(path_, layout_.names_line + 1,
                      "neither a time column nor a sampling rate is in the file; add a column named 'time' in seconds, "
                      "or a line 'Sampling rate: 2000 Hz' above the names");
    return frame_ ? of_frames() : of_rows();
  }

 private:
  [[nodiscard]] std::size_t line(Eigen::Index row) const { return numbers_.lines[at(row)]; }
  [[nodiscard]] Eigen::Index rows() const { return numbers_.clock.rows(); }

  void require_whole(Eigen::Index column, const char* what) const {
    for (Eigen::Index i = 0; i < rows(); ++i) {
      const double number = numbers_.clock(i, column);
      if (!(std::floor(number) == number && std::abs(number) < 1e12))
        throw ReadError(path_, line(i),
                        std::isfinite(number) ? fmt::format("expected the number of a {}, found {}", what, number)
                                              : fmt::format("the number of the {} is missing", what));
    }
  }

  /// Returns true if a frame ends within the table: only then is its number of sub-frames known.
  [[nodiscard]] bool shows_a_whole_frame() const {
    for (Eigen::Index i = 1; i < rows(); ++i) {
      if (numbers_.clock(i, *frame_) != numbers_.clock(i - 1, *frame_)) return true;
    }
    return false;
  }

  /// Returns the rows per frame: the most frequent number of rows.
  [[nodiscard]] double per_frame() const {
    if (!sub_frame_) return 1.0;
    const auto sub = numbers_.clock.col(*sub_frame_);
    std::map<double, int> ends;
    for (Eigen::Index i = 1; i < rows(); ++i) {
      if (numbers_.clock(i, *frame_) != numbers_.clock(i - 1, *frame_)) ++ends[sub[i - 1]];
    }
    const auto usual =
        std::ranges::max_element(ends, [](const auto& a, const auto& b) { return a.second <= b.second; });
    return 1.0 + (usual == ends.end() ? sub.maxCoeff() : usual->first);
  }

  /// Returns the place that a row would have in a recording without gaps.
  [[nodiscard]] double place(Eigen::Index i, double per_frame) const {
    const double frame = numbers_.clock(i, *frame_);
    return sub_frame_ ? frame * per_frame + numbers_.clock(i, *sub_frame_) : frame;
  }

  /// Returns true where no number of a frame or sub-frame tells of a lost row.
  [[nodiscard]] bool frames_step_evenly() const {
    if (!frame_) return true;
    const double n = per_frame();
    for (Eigen::Index i = 2; i < rows(); ++i)
      if (place(i, n) - place(i - 1, n) != place(1, n) - place(0, n)) return false;
    return true;
  }

  [[nodiscard]] std::string name_of(Eigen::Index i) const {
    return sub_frame_
               ? fmt::format("frame {}, sub-frame {}", numbers_.clock(i, *frame_), numbers_.clock(i, *sub_frame_))
               : fmt::format("frame {}", numbers_.clock(i, *frame_));
  }

  /// Returns the least step from frame to frame if all steps are multiples of it, else 1.
  [[nodiscard]] double least_step() const {
    const auto frame = numbers_.clock.col(*frame_);
    const Eigen::ArrayXd step = frame.tail(rows() - 1) - frame.head(rows() - 1);
    const double least = step.minCoeff();
    return least > 1.0 && (step / least == (step / least).round()).all() ? least : 1.0;
  }

  void check_order() {
    if (sub_frame_ && numbers_.clock.col(*sub_frame_).minCoeff() < 0.0)
      throw ReadError(path_, line(0), "the number of a sub-frame is below 0");
    // Where the ratio of the rates is no whole number, the number of sub-frames alternates by one.
    const double ratio = layout_.frame_rate_hz > 0.0 ? layout_.rate_hz / layout_.frame_rate_hz : 0.0;
    const bool uneven = ratio > 0.0 && std::abs(ratio - std::round(ratio)) > 1e-6 * ratio;
    const double n = uneven ? std::ceil(ratio) : per_frame();
    for (Eigen::Index i = 0; sub_frame_ && i < rows(); ++i) {
      if (numbers_.clock(i, *sub_frame_) >= n)
        throw ReadError(path_, line(i), fmt::format("{}, where frames have {} sub-frames", name_of(i), n));
    }
    double missing = 0.0;
    Eigen::Index first_hole = -1;
    // Rows that all step by one whole number of frames are every second or third frame of a take.
    const double stride = sub_frame_ || rows() < 3 ? 1.0 : least_step();
    for (Eigen::Index i = 1; i < rows(); ++i) {
      const double step = place(i, n) - place(i - 1, n);
      if (!(step > 0.0))
        throw ReadError(path_, line(i),
                        fmt::format("{} stands below {}: the frames do not increase", name_of(i), name_of(i - 1)));
      if (step == stride || (uneven && step == 2.0)) continue;
      missing += step / stride - 1.0;
      if (first_hole < 0) first_hole = i;
    }
    if (first_hole >= 0)
      repairs_.push_back({line(first_hole), fmt::format("{} {} missing, first between {} and {}: a gap in time",
                                                        missing, missing == 1.0 ? "row is" : "rows are",
                                                        name_of(first_hole - 1), name_of(first_hole))});
  }

  /// A unit of time that a column does not state.
  struct OtherUnit {
    double to_s;
    const char* symbol;
  };

  /// Finds the unit of a column without one: by its digits, by the stated rate, or because it would tick too fast.
  [[nodiscard]] std::optional<OtherUnit> unit_of(const Eigen::VectorXd& time) const {
    // Seconds since 1970 have ten digits; a clock with three, six or nine more counts ms, us or ns.
    if (time[0] >= 1e17) return OtherUnit{1e-9, "ns since 1970"};
    if (time[0] >= 1e14) return OtherUnit{1e-6, "us since 1970"};
    if (time[0] >= 1e11) return OtherUnit{1e-3, "ms since 1970"};
    const double rate = mean_rate(time);
    if (numbers_.day_times || !(rate > 0.0)) return std::nullopt;
    constexpr double kSame = 0.02;
    const double times = layout_.rate_hz / rate;
    if (std::abs(times - 1e3) < kSame * 1e3) return OtherUnit{1e-3, "ms, which the stated rate says"};
    if (std::abs(times - 1e6) < kSame * 1e6) return OtherUnit{1e-6, "us, which the stated rate says"};
    constexpr double kFastest_hz = 1e6;
    constexpr double kMostDays = 1e5;  // since 1900
    if (rate > kFastest_hz && time[0] < kMostDays) return OtherUnit{86400.0, "days, as a spreadsheet writes times"};
    return std::nullopt;
  }

  [[nodiscard]] static double mean_rate(const Eigen::VectorXd& time) {
    const Eigen::Index last = time.size() - 1;
    return last < 1 ? 0.0 : static_cast<double>(last) / (time[last] - time[0]);
  }

  /// Notes that a column without a unit may count ms.
  void state_slow_rows(const Eigen::VectorXd& time, const std::string& name) {
    constexpr double kSlowest_hz = 2.0;
    constexpr Eigen::Index kFewest = 10;
    const double rate = mean_rate(time);
    if (numbers_.day_times || layout_.rate_hz > 0.0 || time.size() < kFewest || rate > kSlowest_hz) return;
    const double length = time[time.size() - 1] - time[0];
    repairs_.push_back({.line = line(0),
                        .message = fmt::format("'{}' has no unit and is read as s, {:.4g} s from row to row, not as "
                                               "ms, which '{} [ms]' says",
                                               name, 1.0 / rate, name),
                        .apart_s = length - 1e-3 * length});
  }

  void require_increase(const Eigen::VectorXd& time) const {
    for (Eigen::Index i = 0; i < time.size(); ++i) {
      if (!std::isfinite(time[i])) throw ReadError(path_, line(i), "the time is missing");
      if (i == 0 || time[i] > time[i - 1]) continue;
      throw ReadError(
          path_, line(i),
          fmt::format("time does not increase: {} s after {} s; {}", time[i], time[i - 1],
                      time[i] == time[i - 1] ? remedy_of_equal_times() : "split the file where the times begin anew"));
    }
  }

  [[nodiscard]] std::string remedy_of_equal_times() const {
    if (layout_.rate_hz > 0.0)
      return fmt::format(
          "export it with more decimals, or, where no row is lost, delete the column '{}': the stated "
          "{:.6g} Hz count then",
          first_of(layout_, Kind::time).name, layout_.rate_hz);
    return "export it with more decimals, or write a line 'Sampling rate: 2000 Hz' above the names";
  }

  [[nodiscard]] Eigen::VectorXd of_time_column() {
    const TableColumn& column = first_of(layout_, Kind::time);
    Eigen::VectorXd time = (column.unit ? column.unit->to_si : 1.0) * numbers_.clock.col(*time_);
    const auto other = column.unit ? std::nullopt : unit_of(time);
    if (other) {
      time *= other->to_s;
      repairs_.push_back({line(0), fmt::format("'{}' is read as {}", column.name, other->symbol)});
    }
    if (!layout_.blocks.empty())
      for (Eigen::Index i = 0; i < time.size(); ++i) time[i] += layout_.blocks[block_of(i)].begin_s;
    if (auto even = frames_step_evenly() ? even_times(time, layout_.rate_hz) : std::nullopt) {
      Eigen::Index twice = 1;
      while (time[twice] > time[twice - 1]) ++twice;
      repairs_.push_back({line(twice), fmt::format("'{}' is rounded, so that rows share times: the rows are taken as "
                                                   "even, {:.6g} Hz",
                                                   column.name, mean_rate(*even))});
      return *std::move(even);
    }
    require_increase(time);
    const Eigen::Index last = time.size() - 1;
    if (last < 1 || layout_.blocks.size() > 1) return time;
    if (!column.unit) state_slow_rows(time, column.name);
    if (!frame_) state_uneven_step(time, numbers_.lines, column.name, repairs_);
    const double steps = frame_ ? place(last, per_frame()) - place(0, per_frame()) : static_cast<double>(last);
    const double rate = steps / (time[last] - time[0]);
    if (layout_.rate_hz > 0.0 && std::abs(rate - layout_.rate_hz) > 0.01 * layout_.rate_hz)
      repairs_.push_back(other_rate(0, layout_.rate_hz, rate, steps));
    return time;
  }

  [[nodiscard]] Eigen::VectorXd of_frames() const {
    const double n = per_frame();
    const double frame_rate = !sub_frame_                   ? layout_.rate_hz
                              : layout_.frame_rate_hz > 0.0 ? layout_.frame_rate_hz
                                                            : layout_.rate_hz / n;
    const double ratio = layout_.rate_hz / frame_rate;
    if (sub_frame_ && (n >= ratio + 1.0 || (n <= ratio - 1.0 && shows_a_whole_frame())))
      throw ReadError(path_, layout_.names_line + 1,
                      fmt::format("the frames have {} sub-frames, but the rates are {} and {} Hz; correct the rate", n,
                                  layout_.rate_hz, frame_rate));
    if (sub_frame_ && !(layout_.frame_rate_hz > 0.0) && !shows_a_whole_frame() &&
        numbers_.clock(0, *frame_) != layout_.first_frame)
      throw ReadError(
          path_, line(0),
          fmt::format("the time of {} is not known: no frame ends in the table and no rate of the frames is stated",
                      name_of(0)));
    Eigen::VectorXd time(rows());
    for (Eigen::Index i = 0; i < rows(); ++i) {
      const double frame = numbers_.clock(i, *frame_) - layout_.first_frame;
      time[i] =
          !sub_frame_ ? frame / frame_rate : frame / frame_rate + numbers_.clock(i, *sub_frame_) / layout_.rate_hz;
    }
    return time;
  }

  [[nodiscard]] Eigen::VectorXd of_rows() const {
    Eigen::VectorXd time(numbers_.values.rows());
    std::size_t block = 0;
    Eigen::Index first = 0;
    for (Eigen::Index i = 0; i < time.size(); ++i) {
      if (!layout_.blocks.empty() && block_of(i) != block) {
        block = block_of(i);
        first = i;
      }
      time[i] = static_cast<double>(i - first) / layout_.rate_hz;
      if (!layout_.blocks.empty()) time[i] += layout_.blocks[block].begin_s;
    }
    return time;
  }

  /// Returns the block of a row. Precondition: there are blocks.
  [[nodiscard]] std::size_t block_of(Eigen::Index row) const {
    std::size_t block = layout_.blocks.size() - 1;
    while (block > 0 && line(row) < layout_.blocks[block].first_line) --block;
    return block;
  }

  const TableLayout& layout_;
  const TableNumbers& numbers_;
  const std::filesystem::path& path_;
  std::vector<Repair>& repairs_;
  std::optional<Eigen::Index> time_, frame_, sub_frame_;
};

}  // namespace

Repair other_rate(std::size_t line, double said_hz, double times_hz, double intervals) {
  return {line, fmt::format("the header says {} Hz, the times {:.6g} Hz; the times are taken", said_hz, times_hz),
          std::abs(intervals / said_hz - intervals / times_hz)};
}

std::optional<Eigen::VectorXd> even_times(const Eigen::VectorXd& rounded_s, double stated_rate_hz) {
  const Eigen::Index steps = rounded_s.size() - 1;
  if (steps < 2 || !rounded_s.allFinite()) return std::nullopt;
  const Eigen::ArrayXd step = rounded_s.tail(steps) - rounded_s.head(steps);
  const double equal = static_cast<double>((step == 0.0).count());
  const double length = rounded_s[steps] - rounded_s[0];
  if (equal == 0.0 || !(length > 0.0) || !(step >= 0.0).all()) return std::nullopt;
  const double tick = (step > 0.0).select(step, length).minCoeff();
  constexpr double kShareOfLength = 0.002;
  constexpr double kShareOfRows = 0.02;
  const bool told = tick <= kShareOfLength * length && equal >= kShareOfRows * static_cast<double>(steps);
  if (!(stated_rate_hz > 0.0) && !told) return std::nullopt;
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(steps + 1, 0.0, static_cast<double>(steps));
  const Eigen::ArrayXd from_middle = place - place.mean();
  const double interval = stated_rate_hz > 0.0 ? 1.0 / stated_rate_hz
                                               : (from_middle * rounded_s.array()).sum() / from_middle.square().sum();
  const Eigen::ArrayXd off = rounded_s.array() - interval * place;
  constexpr double kRoundOff = 1.1;  // halves are rounded to either side
  if (interval >= tick || off.maxCoeff() - off.minCoeff() > kRoundOff * tick) return std::nullopt;
  return (rounded_s[0] + interval * place).matrix();
}

std::size_t settle_repeats(std::vector<double>& time_s, Eigen::MatrixXd& values, double stated_rate_hz) {
  const auto count = static_cast<Eigen::Index>(time_s.size());
  const Eigen::Map<Eigen::VectorXd> time(time_s.data(), count);
  if (const auto even = even_times(time, stated_rate_hz)) {
    time_s.assign(even->begin(), even->end());
    return 0;
  }
  Eigen::Index kept = 1;
  for (Eigen::Index row = 1; row < count; ++row) {
    if (time[row] == time[kept - 1]) continue;
    time_s[at(kept)] = time[row];
    for (auto column : values.colwise()) column[kept] = column[row];
    ++kept;
  }
  time_s.resize(at(kept));
  return at(count - kept);
}

double last_decimal(const Eigen::VectorXd& time_s) {
  constexpr double kFinest = 1e-9;
  double unit = 0.1;
  while (unit > kFinest) {
    const Eigen::ArrayXd count = time_s.array() / unit;
    if ((count - count.round()).abs().maxCoeff() < 1e-4) break;
    unit /= 10.0;
  }
  return unit;
}

void state_uneven_step(const Eigen::VectorXd& time_s,
                       const std::vector<std::size_t>& lines,
                       std::string_view name,
                       std::vector<Repair>& repairs) {
  constexpr Eigen::Index kFewest = 8;
  const Eigen::Index steps = time_s.size() - 1;
  if (steps < kFewest) return;
  const Eigen::ArrayXd step = time_s.tail(steps) - time_s.head(steps);
  const auto quantile = [&](Eigen::ArrayXd x, double share) {
    double* const at = x.data() + static_cast<Eigen::Index>(share * static_cast<double>(steps - 1));
    std::nth_element(x.data(), at, x.data() + steps);
    return *at;
  };
  const double usual = quantile(step, 0.5);
  const Eigen::ArrayXd off = (step - usual).abs();
  double most = std::max(10.0 * quantile(off, 0.8), 1e-6 * usual);
  // Rounding makes many steps differ by the last decimal; one wrong digit changes two steps.
  constexpr Eigen::Index kOften = 3;
  constexpr double kFineTick = 0.1;  // a time that is wrong by less of a step harms no result
  const double rounding = 1.01 * last_decimal(time_s);
  const bool fine = rounding <= kFineTick * usual;
  if (fine || (off > most && off <= rounding).count() >= kOften) most = std::max(most, rounding);
  const Eigen::Index odd = (off > most).count();
  if (odd == 0) return;
  Eigen::Index first = 0;
  while (!(off[first] > most)) ++first;
  // A lost row makes a step longer by a whole one.
  const bool lost = (step - usual).maxCoeff() > 0.5 * usual;
  repairs.push_back({lines[at(first + 1)],
                     fmt::format("'{}' steps by {:.6g} s, {:.6g} s elsewhere: {} ({} such {})", name, step[first],
                                 usual, lost ? "rows are lost or a time is wrong" : "a time is wrong; no row is lost",
                                 odd, odd == 1 ? "step" : "steps")});
}

Eigen::VectorXd row_times(const TableLayout& layout,
                          const TableNumbers& numbers,
                          const std::filesystem::path& path,
                          std::vector<Repair>& repairs) {
  return RowClock(layout, numbers, path, repairs).times();
}

}  // namespace myoid::recording
