#pragma once

#include <span>
#include <string>
#include <string_view>

namespace myoid::page {

/// A color of the page in both schemes.
struct PageColor {
  std::string_view name;   ///< The style sheets' variable without its two dashes.
  std::string_view light;  ///< As drawings write it.
  std::string_view dark;
};

/// Returns all colors of pages and drawings.
[[nodiscard]] std::span<const PageColor> page_colors();

/// Returns the style sheet of a report. Screens that ask for a dark scheme get the dark colors, in drawings too: a rule
/// for each color replaces the attribute that holds it. Paper and saved drawings are light.
[[nodiscard]] std::string page_style();

}  // namespace myoid::page
