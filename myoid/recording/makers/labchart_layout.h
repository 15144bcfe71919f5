#pragma once

#include <filesystem>
#include <optional>

#include "myoid/recording/tables/table_layout.h"

namespace myoid::recording {

/// Returns the layout of a text that LabChart exports: lines "Interval=", "ChannelTitle=", "Range=", "UnitName=", then
/// rows of a time and the channels, perhaps with comments ("#* text") at their ends. Each block of the recording has
/// such lines. The lines of `text` between the rows and the comments are blanked; comments become events.
///
/// A channel without a converted unit ("*") is in the unit of its range. A block begins where "ExcelDateTime=" puts it;
/// where its times do not say, 1 s behind the block before, with a note. Empty for other texts. Throws ReadError with
/// the line where blocks differ in their channels, where rows are wider or narrower than the titles, or where neither
/// times nor an interval are there.
[[nodiscard]] std::optional<TableLayout> labchart_layout(TableText& text, const std::filesystem::path& path);

}  // namespace myoid::recording
