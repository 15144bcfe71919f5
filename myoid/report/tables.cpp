#include "myoid/report/tables.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace myoid::report {
namespace {

std::string csv_cell(std::string_view text) {
  return text.find_first_of(",\"\n\r") == std::string_view::npos ? std::string(text) : csv_quoted(text);
}

std::string csv_number(const std::vector<double>& values, std::size_t k) {
  return k < values.size() && std::isfinite(values[k]) ? fmt::format("{}", values[k]) : std::string();
}

}  // namespace

std::string csv_quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string table_csv(const Table& table) {
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    text += (c == 0 ? "" : ",") + csv_cell(table.columns[c]);
  }
  text += '\n';
  for (const std::vector<Cell>& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      text += (c == 0 ? "" : ",") + csv_cell(row[c].text);
    }
    text += '\n';
  }
  return text;
}

std::vector<Cell> text_row(std::vector<std::string> texts) {
  std::vector<Cell> row;
  for (std::string& text : texts) row.push_back({std::move(text), Badge::none, {}});
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
        if (bounds) {
          text += ',' + csv_number(series.y_lower, k) + ',' + csv_number(series.y_upper, k);
        }
        text += '\n';
      }
    }
  }
  return text;
}

std::string_view name(Role role) {
  switch (role) {
    case Role::reference:
      return "reference";
    case Role::literature:
      return "literature";
    case Role::identified:
      return "identified";
    case Role::truth:
      return "truth";
    case Role::raw:
      return "raw";
    case Role::band:
      return "band";
    case Role::unseen:
      return "unseen";
    case Role::range:
      return "range";
    case Role::norm:
      return "norm";
    case Role::points:
      return "points";
  }
  return "";
}

std::string_view name(Badge badge) {
  switch (badge) {
    case Badge::none:
      return "none";
    case Badge::good:
      return "good";
    case Badge::weak:
      return "weak";
    case Badge::bad:
      return "bad";
    case Badge::info:
      return "info";
  }
  return "";
}

std::string_view name(GateStatus status) {
  switch (status) {
    case GateStatus::pass:
      return "pass";
    case GateStatus::warn:
      return "warn";
    case GateStatus::fail:
      return "fail";
    case GateStatus::info:
      return "info";
  }
  return "";
}

}  // namespace myoid::report
