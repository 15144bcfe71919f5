#include "myoid/page/tables.h"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/files/quoted_text.h"

namespace myoid::page {
namespace {

using ground::csv_cell;

std::string csv_number(const std::vector<double>& values, std::size_t k) {
  return k < values.size() && std::isfinite(values[k]) ? fmt::format("{}", values[k]) : std::string();
}

}  // namespace

std::string csv_line(const std::vector<std::string>& cells) {
  std::string text;
  for (std::size_t c = 0; c < cells.size(); ++c) text += (c == 0 ? "" : ",") + csv_cell(cells[c]);
  return text + '\n';
}

std::string table_csv(const Table& table) {
  std::string text = csv_line(table.columns);
  for (const std::vector<Cell>& row : table.rows) {
    std::vector<std::string> texts;
    for (const Cell& cell : row) texts.push_back(cell.text);
    text += csv_line(texts);
  }
  return text;
}

std::vector<Cell> text_row(std::vector<std::string> texts) {
  std::vector<Cell> row;
  for (std::string& text : texts) row.push_back({std::move(text)});
  return row;
}

std::string figure_csv(const Figure& figure) {
  bool bounds = false;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      bounds = bounds || !series.y_lower.empty() || !series.y_upper.empty();
    }
  }
  std::string text;
  for (const std::string& comment : figure.comments) text += "# " + comment + '\n';
  text += bounds ? "panel,series,role,x,y,y_lower,y_upper\n" : "panel,series,role,x,y\n";
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      const std::string head =
          csv_cell(panel.title) + ',' + csv_cell(series.name) + ',' + std::string(name(series.role));
      for (std::size_t k = 0; k < series.x.size(); ++k) {
        text += head + ',' + csv_number(series.x, k) + ',' + csv_number(series.y, k);
        if (bounds) text += ',' + csv_number(series.y_lower, k) + ',' + csv_number(series.y_upper, k);
        text += '\n';
      }
    }
  }
  return text;
}

// In the order of the enumerators.

std::string_view name(Role role) {
  static constexpr std::array<std::string_view, 10> kNames{"reference", "literature", "identified", "truth", "raw",
                                                           "band",      "unseen",     "range",      "norm",  "points"};
  return kNames[static_cast<std::size_t>(role)];
}

std::string_view name(Badge badge) {
  static constexpr std::array<std::string_view, 6> kNames{"none", "good", "weak", "bad", "info", "repeat"};
  return kNames[static_cast<std::size_t>(badge)];
}

std::string_view name(GateStatus status) {
  static constexpr std::array<std::string_view, 4> kNames{"pass", "warn", "fail", "info"};
  return kNames[static_cast<std::size_t>(status)];
}

std::string_view spelled(GateStatus status) {
  static constexpr std::array<std::string_view, 4> kWords{"passed", "caution", "failed", "note"};
  return kWords[static_cast<std::size_t>(status)];
}

}  // namespace myoid::page
