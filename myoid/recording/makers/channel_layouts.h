#pragma once

#include <filesystem>
#include <optional>

#include "myoid/recording/tables/table_layout.h"

namespace myoid::recording {

/// Returns the layout of a table of channels whose header no general rule reads: the section
/// "Devices" of Vicon Nexus (.csv), Qualisys' analog channels (.tsv, DATA_INCLUDED ANALOG),
/// BIOPAC's text (names and units in lines of their own), and BTS' EMG tracks (.emt, one unit for
/// all), LabChart's text, OpenSignals' text, and the section "Model Outputs" of Nexus where the text has neither
/// devices nor trajectories. Empty for other texts. Lines that are no rows may be blanked in `text`. Throws ReadError
/// where such a header lacks its rows.
[[nodiscard]] std::optional<TableLayout> makers_layout(TableText& text, const std::filesystem::path& path);

}  // namespace myoid::recording
