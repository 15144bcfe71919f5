#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "myoid/ground/files/analog_channels.h"
#include "myoid/ground/files/event.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// Signals of one rate.
struct EdfSignals {
  AnalogChannels data;
  std::vector<bool> has_unit;  ///< For each channel: its dimension is known.
};

/// The signals of a file. If they have several rates, `data` holds the clock that `first_clock` chooses; among equals
/// the fastest.
struct EdfFile : EdfSignals {
  std::vector<EdfSignals> other_clocks;
  std::vector<Event> events;  ///< Annotations of EDF+ and BDF+.
  std::vector<Repair> repairs;
};

/// Reads EDF, EDF+ (also with gaps, EDF+D) and BDF, BDF+: samples of 16 or 24 bits,
///
///   physical = physical_min + (digital − digital_min) (physical_max − physical_min) / (digital_max
///   − digital_min)
///
/// in the unit that the header names. The first sample is at 0 s, even where the time stamps of the records begin
/// later: stamps and annotations count from the first record. Each rate is a clock, as in tables. Signals with an
/// impossible scale are left out with a note. Repairs with a note: a number of records that disagrees with the size of
/// the file, a last record that is cut off, bytes behind the last record, decimal commas, repeated names, a unit of
/// volts whose prefix cannot be read (".V": uV), other unknown units. Throws ReadError if the file is of another kind,
/// its header makes no sense, or a transfer as text has changed its bytes. Sources: the EDF and EDF+ specifications
/// (1992, 2003), BioSemi's description of BDF.
[[nodiscard]] EdfFile read_edf(const std::filesystem::path& path);
[[nodiscard]] EdfFile parse_edf(std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace myoid::recording
