#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/tables/table_layout.h"

namespace myoid::recording {

/// Where the markers of a table stand: the channels of `table` are X, Y and Z of each in turn.
struct MarkerLayout {
  TableLayout table;
  std::vector<std::string> names;  ///< As written; one may be empty.
  std::string unit;                ///< As written; empty where none is stated.
  bool zero_is_missing = false;
};

/// The layout of a table of markers: Vicon Nexus (.csv with a section "Trajectories"), Qualisys
/// (.tsv, DATA_INCLUDED 3D), BTS (.emt, "Point 3D tracks"), OptiTrack Motive (.csv), NDI First
/// Principles (.csv: "NAME x", "NAME y", "NAME z" and a collection frequency). Empty for other
/// texts. Throws ReadError with the line where the header of such a table lacks a row, or names and
/// columns do not go together.
[[nodiscard]] std::optional<MarkerLayout> marker_layout(const TableText& text,
                                                        const std::filesystem::path& path);

}  // namespace myoid::recording
