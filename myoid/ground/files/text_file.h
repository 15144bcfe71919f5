#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace myoid::inline ground {

/// A repair by a reader, with its place.
struct Repair {
  std::size_t line = 0;  ///< Counted from 1; 0: the whole file.
  std::string message;
  double apart_s = 0.0;  ///< Of a clock: by so much two statements about it differ at the recording's end.
  bool lost = false;     ///< The file ends in a row, or holds less than its header states: a part is absent.
};

/// Notes a repair of the whole file; the message is a format and its arguments, as of `fmt::format`.
template <typename... Args>
void note(std::vector<Repair>& repairs, fmt::format_string<Args...> message, Args&&... args) {
  repairs.push_back({0, fmt::format(message, std::forward<Args>(args)...)});
}

/// Reads the whole file. UTF-16 becomes UTF-8, also where the byte-order mark is absent. Throws ReadError with the
/// remedy if the file is missing, a folder, unreadable, empty or no text.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

/// Splits a text into lines without their ends (LF, CRLF or CR) and without a byte-order mark. The
/// views refer to `text`.
[[nodiscard]] std::vector<std::string_view> split_lines(std::string_view text);

/// Returns false if the text ends in the middle of a line: its last number may be cut off.
[[nodiscard]] bool ends_with_line(std::string_view text);

/// Returns true if the last line of a text, which has no line end, seems cut: its last number ends in fewer digits than
/// that of a line before, or lacks the decimals or the exponent of that number.
[[nodiscard]] bool looks_cut(std::string_view last, std::string_view before);

/// Notes of readers that leave out or keep a last row without a line end.
inline constexpr std::string_view kLastRowLeftOut = "the last row has no line end and may be cut off; left out";
inline constexpr std::string_view kLastRowKept = "the last row has no line end; its last number may be cut off";

/// Removes blanks, tabs and carriage returns at both ends.
[[nodiscard]] std::string_view trim(std::string_view text);

/// Splits a line at separators without trimming; an empty text has one empty field.
[[nodiscard]] std::vector<std::string_view> split(std::string_view line, char separator);

/// Splits a line at runs of blanks and tabs.
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view line);

/// Reads a number in the C locale, whatever the system's: "1.5", "+2e-3", "NaN", "Inf",
/// "-infinity". The whole text must be the number, apart from blanks around it.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Reads a number with a decimal comma, "1,5". It must have one comma and no point, so that
/// "1,234.5" is not taken for 1.2345.
[[nodiscard]] std::optional<double> parse_comma_number(std::string_view text);

/// Returns the shortest decimal text that reads back to the same double.
[[nodiscard]] std::string format_number(double value);

/// Writes a number with a fixed count of decimals (at most 40), correctly rounded and padded with
/// blanks on the left to `width` (at most 60), to a place with kFixedRoom bytes; "NaN", "inf",
/// "-inf" for numbers that are not finite. Returns the place behind it.
[[nodiscard]] char* write_fixed(char* at, double value, int decimals, std::size_t width = 0);
inline constexpr std::size_t kFixedRoom = 400;

/// Returns a capital letter of ASCII as a small one, and any other character unchanged.
[[nodiscard]] constexpr char small_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }
[[nodiscard]] std::string small_letters(std::string text);

/// Compares texts ignoring the case of ASCII letters.
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

}  // namespace myoid::inline ground
