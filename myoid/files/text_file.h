#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::recording {

/// What a reader mended, and where.
struct Repair {
  std::size_t line = 0;  ///< Counts from 1; 0: the file as a whole.
  std::string message;
};

/// The whole file as bytes. Throws ReadError with the remedy if it is missing, a folder,
/// unreadable, empty or no text. UTF-16 with a byte-order mark becomes UTF-8.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

/// The lines of a text without their ends (LF, CRLF or CR), a byte-order mark removed. Views into
/// `text`.
[[nodiscard]] std::vector<std::string_view> split_lines(std::string_view text);

/// True unless the text stops inside a line: then its last number may be cut off.
[[nodiscard]] bool ends_with_line(std::string_view text);

/// The last line of a text that ends inside it looks cut: its last number has fewer decimals than
/// that of the line before.
[[nodiscard]] bool looks_cut(std::string_view last, std::string_view before);

/// What a reader states when it leaves the last row out, or keeps it, because its line has no end.
inline constexpr std::string_view kLastRowLeftOut =
    "the last row has no line end and may be cut off; left out";
inline constexpr std::string_view kLastRowKept =
    "the last row has no line end; its last number may be cut off";

/// Without blanks, tabs and carriage returns at both ends.
[[nodiscard]] std::string_view trim(std::string_view text);

/// The fields between separators, untrimmed; an empty text has one empty field.
[[nodiscard]] std::vector<std::string_view> split(std::string_view line, char separator);

/// The words between runs of blanks and tabs.
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view line);

/// A number in the C locale, whatever the machine's: "1.5", "+2e-3", "NaN", "Inf", "-infinity". The
/// whole text must be the number, blanks around it allowed.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The same for a number with a decimal comma, "1,5"; one comma and no point, so that "1,234.5" is
/// not taken for 1.2345.
[[nodiscard]] std::optional<double> parse_comma_number(std::string_view text);

/// Shortest decimal text that reads back to the same double.
[[nodiscard]] std::string format_number(double value);

/// Writes a number with a fixed count of decimals (at most 40), correctly rounded, blanks before it
/// up to `width` (at most 60), at a place with kFixedRoom bytes; "NaN", "inf", "-inf" for what is
/// not finite. Returns the place behind it.
[[nodiscard]] char* write_fixed(char* at, double value, int decimals, std::size_t width = 0);
inline constexpr std::size_t kFixedRoom = 400;

/// Without case (ASCII).
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

}  // namespace myoid::recording
