#pragma once

#include <string>
#include <string_view>

namespace myoid::recording {

/// A TOML basic string in quotes; any text may stand in it.
[[nodiscard]] std::string toml_text(std::string_view text);

/// A TOML float: always with a point or an exponent, and read back to the same bits.
[[nodiscard]] std::string toml_number(double value);

}  // namespace myoid::recording
