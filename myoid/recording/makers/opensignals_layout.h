#pragma once

#include <filesystem>
#include <optional>

#include "myoid/recording/tables/table_layout.h"

namespace myoid::recording {

/// Returns the layout of a text of OpenSignals (biosignalsplux, BITalino): "# OpenSignals Text File Format", a line of
/// JSON with rate, columns and labels of each device, "# EndOfHeader", rows without names. A channel is called by its
/// label, with its sensor before it unless that is EMG. The number of the sample, which begins anew after 15, is left
/// out. Empty for other texts. Throws ReadError where header and rows do not go together.
[[nodiscard]] std::optional<TableLayout> opensignals_layout(const TableText& text, const std::filesystem::path& path);

}  // namespace myoid::recording
