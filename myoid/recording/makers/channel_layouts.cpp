#include "myoid/recording/makers/channel_layouts.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/makers/labchart_layout.h"
#include "myoid/recording/makers/nexus_section.h"
#include "myoid/recording/makers/opensignals_layout.h"
#include "myoid/recording/tables/channel_labels.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

std::optional<TableLayout> nexus_devices(const TableText& text, const std::filesystem::path& path) {
  const auto section = nexus_section(text, "Devices", path);
  if (!section) return std::nullopt;
  TableLayout layout = section->layout;
  if (!(layout.rate_hz > 0.0))
    throw ReadError(path, layout.names_line + 1,
                    "the section 'Devices' states no rate; write it in the line below the title");
  layout.frame_rate_hz = nexus_frame_rate(text);
  layout.repairs.push_back({layout.names_line + 1, "the section 'Devices' is read"});
  for (std::size_t c = 0; c < layout.columns.size(); ++c) {
    TableColumn& column = layout.columns[c];
    if (column.kind != Kind::channel) continue;
    column.name = c < section->labels.size() ? section->labels[c] : "";
    if (c < section->units.size()) column.unit = unit_in_cell(section->units[c]);
  }
  put_devices_before_names(layout, section->groups);
  return layout;
}

/// Finds angles, moments and powers of a model in Nexus' export: "PERSON:LKneeAngles" above X, Y and Z, or, where there
/// are none, the angles of its skeleton.
std::optional<TableLayout> nexus_outputs(const TableText& text, const std::filesystem::path& path) {
  const char* title = "Model Outputs";
  auto section = nexus_section(text, title, path);
  if (!section) section = nexus_section(text, title = "Joints", path);
  if (!section) return std::nullopt;
  TableLayout layout = section->layout;
  layout.repairs.push_back(
      {layout.names_line + 1, fmt::format("the section '{}' is read: results of Nexus, no markers", title)});
  std::string output;
  for (std::size_t c = 0; c < layout.columns.size(); ++c) {
    TableColumn& column = layout.columns[c];
    if (c < section->groups.size() && !section->groups[c].empty()) output = section->groups[c];
    if (column.kind != Kind::channel) continue;
    column.name = c < section->labels.size() ? fmt::format("{} {}", output, section->labels[c]) : output;
    if (c < section->units.size()) column.unit = unit_in_cell(section->units[c]);
  }
  return layout;
}

/// Finds the first row of numbers among the first `most` lines from `begin` on.
std::optional<std::size_t> first_numbers(const TableText& text, std::size_t begin, std::size_t most, char separator) {
  for (std::size_t n = begin; n < std::min(most, text.lines.size()); ++n) {
    const auto cells = cells_of(text.lines[n], separator);
    if (parse_number(cells[0]) || (separator != ',' && parse_comma_number(cells[0]))) return n;
  }
  return std::nullopt;
}

/// Returns the columns of rows that hold `names`, and before these a frame, a time or both where a row has more cells.
std::vector<TableColumn> columns_behind_clock(const std::vector<std::string>& names,
                                              const TableText& text,
                                              const TableLayout& layout,
                                              const std::filesystem::path& path) {
  const auto first = filled_cells(text.lines[layout.first_row], layout.separator);
  const std::size_t more = first.size() > names.size() ? first.size() - names.size() : 0;
  if (more > 2)
    throw ReadError(path, layout.first_row + 1,
                    fmt::format("{} cells, where line {} names {} channels: expected these, with a frame and a time "
                                "before them at most",
                                first.size(), layout.names_line + 1, names.size()));
  std::vector<TableColumn> columns;
  const auto begin = parse_number(first[0]);
  const bool counts = begin && *begin == std::floor(*begin) && *begin > 0.0;  // a time begins at 0 or within a second
  if (more == 2 || (more == 1 && counts)) columns.push_back({Kind::frame, "Frame"});
  if (more == 2 || (more == 1 && !counts)) columns.push_back({Kind::time, "Time"});
  for (TableColumn& column : take_labels_apart(names)) columns.push_back(std::move(column));
  return columns;
}

/// Finds Qualisys's layout of channels and of derived quantities: a line CHANNEL_NAMES or DATA_TYPES, then perhaps a
/// row "SAMPLE, TIME, names"; or a row of names alone above the numbers, as for force plates.
std::optional<TableLayout> qualisys_channels(const TableText& text, const std::filesystem::path& path) {
  if (text.lines.empty() || !trim(text.lines[0]).starts_with("NO_OF_")) return std::nullopt;
  constexpr std::size_t kHeader = 40;
  TableLayout layout;
  layout.separator = '\t';
  std::vector<std::string> names, head;
  std::size_t begin = 0;
  for (std::size_t n = 0; n < std::min(text.lines.size(), kHeader); ++n) {
    auto cells = filled_cells(text.lines[n], '\t');
    if (cells.empty()) continue;
    if (cells[0] == "CHANNEL_NAMES" || cells[0] == "DATA_TYPES") {
      names.assign(cells.begin() + 1, cells.end());
      layout.names_line = n;
      begin = n + 1;
    } else if (equal_ignoring_case(cells[0], "SAMPLE") || equal_ignoring_case(cells[0], "TIME")) {
      head = std::move(cells);
      layout.names_line = n;
      begin = n + 1;
      break;
    }
  }
  const bool of_samples = trim(text.lines[0]).starts_with("NO_OF_SAMPLES");
  if (names.empty() && head.empty() && !of_samples) return std::nullopt;
  const auto first = first_numbers(text, begin, begin + kHeader, '\t');
  if (names.empty() && head.empty()) {
    std::size_t above = first.value_or(0);
    while (above > 0 && trim(text.lines[above - 1]).empty()) --above;
    if (above > 0) head = filled_cells(text.lines[above - 1], '\t');
    if (!first || head.size() != filled_cells(text.lines[*first], '\t').size())
      throw ReadError(path, 1, "there is no line CHANNEL_NAMES, so no channel has a name");
    layout.names_line = above - 1;
  }
  if (!first) throw ReadError(path, begin, "there are no rows of numbers below the header");
  layout.first_row = *first;
  layout.end_row = end_of_block(text, *first, '\t');
  const std::size_t header = head.empty() ? *first : layout.names_line;
  layout.read_header(text, header,
                     {{"frequency"},
                      {"no_of_samples", "no_of_frames"},
                      {"total_no_of_channels", "no_of_channels", "no_of_data_types"}});
  if (!head.empty()) {
    layout.columns = take_labels_apart(head);
    set_kinds(layout);
  } else {
    layout.columns = columns_behind_clock(names, text, layout, path);
    layout.repairs.push_back(
        {layout.names_line + 1,
         fmt::format("the names come from {}", filled_cells(text.lines[layout.names_line], '\t').front())});
  }
  return layout;
}

/// Returns the samples per second of "0.5 msec/sample", "2000 samples/second" or "2 kHz".
std::optional<double> biopac_rate(std::string_view line) {
  const auto words = split_words(line);
  const auto amount = words.size() > 1 ? parse_number(words[0]) : std::nullopt;
  if (!amount || !(*amount > 0.0)) return std::nullopt;
  if (words[1] == "msec/sample") return 1e3 / *amount;
  if (words[1] == "sec/sample") return 1.0 / *amount;
  if (words[1] == "samples/second" || words[1] == "samples/sec" || words[1] == "Hz") return amount;
  if (words[1] == "kHz") return 1e3 * *amount;
  return std::nullopt;
}

/// Finds BIOPAC's layout: a file name, "0.5 msec/sample", "2 channels", name and unit of each
/// channel, "CH1 CH2", counts, rows.
std::optional<TableLayout> biopac_channels(const TableText& text, const std::filesystem::path& path) {
  if (text.lines.size() < 8) return std::nullopt;
  const auto rate = biopac_rate(text.lines[1]);
  const auto said = split_words(text.lines[2]);
  if (!rate || said.size() < 2 || !said[1].starts_with("channel")) return std::nullopt;
  const auto count = parse_number(said[0]);
  if (!count || !(*count >= 1.0 && *count <= 1000.0)) return std::nullopt;
  const auto channels = static_cast<std::size_t>(*count);
  const std::size_t head = 3 + 2 * channels;
  if (head + 2 >= text.lines.size())
    throw ReadError(path, 3, fmt::format("{} channels are stated, but the text ends before", *count));
  TableLayout layout;
  layout.separator = text.lines[head].find('\t') != std::string_view::npos ? '\t' : ',';
  const auto cells = filled_cells(text.lines[head], layout.separator);
  // A time column before the channels is ignored: the stated interval is more exact.
  if (cells.size() < channels || cells.size() > channels + 1)
    throw ReadError(
        path, head + 1,
        fmt::format("{} channels are stated in line 3, the row of columns has {}: a line of the header is lost", *count,
                    cells.size()));
  if (cells.size() > channels) layout.columns.push_back({Kind::left_out, cells[0]});
  for (std::size_t c = 0; c < channels; ++c)
    layout.columns.push_back(
        {Kind::channel, to_utf8(trim(text.lines[3 + 2 * c])), unit_in_cell(trim(text.lines[4 + 2 * c]))});
  const std::size_t left_out = cells.size() - channels;
  const auto counts = cells_of(text.lines[head + 1], layout.separator);
  if (counts.size() > left_out) layout.rows_said = parse_number(counts[left_out]);
  layout.names_line = head;
  layout.first_row = head + 2;
  layout.end_row = text.lines.size();
  layout.rate_hz = *rate;
  layout.short_row = ShortRow::ended;
  layout.repairs.push_back({2, fmt::format("{} Hz, names and units from the header", *rate)});
  return layout;
}

/// Finds BTS's layout: "Measure unit:" holds for all tracks.
std::optional<TableLayout> bts_tracks(const TableText& text, const std::filesystem::path& path) {
  if (text.lines.empty() || !trim(text.lines[0]).starts_with("BTS ASCII")) return std::nullopt;
  constexpr std::size_t kHeader = 40;
  for (std::size_t n = 1; n < std::min(text.lines.size(), kHeader); ++n) {
    const auto cells = filled_cells(text.lines[n], '\t');
    if (cells.empty() || !equal_ignoring_case(cells[0], "Frame")) continue;
    TableLayout layout;
    layout.set_rows_below(text, n, '\t');
    layout.read_header(text, n, {{"frequency"}, {"frames"}, {"tracks"}});
    const auto unit = unit_in_cell(stated_text(text, n, '\t', "measure unit"));
    layout.columns = take_labels_apart(cells);
    set_kinds(layout);
    if (!unit) layout.repairs.push_back({0, "the header states no unit ('Measure unit')"});
    for (TableColumn& column : layout.columns) {
      if (column.kind == Kind::channel && !column.unit) column.unit = unit;
    }
    return layout;
  }
  throw ReadError(path, 1, "there is no row of names that begins with 'Frame'");
}

/// Finds Visual3D's layout: rows of files, signals, types and folders above "ITEM X Y Z". The signal TIME is the clock,
/// where it was exported.
std::optional<TableLayout> visual3d_signals(const TableText& text, const std::filesystem::path& path) {
  constexpr std::size_t kHeader = 12, kAbove = 4;
  const auto row = [&](std::size_t n) { return cells_of(text.lines[n], '\t'); };
  std::size_t item = kAbove;
  while (item < std::min(text.lines.size(), kHeader) && row(item)[0] != "ITEM") ++item;
  if (item >= std::min(text.lines.size(), kHeader)) return std::nullopt;
  const auto files = row(item - 4), signals = row(item - 3), types = row(item - 2), axes = row(item);
  if (!files[0].empty() || files.size() < axes.size() || signals.size() < axes.size() || types.size() < axes.size())
    return std::nullopt;
  TableLayout layout;
  layout.set_rows_below(text, item, '\t');
  layout.columns.push_back({Kind::frame, "ITEM"});
  for (std::size_t c = 1; c < axes.size(); ++c) {
    if (files[c] != files[1])
      throw ReadError(path, item - 3, "'{}' and '{}' stand side by side: export each trial into a file of its own",
                      files[1], files[c]);
    const bool clock = types[c] == "FRAME_NUMBERS" && signals[c] == "TIME";
    layout.columns.push_back({clock ? Kind::time : Kind::channel, clock ? "TIME" : signals[c] + " " + axes[c]});
    if (clock) layout.columns.back().unit = ScaledUnit{Unit::second, 1.0};
  }
  const auto rates = rates_in_lines(std::span(text.lines).first(item - kAbove));
  if (!rates.empty()) layout.rate_hz = rates[0].hz;
  if (layout.count(Kind::time) == 0 && !(layout.rate_hz > 0.0))
    throw ReadError(path, item + 1,
                    "the rows have no time; export the signal TIME (FRAME_NUMBERS) too, or write a first line "
                    "'Sampling rate: 200 Hz'");
  return layout;
}

}  // namespace

std::optional<TableLayout> makers_layout(TableText& text, const std::filesystem::path& path) {
  for (const auto& known : {nexus_devices, qualisys_channels, biopac_channels, bts_tracks, opensignals_layout,
                            nexus_outputs, visual3d_signals}) {
    if (auto layout = known(text, path)) return layout;
  }
  return labchart_layout(text, path);
}

}  // namespace myoid::recording
