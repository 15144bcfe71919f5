#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/recording/tables/table_layout.h"

namespace myoid::recording {

/// A section of a table that Vicon Nexus exports. It has a title, a rate, a row of groups (devices or markers, each
/// above its first column), a row of labels that begins with "Frame", a row of units, rows of numbers and a blank line.
struct NexusSection {
  std::vector<std::string> groups, labels, units;  ///< `units` is empty if the row is missing.
  /// Rate (0 where it is missing), clock and rows. The columns behind Frame and Sub Frame are channels without names.
  TableLayout layout;
};

/// Finds the section of this title ("Devices", "Trajectories"); empty if the text has none. Throws
/// ReadError where the row that begins with "Frame" is missing.
[[nodiscard]] std::optional<NexusSection> nexus_section(const TableText& text,
                                                        std::string_view title,
                                                        const std::filesystem::path& path);

/// Returns the rate of the cameras from the section "Trajectories", 0 without one.
[[nodiscard]] double nexus_frame_rate(const TableText& text);

}  // namespace myoid::recording
