#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Text of users (names, labels, paths) in the quotes of the language that reads it next. Each language has one
/// function. JSON has myoid::json_text.
namespace myoid::inline ground {

/// Returns any text as a TOML basic string in quotes.
[[nodiscard]] std::string toml_text(std::string_view text);

/// Returns a TOML float: with a point or an exponent, and read back to the same bits.
[[nodiscard]] std::string toml_number(double value);

/// Quotes a word for a POSIX shell, if a shell would read it otherwise.
[[nodiscard]] std::string shell_word(std::string_view word);

/// Quotes a word of GNU parallel's command for the shell that reads the script. GNU parallel replaces {}, {1}, {.} ...
/// in its command and gives the result to a second shell: both leave the word as it is.
[[nodiscard]] std::string parallel_word(std::string_view word);

/// Returns any text as a Python string in quotes, as a Snakefile holds it.
[[nodiscard]] std::string python_text(std::string_view text);

/// Returns text for HTML, SVG and XML, between tags or in double quotes. Control characters become '?'.
[[nodiscard]] std::string escape_xml(std::string_view text);

/// Returns a path as the relative address of a link, percent-encoded (RFC 3986); '/' stays.
[[nodiscard]] std::string url_path(std::string_view path);

/// Returns the text as a cell of a table of comma-separated values, in quotes, its quotes doubled.
[[nodiscard]] std::string csv_quoted(std::string_view text);

/// Returns the text as a cell of a table of comma-separated values (RFC 4180), in quotes where a reader would take it
/// for something else: a separator, a remark (#), blanks at an end.
[[nodiscard]] std::string csv_cell(std::string_view text);

/// Returns text for a terminal. Control characters but for line end and tab become \uXXXX, bytes that are no UTF-8
/// U+FFFD: JSON stays the same JSON.
[[nodiscard]] std::string visible_text(std::string_view text);

/// Returns visible text with words longer than any path, and lines longer than a screen, cut short behind an ellipsis.
[[nodiscard]] std::string terminal_text(std::string_view text);

/// Returns at most `most` characters of the text, the last of them an ellipsis where some are left out.
[[nodiscard]] std::string elided(std::string_view text, std::size_t most);

/// Returns the text with every word of more than `most` characters elided.
[[nodiscard]] std::string with_short_words(std::string_view text, std::size_t most);

}  // namespace myoid::inline ground
