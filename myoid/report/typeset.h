#pragma once

#include <string>
#include <string_view>

namespace myoid::report {

/// Plain text as it is set in print: "R2" as a word becomes R², "+-" becomes ±. The same sentences
/// go to terminals, where plain characters are safer.
[[nodiscard]] std::string typographic(std::string_view text);

/// The same as HTML: escaped, and what stands between backticks as code. A backtick without its
/// partner stays.
[[nodiscard]] std::string typeset(std::string_view text);

/// A name of the files as words: "max_isometric_force" becomes "max isometric force".
[[nodiscard]] std::string spelled(std::string_view name);

}  // namespace myoid::report
