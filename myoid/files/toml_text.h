#pragma once

#include <string>
#include <string_view>

namespace myoid::recording {

/// Returns any text as a TOML basic string in quotes.
[[nodiscard]] std::string toml_text(std::string_view text);

/// Returns a TOML float: with a point or an exponent, and read back to the same bits.
[[nodiscard]] std::string toml_number(double value);

}  // namespace myoid::recording
