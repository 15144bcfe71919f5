#include "myoid/program/cli/option_checks.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "myoid/ground/files/text_file.h"

namespace myoid::program {

CLI::Validator between(double lower, double upper) {
  const bool ends = std::isfinite(upper);
  const std::string range = ends ? fmt::format("{:.15g} to {:.15g}", lower, upper) : fmt::format("{} or more", lower);
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        const auto value = parse_number(text);
        if (value && std::isfinite(*value) && *value >= lower && *value <= upper) return {};
        return fmt::format("found '{}', expected a number {} {}", text, ends ? "from" : "of", range);
      },
      range);
}

std::string refused_number(const std::string& text, const std::string& type) {
  std::int64_t whole = 0;
  std::uint64_t count = 0;
  double real = 0.0;
  const auto value = parse_number(text);
  if (type == "INT" && !CLI::detail::lexical_cast(text, whole))
    return fmt::format("found '{}', expected a whole number", text);
  if (type == "UINT" && (!CLI::detail::lexical_cast(text, count) || (value && *value >= 0x1p64)))
    return fmt::format("found '{}', expected a whole number from 0 to {}", text,
                       std::numeric_limits<std::uint64_t>::max());
  if (type == "FLOAT" && (!CLI::detail::lexical_cast(text, real) || !std::isfinite(real)))
    return fmt::format("found '{}', expected a number", text);
  return "";
}

}  // namespace myoid::program
