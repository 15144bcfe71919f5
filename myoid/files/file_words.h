#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "myoid/core/units.h"

namespace myoid::recording {

/// Bytes of unknown origin as UTF-8: kept if they are valid UTF-8, else read as Latin-1. Control
/// characters become blanks.
[[nodiscard]] std::string to_utf8(std::string_view bytes);

/// A unit as recordings write it: besides `parse_unit`'s words "nt", "ntmm", "N-M", "Nmm", "g"
/// (here an acceleration), "Volts"... Empty if it is none ("d.u.", "ADC").
[[nodiscard]] std::optional<ScaledUnit> parse_file_unit(std::string_view text);

}  // namespace myoid::recording
