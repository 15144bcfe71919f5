#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/recording/tables/table_layout.h"

namespace myoid::recording {

/// Returns the time [s] of every row of a table. The clock is the first of these that the table has:
///
///   - the time column;
///   - frame f and sub-frame s: (f - first frame) / frame rate + s / rate;
///   - frame f alone: (f - first frame) / rate;
///   - the row: row / rate.
///
/// A frame rate that is not stated is the rate divided by the number of sub-frames per frame. Two repairs are noted:
/// rows missing between two frames or sub-frames, and a stated rate that the times contradict. Throws ReadError with
/// the line where a row is repeated or goes back, where a frame is no whole number, where the rates contradict the
/// sub-frames, and where there is no clock.
///
/// A time column without a unit counts s. It counts ms or us where the stated rate says so, ms, us or ns since 1970 by
/// its digits, and days, as in a spreadsheet, where it would tick faster than 1 MHz. Each is noted, and that rows which
/// lie half a second or more apart may be ms. Times that rounding made equal are replaced (`even_times`).
[[nodiscard]] Eigen::VectorXd row_times(const TableLayout& layout,
                                        const TableNumbers& numbers,
                                        const std::filesystem::path& path,
                                        std::vector<Repair>& repairs);

/// Returns the repair of a header that states another rate than the times of so many intervals have.
[[nodiscard]] Repair other_rate(std::size_t line, double said_hz, double times_hz, double intervals);

/// Returns even times [s] in place of times that rounding made equal, at the stated rate, else at the rate of the times
/// themselves. Empty: no two are equal; the times are not even within their last decimal; without a stated rate that
/// decimal is above 0.2 % of the duration, or below 2 % of them are equal, so that a row may stand twice.
[[nodiscard]] std::optional<Eigen::VectorXd> even_times(const Eigen::VectorXd& rounded_s, double stated_rate_hz);

/// Settles rows that share the time of the row above, within 1e-10 s: makes the times even where rounding made them
/// equal, else leaves out the later rows of a time. Returns the number of rows that are left out. `values` may have
/// further rows.
std::size_t settle_repeats(std::vector<double>& time_s, Eigen::MatrixXd& values, double stated_rate_hz);

/// Returns the last decimal with which times are written [s]: the power of ten of which all are multiples, 1e-9 or
/// more.
[[nodiscard]] double last_decimal(const Eigen::VectorXd& time_s);

/// Notes a step that stands out of an otherwise even clock. Its departure from the median step must exceed ten times
/// the 80th percentile of all departures. Where steps often differ by the last decimal, because times are rounded, it
/// must exceed that decimal too, and so where that decimal is below a tenth of a step. `lines` are the line numbers of
/// the times.
void state_uneven_step(const Eigen::VectorXd& time_s,
                       const std::vector<std::size_t>& lines,
                       std::string_view name,
                       std::vector<Repair>& repairs);

}  // namespace myoid::recording
