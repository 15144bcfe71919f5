#include "myoid/ground/files/text_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <new>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/input_log.h"

namespace myoid::inline ground {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Writes the eight decimal digits of a number below 10^8 with leading zeros: halves, then quarters, then single digits
/// in the bytes of one word (c / 100 = c * 10486 >> 20 for c < 10^4, c / 10 = c * 103 >> 10 for c < 100).
inline void put_eight(char* at, std::uint32_t number) {
  std::uint64_t v = number / 10000 | std::uint64_t{number % 10000} << 32U;
  const std::uint64_t hundreds = ((v * 10486) >> 20U) & 0x7F0000007FU;
  v = hundreds | (v - 100 * hundreds) << 16U;
  const std::uint64_t tens = ((v * 103) >> 10U) & 0x000F000F000F000FU;
  v = (tens | (v - 10 * tens) << 8U) | 0x3030303030303030U;
  static_assert(std::endian::native == std::endian::little);
  std::memcpy(at, &v, 8);
}

/// Returns the byte-order mark that a UTF-16 text lacks, by its first two characters; empty for other texts.
std::string_view absent_mark(std::string_view bytes) {
  const auto are = [&](bool a, bool b) {
    return (bytes[0] != '\0') == a && (bytes[1] != '\0') == b && (bytes[2] != '\0') == a && (bytes[3] != '\0') == b;
  };
  if (bytes.size() < 4 || bytes.size() % 2 != 0) return {};
  return are(true, false) ? "\xFF\xFE" : are(false, true) ? "\xFE\xFF" : "";
}

/// Converts a UTF-16 text with a byte-order mark to UTF-8; empty if the bytes are invalid.
std::optional<std::string> from_utf16(std::string_view bytes) {
  if (bytes.size() % 2 != 0) return std::nullopt;
  const std::size_t low = bytes[0] == '\xFF' ? 0 : 1;  // place of the lower byte in a pair
  std::string text;
  text.reserve(bytes.size() / 2);
  const auto unit = [&](std::size_t i) {
    return (std::uint32_t{static_cast<unsigned char>(bytes[i + 1 - low])} << 8U) |
           std::uint32_t{static_cast<unsigned char>(bytes[i + low])};
  };
  for (std::size_t i = 2; i < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code >= 0xDC00U && code < 0xE000U) return std::nullopt;
    if (code >= 0xD800U && code < 0xDC00U) {
      i += 2;
      if (i >= bytes.size() || unit(i) < 0xDC00U || unit(i) >= 0xE000U) return std::nullopt;
      code = 0x10000U + ((code - 0xD800U) << 10U) + (unit(i) - 0xDC00U);
    }
    const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
    const auto tail = [&](unsigned shift) { put(0x80U | ((code >> shift) & 0x3FU)); };
    if (code < 0x80U) {
      put(code);
    } else if (code < 0x800U) {
      put(0xC0U | (code >> 6U));
      tail(0);
    } else if (code < 0x10000U) {
      put(0xE0U | (code >> 12U));
      tail(6);
      tail(0);
    } else {
      put(0xF0U | (code >> 18U));
      tail(12);
      tail(6);
      tail(0);
    }
  }
  return text;
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path) {
  // A pipe ends; a device may not end.
  std::error_code error;
  if (!std::filesystem::is_fifo(path, error)) require_regular_file(path);
  refuse_foreign_format(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw ReadError(path, 0, "cannot be opened: {}", std::strerror(errno));
  note_input(fileno(file.get()));
  std::string text;
  const auto size = std::filesystem::file_size(path, error);
  char buffer[1 << 16];
  try {
    if (!error) text.reserve(size);
    for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) text.append(buffer, got);
  } catch (const std::bad_alloc&) {
    throw ReadError(path, 0, "the file has {} MB, more than the memory that this program may use; cut it into parts",
                    std::max<std::uintmax_t>(error ? 0 : size, text.size()) >> 20U);
  }
  if (std::ferror(file.get()) != 0) throw ReadError(path, 0, "reading failed: {}", std::strerror(errno));
  if (text.empty()) throw_empty(path);
  text.insert(0, absent_mark(text));
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    auto decoded = from_utf16(text);
    if (!decoded) throw ReadError(path, 0, "the text is in UTF-16 ('Unicode text') and damaged; save it as UTF-8");
    text = *std::move(decoded);
  }
  if (std::string_view(text).substr(0, 4096).find('\0') != std::string_view::npos) {
    throw ReadError(path, 0, "this is no text but a binary file; export it as text");
  }
  return text;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  // A character is searched for again only once its last place is passed.
  const auto next = [&](char c, std::size_t from) { return std::min(text.find(c, from), text.size()); };
  std::vector<std::string_view> lines;
  std::size_t feed = next('\n', 0), carriage = next('\r', 0);
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = std::min(feed, carriage);
    lines.push_back(text.substr(begin, end - begin));
    if (carriage < text.size() && end == carriage && feed == carriage + 1) ++end;
    begin = end + 1;
    if (feed < begin) feed = next('\n', begin);
    if (carriage < begin) carriage = next('\r', begin);
  }
  return lines;
}

bool ends_with_line(std::string_view text) { return text.empty() || text.back() == '\n' || text.back() == '\r'; }

bool looks_cut(std::string_view last, std::string_view before) {
  struct End {
    std::size_t digits = 0;
    char sign = ' ';  ///< '.' before decimals, 'e' before an exponent, else a blank.
  };
  const auto end_of = [](std::string_view line) {
    line = trim(line);
    End end;
    while (end.digits < line.size() && line[line.size() - 1 - end.digits] >= '0' &&
           line[line.size() - 1 - end.digits] <= '9')
      ++end.digits;
    line.remove_suffix(end.digits);
    const bool is_signed = line.ends_with('-') || line.ends_with('+');
    if (line.ends_with('.') || line.ends_with(',')) end.sign = '.';
    if (is_signed) line.remove_suffix(1);
    if (line.ends_with('e') || line.ends_with('E')) end.sign = 'e';
    return end;
  };
  const End a = end_of(last), b = end_of(before);
  return a.digits < b.digits || (b.sign != ' ' && a.sign == ' ') || (b.sign == 'e' && a.sign != 'e');
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && is_blank(line[i])) ++i;
    const std::size_t begin = i;
    while (i < line.size() && !is_blank(line[i])) ++i;
    if (i > begin) words.push_back(line.substr(begin, i - begin));
  }
  return words;
}

std::optional<double> parse_number(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // A number too small for a double is 0; a number too large is an error.
    return text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos
               ? std::optional<double>(0.0)
               : std::nullopt;
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

std::optional<double> parse_comma_number(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || text.find('.') != std::string_view::npos) return std::nullopt;
  std::string mended(text);
  mended[comma] = '.';
  return parse_number(mended);
}

std::string format_number(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

char* write_fixed(char* at, double value, int decimals, std::size_t width) {
  constexpr std::array<double, 15> kPower{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6, 1e7,
                                          1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14};
  constexpr std::array<std::int64_t, 9> kTens{1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
  constexpr std::size_t kWidest = 64;  // the text is written at once; there is room behind the number
  const double size = std::abs(value);
  if (decimals >= 0 && decimals <= 14 && size < 1e15 && width <= kWidest) {
    // Whole part and fraction are separate: the whole part is exact. The product of the fraction and the power is off
    // by less than 2e-16 of the power, so that its rounding is certain unless it ends that close to one half.
    const double power = kPower[static_cast<std::size_t>(decimals)];
    auto whole = static_cast<std::int64_t>(size);
    const double fraction = (size - static_cast<double>(whole)) * power;
    auto count = static_cast<std::int64_t>(fraction);
    const double rest = fraction - static_cast<double>(count);
    if (std::abs(rest - 0.5) > 4e-16 * power) {
      if (rest > 0.5) ++count;
      if (count == static_cast<std::int64_t>(power)) {
        count = 0;
        ++whole;
      }
      const bool negative = std::signbit(value);
      std::size_t needed = static_cast<std::size_t>(decimals) + (decimals > 0 ? 2 : 1) + (negative ? 1 : 0);
      for (std::int64_t w = whole; w >= 10; w /= 10) ++needed;
      char* const end = at + std::max(needed, width);
      std::memset(at, ' ', 16);
      if (width > 16) std::memset(at + 16, ' ', kWidest - 16);
      // The fraction is written from its first digit in groups of eight; the surplus goes behind the end.
      char* begin = end - decimals;
      if (decimals <= 8) {
        put_eight(begin, static_cast<std::uint32_t>(count * kTens[8 - decimals]));
      } else {
        const std::int64_t behind = kTens[decimals - 8];
        put_eight(begin, static_cast<std::uint32_t>(count / behind));
        put_eight(begin + 8, static_cast<std::uint32_t>(count % behind * kTens[16 - decimals]));
      }
      if (decimals > 0) *--begin = '.';
      for (; whole >= 10; whole /= 10) *--begin = static_cast<char>('0' + whole % 10);
      *--begin = static_cast<char>('0' + whole);
      if (negative) *--begin = '-';
      return end;
    }
  }
  char* const stop = std::isnan(value)
                         ? std::copy_n("NaN", 3, at)
                         : std::to_chars(at, at + kFixedRoom, value, std::chars_format::fixed, decimals).ptr;
  const auto count = static_cast<std::size_t>(stop - at);
  if (count >= width) return stop;
  std::memmove(at + (width - count), at, count);
  std::memset(at, ' ', width - count);
  return at + width;
}

std::string small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), small_letter);
  return text;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, small_letter, small_letter);
}

}  // namespace myoid::inline ground
