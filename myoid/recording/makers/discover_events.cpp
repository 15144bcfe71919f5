#include "myoid/recording/makers/discover_events.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::recording {
namespace {

constexpr std::string_view kOwnClock = "Time Series (s)";
constexpr std::size_t kDiscoverHeader = 20;  // more lines than the header has

/// Returns the line of the channels' names, each with a clock of its own.
std::optional<std::size_t> names_line_of(const TableText& text) {
  bool discover = false;
  for (std::size_t n = 0; n < std::min(text.lines.size(), kDiscoverHeader); ++n) {
    discover = discover || text.lines[n].find("Trigno Discover") != std::string_view::npos;
    if (discover && text.lines[n].find(kOwnClock) != std::string_view::npos) return n;
  }
  return std::nullopt;
}

/// Returns the part of a line in front of its cell number `cells`, without the separator between.
std::string_view first_cells(std::string_view line, char separator, std::size_t cells) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == separator && !quoted && --cells == 0) return line.substr(0, i);
  }
  return line;
}

/// The columns of the table of events.
struct EventColumns {
  std::size_t name = 0, label = 0, type = 0, time = 0;  ///< 0: there is none.
};

std::string cell(const std::vector<std::string>& cells, std::size_t c) { return c < cells.size() ? cells[c] : ""; }

std::optional<double> seconds(const std::string& text) {
  const auto value = parse_number(text);
  return value ? value : parse_comma_number(text);
}

}  // namespace

std::vector<Event> take_discover_events(TableText& text) {
  std::vector<Event> events;
  const auto names = names_line_of(text);
  if (!names) return events;
  const std::string_view line = text.lines[*names];
  const std::size_t behind = line.find(kOwnClock) + kOwnClock.size();
  const std::size_t at = std::min(line.find_first_of(",;\t", behind), line.size() - 1);
  const char separator = line[at];
  const auto own = filled_cells(line, separator);
  const std::size_t first = static_cast<std::size_t>(
      std::ranges::find_if(own, [](const std::string& c) { return c == "Type" || c == "Name" || c == "Label"; }) -
      own.begin());
  const std::size_t channels = std::min(own.size(), first);
  EventColumns columns;
  for (std::size_t n = *names; n < std::min(text.lines.size(), *names + 4); ++n) {
    const auto cells = cells_of(text.lines[n], separator);
    for (std::size_t c = channels; c < cells.size(); ++c) {
      const std::string word = lower(cells[c]);
      if (word == "name") columns.name = c;
      if (word == "label") columns.label = c;
      if (word == "type") columns.type = c;
      if (word.starts_with("time") && columns.time == 0) columns.time = c;
    }
  }
  if (columns.time == 0) return events;
  for (std::size_t n = *names; n < text.lines.size(); ++n) {
    const std::string_view kept = first_cells(text.lines[n], separator, channels);
    if (kept.size() == text.lines[n].size()) continue;
    const auto cells = cells_of(text.lines[n], separator);
    text.lines[n] = kept;
    const auto time_s = seconds(cell(cells, columns.time));
    if (!time_s || n < *names + 1) continue;
    std::string label;
    for (const std::size_t c : {columns.label, columns.name, columns.type})
      if (label.empty() && c > 0) label = cell(cells, c);
    events.push_back({*time_s, label, "", ""});
  }
  return events;
}

}  // namespace myoid::recording
