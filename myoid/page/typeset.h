#pragma once

#include <string>
#include <string_view>

namespace myoid::page {

/// Sets plain text for print: "R2" as a word becomes R², "+-" becomes ±, " deg" behind a digit becomes °. The same
/// sentences go to terminals, where plain characters are safer.
[[nodiscard]] std::string typographic(std::string_view text);

/// Sets plain text as HTML: escaped, and text between backticks as code. A single backtick stays. Words and texts that
/// no page has room for end in an ellipsis.
[[nodiscard]] std::string typeset(std::string_view text);

/// Spells a name of the files as words: "max_isometric_force" becomes "max isometric force", "emg_delay" "EMG delay".
[[nodiscard]] std::string spelled(std::string_view name);

}  // namespace myoid::page
