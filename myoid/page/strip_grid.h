#pragma once

#include <string>

#include "myoid/page/report.h"

namespace myoid::page {

struct StripScale {
  double lower = 0.0, upper = 1.0;
};

/// Returns the scale of a column: the values, the field behind them and the intervals, these as far
/// as one range of the values, or the (lower) median interval if that is wider, to either side.
/// Values whose badge is neither `good` nor `weak` count only if there are no others.
[[nodiscard]] StripScale strip_scale(const StripGrid& grid, std::size_t column);

/// Returns strip plots as an HTML table: each person's mark with the 95 % interval on the column's scale, behind it
/// line and field of the column. A red ring marks an outlier. Ends beyond the scale become arrows.
[[nodiscard]] std::string strip_grid_html(const StripGrid& grid);

/// Returns the numbers, a row each: person, number, unit, value, lower, upper, truth, verdict,
/// outlier. Cells without a value are left out.
[[nodiscard]] std::string strip_grid_csv(const StripGrid& grid);

}  // namespace myoid::page
