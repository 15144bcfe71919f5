#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/recording/tables/table_layout.h"

namespace myoid::recording {

/// Layout of a table of markers: the channels of `table` are X, Y and Z of each marker in turn.
struct MarkerLayout {
  TableLayout table;
  std::vector<std::string> names;  ///< As written in the file; a name may be empty.
  std::string unit;                ///< As written; empty where none is stated.
  bool zero_is_missing = false;
};

/// Returns the name in "Wrist X", "Wrist.x", "Wrist_x" or "Wrist:X" if the ending is this axis; an empty name for "X"
/// or
/// ".X".
[[nodiscard]] std::optional<std::string> name_before_axis(const std::string& cell, char axis);

/// Returns true if the cells from `c` on are NAME x, NAME y and NAME z of one name.
[[nodiscard]] bool is_axis_triple(const std::vector<std::string>& header, std::size_t c);

/// Returns the layout of a table of markers: Vicon Nexus (.csv with a section "Trajectories"), Qualisys (.tsv,
/// DATA_INCLUDED 3D), BTS (.emt, "Point 3D tracks"), OptiTrack Motive (.csv), NDI First Principles (.csv: "NAME x",
/// "NAME y", "NAME z" and a collection frequency). Empty for other texts. Throws ReadError with the line where the
/// header of such a table lacks a row, or where names and columns do not match.
[[nodiscard]] std::optional<MarkerLayout> marker_layout(const TableText& text, const std::filesystem::path& path);

}  // namespace myoid::recording
