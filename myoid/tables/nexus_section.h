#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/tables/table_layout.h"

namespace myoid::recording {

/// A section of a table that Vicon Nexus exports. It has a title, a rate, a row of groups (devices or markers, each
/// above its first column), a row of labels that begins with "Frame", a row of units, rows of numbers and a blank line.
struct NexusSection {
  char separator = ',';
  double rate_hz = 0.0;                            ///< 0 where it is missing.
  std::size_t labels_line = 0;                     ///< Counted from 0.
  std::vector<std::string> groups, labels, units;  ///< `units` is empty if the row is missing.
  std::size_t first_row = 0, end_row = 0;
  std::vector<Repair> repairs;
};

/// Finds the section of this title ("Devices", "Trajectories"); empty if the text has none. Throws
/// ReadError where the row that begins with "Frame" is missing.
[[nodiscard]] std::optional<NexusSection> nexus_section(const TableText& text,
                                                        std::string_view title,
                                                        const std::filesystem::path& path);

/// Returns the rate of the cameras from the section "Trajectories", 0 without one.
[[nodiscard]] double nexus_frame_rate(const TableText& text);

/// Returns width, clock columns and rows of a section. The columns behind Frame and Sub Frame
/// become channels without names.
[[nodiscard]] TableLayout layout_of(const NexusSection& section);

}  // namespace myoid::recording
