#pragma once

#include <string>
#include <string_view>

#include "myoid/page/report.h"

namespace myoid::page {

/// Returns the color of a verdict. The color-blind can tell these colors apart.
[[nodiscard]] std::string_view verdict_color(Badge badge);

/// Returns the mark of a verdict about the origin, 12 units wide, as an element of an SVG drawing.
/// Each verdict has a shape of its own.
[[nodiscard]] std::string verdict_shape(Badge badge);

/// Returns the mark as a small drawing for a line of text.
[[nodiscard]] std::string verdict_mark(Badge badge);

/// Returns an arrow at the left (-1) or right (+1) end of a drawing: the value lies beyond.
[[nodiscard]] std::string beyond_arrow(int side, std::string_view color);

}  // namespace myoid::page
