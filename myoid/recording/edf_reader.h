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
  AnalogChannels
      data;  ///< The signals of the highest rate that has a voltage, else of the highest.
  std::vector<bool> has_unit;  ///< Per channel: its dimension is known.
  std::vector<Event> events;   ///< Annotations of EDF+ and BDF+.
  std::vector<Repair> repairs;
};

/// Reads EDF, EDF+ (also with gaps, EDF+D) and BDF, BDF+: samples of 16 or 24 bits,
///
///   physical = physical_min + (digital − digital_min) (physical_max − physical_min) / (digital_max
///   − digital_min)
///
/// in the unit that the header names. The first sample is at 0 s, also where the time stamps of the
/// records begin later: stamps and annotations count from the first record. Signals of other rates
/// are left out with a note, as are signals whose scale cannot be. Mended with a note: a number of
/// records that disagrees with the size of the file, a last record that is cut off, comma decimals,
/// names that stand twice. Throws ReadError if this is no such file or its header makes no sense.
/// Sources: the EDF and EDF+ specifications (1992, 2003), BioSemi's description of BDF.
[[nodiscard]] EdfFile read_edf(const std::filesystem::path& path);
[[nodiscard]] EdfFile parse_edf(std::span<const std::byte> bytes,
                                const std::filesystem::path& path);

}  // namespace myoid::recording
