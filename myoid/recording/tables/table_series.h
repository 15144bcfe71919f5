#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/event.h"
#include "myoid/recording/tables/table_layout.h"

namespace myoid::recording {

/// Channels of one clock.
struct ClockedChannels {
  TimeSeries data;             ///< In SI if a unit is written ("name [mV]", "name (mm)", or in a row of units
                               ///< below the header), else without dimension.
  std::vector<bool> has_unit;  ///< For each channel.
};

/// The channels of a table. If they have several clocks, `data` holds the clock with the most channels called EMG; ties
/// go to the clock with the most channels in volts, then to the first. Names are unique over all clocks.
struct CsvSeries : ClockedChannels {
  std::vector<Repair> repairs;
  std::vector<ClockedChannels> other_clocks;
  std::vector<Event> events;  ///< The cells of columns of remarks, with the column's name.
  std::vector<double> to_si;  ///< Of a table, for each channel of `data`: the factor of its written unit, 0: none.
};

/// Returns the clock with the most channels called EMG; ties go to the clock with the most channels in volts, then to
/// the first. Precondition: there is a clock.
[[nodiscard]] std::size_t first_clock(const std::vector<std::vector<Channel>>& clocks);

/// Returns "the channels have 2 clocks: 2000 Hz: BIC, TRI; 148 Hz: ACC X".
[[nodiscard]] std::string clocks_text(const std::vector<std::vector<Channel>>& clocks,
                                      const std::vector<double>& rates_hz);

/// Reads the channels of a table with a known layout. All are on the clock of its rows (`row_times`), unless there are
/// several time columns or every channel states its rate: then each channel has its own clock. A channel that ends
/// early cuts the others of its clock, with a note. Throws ReadError with the line.
[[nodiscard]] CsvSeries channels_of_table(const TableText& text,
                                          const TableLayout& layout,
                                          const std::filesystem::path& path);

}  // namespace myoid::recording
