#include "myoid/study/intake/norm.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/csv_reader.h"

namespace myoid::study {
namespace {

constexpr std::string_view kTorque = "_moment";

/// Finds the columns of a norm's table by name, and separates their units.
class NormTable {
 public:
  explicit NormTable(const std::filesystem::path& file) : file_(file), table_(recording::read_csv_table(file)) {
    for (const std::string& header : table_.names) {
      const std::size_t bracket = header.find_first_of("[(");
      const std::string name = header.substr(0, header.find_last_not_of(' ', bracket - 1) + 1);
      const bool has_unit = bracket != std::string::npos && bracket > 0;
      names_.push_back(has_unit ? name : header);
      units_.push_back(has_unit ? header.substr(bracket + 1, header.size() - bracket - 2) : "");
    }
    if (table_.rows.size() < 2) refuse(table_.header_line, "expected two rows or more");
  }

  [[noreturn]] void refuse(std::size_t line, const std::string& message) const {
    throw ReadError(file_, line, message);
  }
  [[noreturn]] void refuse_header(const std::string& message) const { refuse(table_.header_line, message); }

  [[nodiscard]] bool has(const std::string& name) const { return std::ranges::find(names_, name) != names_.end(); }
  [[nodiscard]] const std::string& unit(const std::string& name) const { return units_[column(name)]; }
  [[nodiscard]] std::size_t line(Eigen::Index row) const { return table_.lines[static_cast<std::size_t>(row)]; }

  [[nodiscard]] Eigen::VectorXd values(const std::string& name) const {
    const std::size_t c = column(name);
    Eigen::VectorXd values(static_cast<Eigen::Index>(table_.rows.size()));
    for (std::size_t r = 0; r < table_.rows.size(); ++r) {
      std::string cell = table_.rows[r][c];
      if (table_.separator != ',') std::ranges::replace(cell, ',', '.');
      const std::optional<double> number = parse_number(cell);
      if (!number || !std::isfinite(*number))
        refuse(table_.lines[r], fmt::format("column '{}': expected a number, found '{}'", name, cell));
      values[static_cast<Eigen::Index>(r)] = *number;
    }
    return values;
  }

 private:
  [[nodiscard]] std::size_t column(const std::string& name) const {
    const auto it = std::ranges::find(names_, name);
    if (it == names_.end()) refuse_header(fmt::format("no column '{}'{}", name, not_among(name, names_)));
    return static_cast<std::size_t>(it - names_.begin());
  }

  std::filesystem::path file_;
  recording::CsvTable table_;
  std::vector<std::string> names_, units_;
};

Eigen::VectorXd read_percent(const NormTable& table) {
  const Eigen::VectorXd percent = table.values("percent");
  for (Eigen::Index i = 0; i < percent.size(); ++i) {
    if (percent[i] < 0.0 || percent[i] > 100.0 || (i > 0 && percent[i] <= percent[i - 1]))
      table.refuse(
          table.line(i),
          fmt::format("percent is {}; expected numbers that rise from 0, the movement's begin, to 100, its end",
                      percent[i]));
  }
  return percent;
}

/// Returns the factor from the unit of a column to deg or N m.
double factor_of(const NormTable& table, const std::string& name, bool torque, const Study& study) {
  const std::string& unit = table.unit(name);
  if (unit.empty()) return 1.0;
  const auto known = parse_file_unit(unit);
  if (torque) {
    if (known && known->unit == Unit::newton_meter) return known->to_si;
    if (unit == "N m/kg" || unit == "Nm/kg" || unit == "N.m/kg") {
      if (study.subject.mass_kg) return *study.subject.mass_kg;
      table.refuse_header(
          fmt::format("column '{}' is in {}; give the person's mass: mass_kg in [subject]", name, unit));
    }
  } else {
    if (known && known->unit == Unit::radian) return known->to_si / kDegree;
  }
  table.refuse_header(
      fmt::format("column '{}' is in '{}'; expected {}", name, unit, torque ? "N m or N m/kg" : "deg or rad"));
}

NormCurve read_curve(const NormTable& table, const std::string& coordinate, bool torque, const Study& study) {
  const std::string name = coordinate + std::string(torque ? kTorque : "");
  const std::string mean = name + "_mean", sd = name + "_sd";
  NormCurve curve{coordinate, torque, factor_of(table, mean, torque, study) * table.values(mean),
                  factor_of(table, sd, torque, study) * table.values(sd)};
  for (Eigen::Index i = 0; i < curve.sd.size(); ++i) {
    if (curve.sd[i] < 0.0) table.refuse(table.line(i), fmt::format("column '{}': a standard deviation below 0", sd));
  }
  return curve;
}

}  // namespace

Norm read_norm(const NormSpec& spec, const Study& study) {
  const NormTable table(spec.file);
  Norm norm{spec.name, spec.trials, read_percent(table), {}};
  const std::vector<std::string> coordinates = study_coordinates(study.model);
  for (const std::string& coordinate : coordinates) {
    for (const bool torque : {false, true}) {
      const std::string name = coordinate + std::string(torque ? kTorque : "");
      if (table.has(name + "_mean") || table.has(name + "_sd"))
        norm.curves.push_back(read_curve(table, coordinate, torque, study));
    }
  }
  if (norm.curves.empty())
    table.refuse_header(
        fmt::format("no column is of a coordinate of the study; expected NAME_mean and NAME_sd, NAME being {} [deg] or "
                    "{}_moment [N m]",
                    fmt::join(coordinates, " or "), coordinates.front()));
  return norm;
}

}  // namespace myoid::study
