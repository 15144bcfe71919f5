#include "myoid/page/verdict_mark.h"

#include <array>

#include <fmt/format.h>

namespace myoid::page {
namespace {

struct Mark {
  std::string_view color;
  std::string_view path;
  bool filled;
};

/// Returns the mark of a badge; the table is in the order of the enumerators.
const Mark& mark_of(Badge badge) {
  static constexpr std::array<Mark, 6> kMarks{{{"#5a626b", "M-4.5 -4.5L4.5 4.5M-4.5 4.5L4.5 -4.5", false},
                                               {"#00694b", "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z", true},
                                               {"#b86e00", "M0 -6L6 0L0 6L-6 0Z", true},
                                               {"#b3261e", "M0 -6L6 5H-6Z", true},
                                               {"#1f5fa8", "M-4.5 -4.5H4.5V4.5H-4.5Z", false},
                                               {"#7a3c8f", "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z M-2 0H2", false}}};
  return kMarks[static_cast<std::size_t>(badge)];
}

}  // namespace

std::string_view verdict_color(Badge badge) { return mark_of(badge).color; }

std::string verdict_shape(Badge badge) {
  const Mark& mark = mark_of(badge);
  return fmt::format("<path d=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"2\"/>", mark.path,
                     mark.filled ? mark.color : "none", mark.color);
}

std::string verdict_mark(Badge badge) {
  return fmt::format(
      "<svg class=\"mark\" width=\"16\" height=\"16\" viewBox=\"-8 -8 16 16\" "
      "aria-hidden=\"true\">{}</svg>",
      verdict_shape(badge));
}

std::string beyond_arrow(int side, std::string_view color) {
  return fmt::format("<svg x=\"{}%\" y=\"50%\" overflow=\"visible\"><path d=\"M{}\" fill=\"{}\"/></svg>",
                     side < 0 ? 0 : 100, side < 0 ? "0 0L8 -4V4Z" : "0 0L-8 -4V4Z", color);
}

}  // namespace myoid::page
