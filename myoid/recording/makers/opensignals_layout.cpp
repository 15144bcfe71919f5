#include "myoid/recording/makers/opensignals_layout.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

std::vector<std::string> texts_of(const nlohmann::ordered_json& device, const char* key) {
  std::vector<std::string> texts;
  if (!device.contains(key) || !device[key].is_array()) return texts;
  for (const auto& entry : device[key])
    texts.push_back(entry.is_string() ? entry.get<std::string>() : json_text(entry, -1));
  return texts;
}

/// Returns the name of a channel: its label, behind the name of its sensor unless that is EMG or says nothing.
std::string channel_name(const std::string& label, const std::string& sensor) {
  const std::string word = lower(sensor);
  const bool plain = word.empty() || word == "raw" || word == "custom" || word.find("emg") != std::string::npos ||
                     lower(label).find(word) != std::string::npos;
  return plain ? label : sensor + " " + label;
}

/// Appends the columns of a device; its channels are the last of them.
void take_device(const nlohmann::ordered_json& device, std::vector<TableColumn>& columns) {
  const auto names = texts_of(device, "column");
  const auto labels = texts_of(device, "label");
  const auto sensors = texts_of(device, "sensor");
  const std::size_t others = names.size() - std::min(labels.size(), names.size());
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (equal_ignoring_case(names[c], "nSeq")) {
      columns.push_back({Kind::left_out, names[c]});
    } else if (c < others) {
      columns.push_back({Kind::channel, names[c]});
    } else {
      const std::size_t k = c - others;
      columns.push_back({Kind::channel, channel_name(labels[k], k < sensors.size() ? sensors[k] : "")});
    }
  }
}

std::optional<std::size_t> line_that_starts(const TableText& text, std::string_view with) {
  constexpr std::size_t kHeader = 20;
  for (std::size_t n = 0; n < std::min(text.lines.size(), kHeader); ++n)
    if (trim(text.lines[n]).starts_with(with)) return n;
  return std::nullopt;
}

}  // namespace

std::optional<TableLayout> opensignals_layout(const TableText& text, const std::filesystem::path& path) {
  if (!line_that_starts(text, "# OpenSignals")) return std::nullopt;
  const auto json = line_that_starts(text, "# {"), end = line_that_starts(text, "# EndOfHeader");
  if (!json || !end) throw ReadError(path, 1, "the header of OpenSignals lacks its line of JSON or '# EndOfHeader'");
  nlohmann::ordered_json devices;
  try {
    devices = parse_ordered_json(trim(text.lines[*json]).substr(1));
  } catch (const nlohmann::json::exception&) {
    throw ReadError(path, *json + 1, "the line behind '#' is no JSON: it is cut off; export the recording again");
  }
  TableLayout layout;
  layout.separator = '\t';
  layout.names_line = *json;
  layout.first_row = *end + 1;
  layout.end_row = text.lines.size();
  bool counts = false;
  for (const auto& device : devices) {
    if (!device.is_object() || !device.contains("sampling rate") || !device["sampling rate"].is_number()) continue;
    const double rate_hz = device["sampling rate"].get<double>();
    if (layout.rate_hz > 0.0 && rate_hz != layout.rate_hz)
      throw ReadError(path, *json + 1, "devices with {} and {} Hz share the rows; export each device alone",
                      layout.rate_hz, rate_hz);
    layout.rate_hz = rate_hz;
    counts = counts || !device.contains("convertedValues") || device["convertedValues"] == 0;
    take_device(device, layout.columns);
  }
  if (layout.columns.empty() || !(layout.rate_hz > 0.0))
    throw ReadError(path, *json + 1, "expected 'sampling rate' and 'column' of a device in the JSON of the header");
  if (layout.first_row < text.lines.size()) {
    const auto cells = filled_cells(text.lines[layout.first_row], '\t');
    if (cells.size() != layout.columns.size())
      throw ReadError(path, layout.first_row + 1, "{} cells, where the header names {} columns", cells.size(),
                      layout.columns.size());
  }
  if (counts) layout.repairs.push_back({*json + 1, "the samples are counts of the converter: they have no unit"});
  return layout;
}

}  // namespace myoid::recording
