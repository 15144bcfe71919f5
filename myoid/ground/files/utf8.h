#pragma once

#include <cstddef>
#include <string_view>

namespace myoid::inline ground {

/// A character of a text in UTF-8.
struct CodePoint {
  char32_t value = 0;     ///< Of a byte that is no UTF-8: the byte.
  std::size_t bytes = 1;  ///< Length in the text.
  bool valid = true;      ///< False for a byte that is no UTF-8.
};

/// Returns the character that begins at byte `i`, which must lie in the text. Overlong forms, surrogates and numbers
/// beyond U+10FFFF are no UTF-8.
[[nodiscard]] CodePoint code_point_at(std::string_view text, std::size_t i);

[[nodiscard]] bool is_utf8(std::string_view text);

/// Returns true for a character that steers a terminal or a page in place of being seen: the control characters of
/// ASCII and Latin-1, the separators of lines and paragraphs (U+2028, U+2029), the marks that turn the direction of
/// writing (U+202A to U+202E, U+2066 to U+2069), and U+FFFE and U+FFFF, which XML forbids.
[[nodiscard]] bool is_control(char32_t character);

}  // namespace myoid::inline ground
