#include "myoid/page/tables.h"

#include <algorithm>
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

/// Returns the number of characters of a text in UTF-8.
std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
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

std::string table_text(const Table& table) {
  constexpr std::size_t kMostInCell = 100;
  std::vector<std::size_t> width;
  std::vector<std::vector<std::string>> lines(1 + table.rows.size());
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.columns[c] == "why") continue;
    lines[0].push_back(table.columns[c]);
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      lines[1 + r].push_back(elided(ground::visible_text(table.rows[r][c].text), kMostInCell));
    std::size_t widest = 0;
    for (const std::vector<std::string>& line : lines) widest = std::max(widest, characters(line.back()));
    width.push_back(widest);
  }
  std::string text = table.title.empty() ? "" : table.title + '\n';
  for (const std::vector<std::string>& line : lines) {
    std::string cells;
    for (std::size_t c = 0; c < line.size(); ++c)
      cells += line[c] + std::string(width[c] - characters(line[c]) + 2, ' ');
    text += cells.substr(0, cells.find_last_not_of(' ') + 1) + '\n';
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
