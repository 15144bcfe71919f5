#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "myoid/ground/core/units.h"

namespace myoid::inline ground {

/// Returns bytes of unknown origin as UTF-8: valid UTF-8 is kept, other bytes are read as Latin-1.
/// Control characters become blanks.
[[nodiscard]] std::string to_utf8(std::string_view bytes);

/// Reads a unit as recordings write it: `parse_unit`'s words and "nt", "ntmm", "N-M", "Nmm", "g"
/// (here an acceleration), "Volts"... Empty for other words ("d.u.", "ADC").
[[nodiscard]] std::optional<ScaledUnit> parse_file_unit(std::string_view text);

}  // namespace myoid::inline ground
