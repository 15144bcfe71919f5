#include "myoid/recording/makers/nexus_section.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

/// Returns the word of a line that holds one word only.
std::string_view lone_word(std::string_view line) {
  line = trim(line);
  const std::size_t end = line.find_first_of(",\t;");
  if (end == std::string_view::npos) return line;
  return line.substr(end).find_first_not_of(",\t; \"") == std::string_view::npos ? trim(line.substr(0, end))
                                                                                 : std::string_view();
}

std::optional<double> lone_number(std::string_view line) { return parse_number(lone_word(line)); }

std::optional<std::size_t> title_line(const TableText& text, std::string_view title) {
  for (std::size_t n = 0; n < text.lines.size(); ++n) {
    if (lone_word(text.lines[n]) == title) return n;
  }
  return std::nullopt;
}

/// Returns the separator after "Frame" at the beginning of a line, 0 if the line does not begin so.
char separator_behind_frame(std::string_view line) {
  line = trim(line);
  if (line.starts_with('"')) line.remove_prefix(1);
  constexpr std::string_view kWord = "frame";
  if (line.size() <= kWord.size() || !equal_ignoring_case(line.substr(0, kWord.size()), kWord)) return '\0';
  line = line.substr(kWord.size());
  while (line.starts_with('"') || line.starts_with(' ')) line.remove_prefix(1);
  return line.starts_with(',') || line.starts_with(';') || line.starts_with('\t') ? line.front() : '\0';
}

/// Notes the titles of sections that no reader takes.
void state_other_sections(const TableText& text, std::string_view read, std::vector<Repair>& repairs) {
  std::vector<std::string> others;
  for (std::size_t n = 0; n + 1 < text.lines.size(); ++n) {
    const std::string_view title = lone_word(text.lines[n]);
    if (title.empty() || parse_number(title) || title == read || title == "Devices" || title == "Trajectories" ||
        !lone_number(text.lines[n + 1]))
      continue;
    others.emplace_back(title);
  }
  if (!others.empty()) repairs.push_back({0, fmt::format("sections that are not read: {}", fmt::join(others, ", "))});
}

}  // namespace

std::optional<NexusSection> nexus_section(const TableText& text,
                                          std::string_view title,
                                          const std::filesystem::path& path) {
  const auto at = title_line(text, title);
  if (!at) return std::nullopt;
  constexpr std::size_t kHeader = 5;
  std::size_t n = *at + 1;
  const std::size_t last = std::min(text.lines.size(), *at + 1 + kHeader);
  while (n < last && separator_behind_frame(text.lines[n]) == '\0') ++n;
  if (n >= last)
    throw ReadError(
        path, *at + 1,
        fmt::format("the section '{}' has no row that begins with 'Frame, Sub Frame' below its title; export it again",
                    title));
  NexusSection section;
  TableLayout& layout = section.layout;
  layout.separator = separator_behind_frame(text.lines[n]);
  layout.names_line = n;
  section.labels = filled_cells(text.lines[n], layout.separator);
  for (std::size_t k = *at + 1; k < n; ++k) {
    if (const auto rate = lone_number(text.lines[k]))
      layout.rate_hz = *rate;
    else if (!has_no_cell(text.lines[k], layout.separator))
      section.groups = filled_cells(text.lines[k], layout.separator);
  }
  layout.first_row = n + 1;
  if (n + 1 < text.lines.size()) {
    const auto units = cells_of(text.lines[n + 1], layout.separator);
    if (units.size() > 1 && !parse_number(units[0])) {
      section.units = filled_cells(text.lines[n + 1], layout.separator);
      ++layout.first_row;
    } else {
      layout.repairs.push_back({n + 2, "the row of units is missing"});
    }
  }
  layout.end_row = end_of_block(text, layout.first_row, layout.separator);
  state_other_sections(text, title, layout.repairs);
  layout.columns.resize(std::max(section.labels.size(), section.units.size()));
  layout.columns[0] = {TableColumn::Kind::frame, "Frame"};
  if (section.labels.size() > 1) {
    const std::string second = lower(section.labels[1]);
    if (second == "sub frame" || second == "subframe") layout.columns[1] = {TableColumn::Kind::sub_frame, "Sub Frame"};
  }
  return section;
}

double nexus_frame_rate(const TableText& text) {
  const auto at = title_line(text, "Trajectories");
  if (!at || *at + 1 >= text.lines.size()) return 0.0;
  return lone_number(text.lines[*at + 1]).value_or(0.0);
}

}  // namespace myoid::recording
