#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/tables/table_layout.h"

namespace myoid::recording {

/// A section of a table that Vicon Nexus exports: its title, a rate, a row of groups (devices or
/// markers, each above its first column), a row of labels that begins with "Frame", a row of units,
/// rows of numbers, a blank line.
struct NexusSection {
  char separator = ',';
  double rate_hz = 0.0;                            ///< 0 where it is missing.
  std::size_t labels_line = 0;                     ///< Counted from 0.
  std::vector<std::string> groups, labels, units;  ///< `units` is empty where the row is missing.
  std::size_t first_row = 0, end_row = 0;
  std::vector<Repair> repairs;
};

/// The section of this title ("Devices", "Trajectories"); empty if the text has none. Throws
/// ReadError where the row that begins with "Frame" is missing.
[[nodiscard]] std::optional<NexusSection> nexus_section(const TableText& text,
                                                        std::string_view title,
                                                        const std::filesystem::path& path);

/// The rate of the cameras, by the section "Trajectories"; 0 if there is none.
[[nodiscard]] double nexus_frame_rate(const TableText& text);

/// Width, clock columns and rows of a section; the columns behind Frame and Sub Frame are channels
/// without a name.
[[nodiscard]] TableLayout layout_of(const NexusSection& section);

}  // namespace myoid::recording
