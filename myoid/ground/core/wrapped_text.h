#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace myoid::inline ground {

/// Returns the number of code points of a UTF-8 text: the columns that it takes on a terminal, but for the few scripts
/// of double width.
[[nodiscard]] std::size_t columns_of(std::string_view text);

/// Wraps the words of each line of a text into lines of at most `width` columns, each with a line end. The first is
/// indented by `indent`, those after it by `hanging` more. A word longer than the width has a line of its own.
[[nodiscard]] std::string wrapped(std::string_view text,
                                  std::size_t width,
                                  std::size_t indent = 0,
                                  std::size_t hanging = 0);

}  // namespace myoid::inline ground
