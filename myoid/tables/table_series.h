#pragma once

#include <filesystem>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/files/event.h"
#include "myoid/tables/table_layout.h"

namespace myoid::recording {

/// Channels of one clock.
struct ClockedChannels {
  TimeSeries data;  ///< In SI where a unit is written ("name [mV]", "name (mm)", or in a row of
                    ///< units below the header), else dimensionless.
  std::vector<bool> has_unit;  ///< Per channel.
};

/// The channels of a table. Where they have several clocks, `data` are those of the clock that most
/// channels called EMG have (then: most in volts, then: the first); names are unique over all.
struct CsvSeries : ClockedChannels {
  std::vector<Repair> repairs;
  std::vector<ClockedChannels> other_clocks;
  std::vector<Event> events;  ///< What columns of remarks hold, with the column's name.
};

/// The channels of a table whose layout is known: on the clock of its rows (`row_times`); or, where
/// there are several time columns or every channel states its rate, each on its own. Channels that
/// end before the others of their clock cut these, with a note. Throws ReadError with the line.
[[nodiscard]] CsvSeries channels_of_table(const TableText& text,
                                          const TableLayout& layout,
                                          const std::filesystem::path& path);

}  // namespace myoid::recording
