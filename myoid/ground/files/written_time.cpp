#include "myoid/ground/files/written_time.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <string>
#include <utility>

#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {
namespace {

/// Takes up to `most` digits and one of `marks` behind them off the begin of a text.
std::optional<int> take_digits(std::string_view& text, std::size_t most, std::string_view marks) {
  const std::size_t end = text.find_first_not_of("0123456789");
  if (end == 0 || end == std::string_view::npos || end > most || marks.find(text[end]) == std::string_view::npos)
    return std::nullopt;
  int value = 0;
  std::from_chars(text.data(), text.data() + end, value);
  text.remove_prefix(end + 1);
  return value;
}

/// Takes a date off the begin of a cell. Returns its days since the begin of 1970, 0 where the order of day and month
/// is not known or there is no date; nothing for an impossible date.
std::optional<double> take_date(std::string_view& cell) {
  std::string_view rest = cell;
  if (cell.size() > 10 && (cell[4] == '-' || cell[4] == '/')) {
    const auto year = take_digits(rest, 4, "-/"), month = take_digits(rest, 2, "-/"), day = take_digits(rest, 2, " T");
    if (!year || !month || !day) return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok()) return std::nullopt;
    cell = rest;
    return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
  }
  if (take_digits(rest, 2, "./-") && take_digits(rest, 2, "./-") && take_digits(rest, 4, " T")) cell = trim(rest);
  return 0.0;
}

/// Returns 12 for "PM", 0 for "AM" in any case; nothing for another text.
std::optional<int> half_of_day(std::string_view text) {
  text = trim(text);
  if (equal_ignoring_case(text, "pm")) return 12;
  return equal_ignoring_case(text, "am") ? std::optional(0) : std::nullopt;
}

}  // namespace

std::optional<double> written_time_s(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = trim(cell.substr(1, cell.size() - 2));
  const auto days = take_date(cell);
  if (!days) return std::nullopt;
  auto hours = take_digits(cell, 2, ":");
  if (!hours) return std::nullopt;
  auto minutes = take_digits(cell, 2, ":");
  std::size_t end = std::min(cell.find_first_not_of("0123456789.,"), cell.size());
  if (!minutes) {  // "02:03.250"
    if (cell.substr(0, end).find_first_of(".,") == std::string_view::npos) return std::nullopt;
    minutes = std::exchange(hours, 0);
  }
  if (*hours > 24 || *minutes > 59) return std::nullopt;
  std::string seconds_text(cell.substr(0, end));
  constexpr std::size_t kMilliseconds = 4;  // with the colon before them
  if (end < cell.size() && cell[end] == ':' &&
      cell.find_first_not_of("0123456789", end + 1) == std::string_view::npos && cell.size() == end + kMilliseconds) {
    seconds_text += "." + std::string(cell.substr(end + 1));
    end = cell.size();
  }
  auto seconds = parse_number(seconds_text);
  if (!seconds) seconds = parse_comma_number(seconds_text);
  if (!seconds || !(*seconds >= 0.0 && *seconds < 61.0)) return std::nullopt;
  const std::string_view behind = cell.substr(end);
  if (const auto half = half_of_day(behind)) {
    if (*hours == 0 || *hours > 12) return std::nullopt;
    *hours = *hours % 12 + *half;
  } else if (!behind.empty() && (std::string_view("Z+-").find(behind[0]) == std::string_view::npos ||
                                 behind.find_first_not_of("Z+-:0123456789") != std::string_view::npos)) {
    return std::nullopt;
  }
  return 86400.0 * *days + 3600.0 * *hours + 60.0 * *minutes + *seconds;
}

}  // namespace myoid::inline ground
