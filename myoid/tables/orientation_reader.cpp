#include "myoid/tables/orientation_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {
namespace {

using Fields = std::vector<std::string_view>;

/// The lines of an orientation file behind its header, cell by cell.
class QuaternionTable {
 public:
  QuaternionTable(const std::filesystem::path& path, std::string_view text)
      : path_(path), lines_(split_lines(text)) {
    bool quaternions = false;
    while (at_ < lines_.size() && !equal_ignoring_case(trim(lines_[at_]), "endheader")) {
      std::string line(trim(lines_[at_++]));
      std::erase(line, ' ');
      quaternions = quaternions || equal_ignoring_case(line, "DataType=Quaternion");
    }
    if (!quaternions || at_ == lines_.size()) {
      throw ReadError(path_, 1,
                      "expected a storage file of orientations: a header with "
                      "'DataType=Quaternion' and 'endheader'");
    }
    ++at_;
  }

  /// The next row that is not blank, split at tabs (or blanks); nothing at the end.
  std::optional<Fields> next() {
    while (at_ < lines_.size() && trim(lines_[at_]).empty()) ++at_;
    if (at_ == lines_.size()) return {};
    const std::string_view line = trim(lines_[at_++]);
    return line.find('\t') == std::string_view::npos ? split_words(line) : split(line, '\t');
  }
  [[noreturn]] void fail(const std::string& message) const { throw ReadError(path_, at_, message); }

 private:
  const std::filesystem::path& path_;
  Fields lines_;
  std::size_t at_ = 0;
};

/// Unit quaternion of a cell; NaN where it is not known.
Eigen::RowVector4d quaternion_of(const QuaternionTable& table,
                                 std::string_view cell,
                                 const std::string& name) {
  const Fields parts = split(trim(cell), ',');
  Eigen::RowVector4d q;
  if (parts.size() != 4)
    table.fail(fmt::format("sensor '{}': expected four numbers w,x,y,z, found '{}'", name, cell));
  for (std::size_t k = 0; k < 4; ++k) {
    const auto value = parse_number(parts[k]);
    if (!value)
      table.fail(fmt::format("sensor '{}': '{}' is no number", name, std::string(parts[k])));
    q[static_cast<Eigen::Index>(k)] = *value;
  }
  if (!q.allFinite()) return Eigen::RowVector4d::Constant(std::nan(""));
  if (!(q.norm() > 0.0)) table.fail(fmt::format("sensor '{}': a quaternion of length 0", name));
  return q.normalized();
}

}  // namespace

Mat3 OrientationSeries::rotation(Eigen::Index frame, std::size_t sensor) const {
  const auto q = quaternions.block<1, 4>(frame, 4 * static_cast<Eigen::Index>(sensor));
  if (!q.allFinite()) return Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

OrientationSeries read_orientations(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  QuaternionTable table(path, text);
  OrientationSeries series;
  const auto labels = table.next();
  if (!labels || labels->size() < 2 || !equal_ignoring_case(trim(labels->front()), "time"))
    table.fail("expected column names: time, then a column for each sensor");
  for (std::size_t k = 1; k < labels->size(); ++k) {
    std::string name(trim((*labels)[k]));
    if (std::find(series.names.begin(), series.names.end(), name) != series.names.end())
      table.fail(fmt::format("two sensors are named '{}'", name));
    series.names.push_back(std::move(name));
  }
  std::vector<double> times;
  std::vector<Eigen::RowVectorXd> rows;
  while (const auto fields = table.next()) {
    if (fields->size() != labels->size())
      table.fail(fmt::format("{} cells in a table of {} columns", fields->size(), labels->size()));
    const auto time_s = parse_number(fields->front());
    if (!time_s || !std::isfinite(*time_s)) table.fail("the time is no number");
    if (!times.empty() && !(*time_s > times.back()))
      table.fail(fmt::format("time {} s after {} s: times must increase", *time_s, times.back()));
    times.push_back(*time_s);
    Eigen::RowVectorXd row(4 * static_cast<Eigen::Index>(series.names.size()));
    for (std::size_t k = 0; k < series.names.size(); ++k) {
      row.segment<4>(4 * static_cast<Eigen::Index>(k)) =
          quaternion_of(table, (*fields)[k + 1], series.names[k]);
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) table.fail("the table has no rows");
  series.time_s =
      Eigen::Map<Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size()));
  series.quaternions.resize(series.time_s.size(), rows.front().size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    series.quaternions.row(static_cast<Eigen::Index>(i)) = rows[i];
  return series;
}

}  // namespace myoid::recording
