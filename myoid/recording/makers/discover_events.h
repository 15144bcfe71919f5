#pragma once

#include "myoid/recording/tables/table_layout.h"

namespace myoid::recording {

/// Cuts the table of events off the right side of a text of Delsys Trigno Discover 2 and returns its events. The names
/// of its columns ("Type, Name, Label, Time (s)") stand to the right of the channels' in the row of rates or of sample
/// periods, and only the first rows have its cells. Other texts stay as they are.
[[nodiscard]] std::vector<Event> take_discover_events(TableText& text);

}  // namespace myoid::recording
