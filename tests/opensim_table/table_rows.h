#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/core/time_series.h"

namespace myoid::opensim_table {

/// The largest difference of two tables and where it is; `any`: they have a column in common.
struct Worst {
  double error = 0.0, relative = 0.0;
  std::string column;
  double time = 0.0;
  bool any = false;
};

/// Worst difference of the columns that both have; `skip` rows at both ends are left out.
inline Worst compare(const TimeSeries& ours, const TimeSeries& theirs, Eigen::Index skip, const auto& their_name) {
  Worst worst;
  for (const Channel& channel : ours.channels()) {
    const auto column = theirs.find(their_name(channel.name));
    if (!column) continue;
    const auto mine = ours.column(channel.name);
    const double peak = theirs.values().col(*column).cwiseAbs().maxCoeff();
    for (Eigen::Index i = skip; i < theirs.sample_count() - skip; ++i) {
      Eigen::Index row = 0;
      (ours.time_s().array() - theirs.time_s()[i]).abs().minCoeff(&row);
      if (std::abs(ours.time_s()[row] - theirs.time_s()[i]) > 1e-5) continue;
      const double error = std::abs(mine[row] - theirs.values()(i, *column));
      worst.any = true;
      if (!(error <= worst.error)) {
        worst.error = error;
        worst.column = channel.name;
        worst.time = theirs.time_s()[i];
      }
      worst.relative = std::max(worst.relative, error / std::max(peak, 1e-12));
    }
  }
  return worst;
}

inline std::string same(const std::string& name) { return name; }

/// "muscle|quantity" of a path in the model's force set.
inline std::string in_force_set(std::string name) {
  if (name.starts_with("/forceset/")) {
    const auto bar = name.rfind('|');
    std::string owner = name.substr(10, name.find('/', 10) - 10);
    return owner + name.substr(bar);
  }
  return name;
}

/// Where a row belongs, and whether to name its worst column.
struct Rows {
  std::string setup;
  bool columns = false;
  void add(const std::string& what, const std::string& error, const std::string& relative) const {
    fmt::print("| {} | {} | {} | {} |\n", setup, what, error, relative);
  }
  void add(const std::string& what, const Worst& worst, const std::string& unit) const {
    if (!worst.any) return;
    std::string text = fmt::format("{:.1e}", worst.error);
    if (!unit.empty()) text += " " + unit;
    if (columns) text += fmt::format(" ({} at {} s)", worst.column, worst.time);
    add(what, text, fmt::format("{:.1e}", worst.relative));
  }
};

inline std::string code(const std::filesystem::path& file) { return "`" + file.filename().string() + "`"; }

}  // namespace myoid::opensim_table
