#include "myoid/program/cli/option_checks.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/files/text_file.h"
#include "myoid/study/setting.h"

namespace myoid::program {
namespace {

/// Returns the check of a number that lies in a range, which the name says: "above 0".
template <typename InRange>
CLI::Validator number_check(const std::string& range, const std::string& expected, InRange in_range) {
  return CLI::Validator(
      [expected, in_range](const std::string& text) -> std::string {
        const auto value = parse_number(text);
        if (value && std::isfinite(*value) && in_range(*value)) return {};
        return fmt::format("found '{}', expected a number {}", text, expected);
      },
      range);
}

}  // namespace

const CLI::Validator& zero_or_more() {
  static const CLI::Validator check = number_check("0 or more", "of 0 or more", [](double x) { return x >= 0.0; });
  return check;
}

CLI::Validator between(double lower, double upper) {
  const std::string range = fmt::format("{:.15g} to {:.15g}", lower, upper);
  return number_check(range, "from " + range, [=](double x) { return x >= lower && x <= upper; });
}

std::string refused_word(const std::string& word, const std::vector<std::string>& words) {
  const std::vector<std::string_view> names(words.begin(), words.end());
  return study::refusal(study::Setting{.key = {}, .kind = study::SettingKind::text, .about = {.words = names}}, word);
}

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string list = fmt::format("{{{}}}", fmt::join(words, ","));
  return CLI::Validator([words = std::move(words)](const std::string& word) { return refused_word(word, words); },
                        list);
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
