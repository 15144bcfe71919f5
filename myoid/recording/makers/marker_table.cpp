#include "myoid/recording/makers/marker_table.h"

#include <cassert>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/makers/marker_layouts.h"
#include "myoid/recording/tables/table_clock.h"

namespace myoid::recording {
namespace {

/// Returns the factor to meters of the stated unit, or of mm.
double to_meters(const std::string& stated, const std::filesystem::path& path, MarkerFile& file) {
  file.unit = stated;
  if (file.unit.empty()) {
    file.unit = "mm";
    file.repairs.push_back({0, "no unit is stated; mm is assumed: compare a known distance"});
  }
  const auto unit = parse_file_unit(file.unit);
  if (!unit || unit->unit != Unit::meter)
    throw ReadError(path, 0, fmt::format("the unit is '{}', expected mm, cm or m", file.unit));
  return unit->to_si;
}

void require_clock(const TableLayout& table, const std::filesystem::path& path) {
  if (table.count(TableColumn::Kind::time) == 0 && !(table.rate_hz > 0.0 && table.rate_hz < 1e6))
    throw ReadError(path, 0, "the frame rate is not stated; add it to the header");
}

void require_unique(const std::vector<std::string>& names, std::size_t line, const std::filesystem::path& path) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!name.empty() && !seen.insert(name).second)
      throw ReadError(path, line, fmt::format("the marker's name '{}' stands twice; rename one of them", name));
  }
}

/// Makes a gap of a marker that lacks a coordinate or is beyond kFarthest_m, and of 0 0 0 in formats where that means
/// "not seen".
void make_gaps(const TableNumbers& numbers, bool zero_is_missing, MarkerFile& file) {
  Eigen::MatrixXd& positions = file.markers.positions_m;
  Eigen::Index zeros = 0, partial = 0, distant = 0;
  std::size_t partial_line = 0, distant_line = 0;
  for (Eigen::Index m = 0; 3 * m < positions.cols(); ++m) {
    for (Eigen::Index row = 0; row < positions.rows(); ++row) {
      auto p = positions.block<1, 3>(row, 3 * m);
      const bool zero = zero_is_missing && p.isZero(0.0);
      if (zero) ++zeros;
      if (!p.allFinite() && !p.array().isNaN().all() && ++partial == 1) partial_line = numbers.lines[at(row)];
      const bool far = (p.array().abs() > kFarthest_m).any();
      if (far && ++distant == 1) distant_line = numbers.lines[at(row)];
      if (zero || far || !p.allFinite()) p.setConstant(kNan);
    }
  }
  if (zeros > 0) file.repairs.push_back({0, fmt::format("{} positions are 0 0 0, which is a gap here", zeros)});
  if (distant > 0)
    file.repairs.push_back(
        {distant_line, fmt::format("{} positions are more than 1000 km away; taken as missing", distant)});
  if (partial > 0)
    file.repairs.push_back(
        {partial_line, fmt::format("only some coordinates of a position, {} times; taken as missing", partial)});
}

}  // namespace

bool is_marker_table(std::string_view text) {
  try {
    return marker_layout(TableText(text), "").has_value();
  } catch (const ReadError&) {
    return true;  // a table of markers with a damaged header
  }
}

MarkerFile parse_marker_table(std::string_view text, const std::filesystem::path& path) {
  const TableText table(text);
  const std::optional<MarkerLayout> layout = marker_layout(table, path);
  if (!layout) {
    throw ReadError(path, 0,
                    "this is no table of markers that is known (Vicon Trajectories, Qualisys 3D, BTS Point 3D tracks, "
                    "NDI, OptiTrack); export .c3d or .trc");
  }
  require_clock(layout->table, path);
  MarkerFile file;
  file.repairs = layout->table.repairs;
  const double to_m = to_meters(layout->unit, path, file);
  require_unique(layout->names, layout->table.names_line + 1, path);
  file.markers.names = unique_names(layout->names, "marker", layout->table.names_line + 1, file.repairs);
  compare_count(layout->table.channels_said, layout->names.size(), "markers", file.repairs);
  TableNumbers numbers = read_rows(table, rows_of(layout->table), path);
  file.repairs.insert(file.repairs.end(), numbers.repairs.begin(), numbers.repairs.end());
  file.markers.time_s = row_times(layout->table, numbers, path, file.repairs);
  assert(numbers.values.cols() == static_cast<Eigen::Index>(3 * layout->names.size()));
  file.markers.positions_m = to_m * numbers.values;
  make_gaps(numbers, layout->zero_is_missing, file);
  return file;
}

}  // namespace myoid::recording
