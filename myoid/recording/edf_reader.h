#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "myoid/files/analog_channels.h"
#include "myoid/files/event.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {

struct EdfFile {
  AnalogChannels data;         ///< The signals of one rate: the highest rate of a voltage, else the highest of all.
  std::vector<bool> has_unit;  ///< For each channel: its dimension is known.
  std::vector<Event> events;   ///< Annotations of EDF+ and BDF+.
  std::vector<Repair> repairs;
};

/// Reads EDF, EDF+ (also with gaps, EDF+D) and BDF, BDF+: samples of 16 or 24 bits,
///
///   physical = physical_min + (digital − digital_min) (physical_max − physical_min) / (digital_max
///   − digital_min)
///
/// in the unit that the header names. The first sample is at 0 s, even where the time stamps of the records begin
/// later: stamps and annotations count from the first record. Signals of other rates and signals with an impossible
/// scale are left out with a note. Repairs with a note: a number of records that disagrees with the size of the file, a
/// last record that is cut off, decimal commas, repeated names. Throws ReadError if the file is of another kind or its
/// header makes no sense. Sources: the EDF and EDF+ specifications (1992, 2003), BioSemi's description of BDF.
[[nodiscard]] EdfFile read_edf(const std::filesystem::path& path);
[[nodiscard]] EdfFile parse_edf(std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace myoid::recording
