#include "myoid/ground/files/toml_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/document_limits.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {

TomlTable::TomlTable(const toml::table& table, std::filesystem::path file, std::string where)
    : table_(&table), file_(std::move(file)), where_(std::move(where)) {}

const toml::node* TomlTable::find(std::string_view key) {
  asked_.emplace(key);
  return table_->get(key);
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
  const toml::node* node = table_->get(key);
  const auto line = node != nullptr ? node->source().begin.line : table_->source().begin.line;
  throw ReadError(file_, static_cast<std::size_t>(line), "{} {}: {}", where_, key, message);
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_string()) return value->get();
  fail(key, "expected a text in quotes");
}

std::optional<double> TomlTable::number(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto value = node->value<double>(); value && node->is_number()) {
    if (!std::isfinite(*value)) fail(key, "expected a finite number");
    return *value;
  }
  fail(key, "expected a number (decimal point, no unit: the unit stands in the key's name)");
}

std::optional<bool> TomlTable::flag(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_boolean()) return value->get();
  fail(key, "expected true or false");
}

std::optional<std::vector<std::string>> TomlTable::texts(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_string()) return std::vector<std::string>{value->get()};
  std::vector<std::string> result;
  if (const auto* array = node->as_array()) {
    for (const toml::node& element : *array) {
      const auto* value = element.as_string();
      if (value == nullptr) fail(key, "expected a list of texts in quotes");
      result.push_back(value->get());
    }
    return result;
  }
  fail(key, "expected a text or a list of texts in quotes");
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const auto* array = node->as_array();
  if (array == nullptr) fail(key, "expected a list of numbers");
  std::vector<double> result;
  for (const toml::node& element : *array) {
    const auto value = element.value<double>();
    if (!value || !element.is_number()) fail(key, "expected a list of numbers");
    result.push_back(*value);
  }
  return result;
}

std::optional<std::vector<TomlTable::NumbersOrText>> TomlTable::numbers_or_texts(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  constexpr std::string_view kExpected = "expected a list of lists of numbers, and of texts";
  const auto numbers_of = [&](const toml::array& list) {
    NumbersOrText found;
    for (const toml::node& element : list) {
      const auto value = element.value<double>();
      if (!value || !element.is_number() || !std::isfinite(*value)) fail(key, std::string(kExpected));
      found.numbers.push_back(*value);
    }
    return found;
  };
  if (const auto text = node->value<std::string>()) return std::vector<NumbersOrText>{{.numbers = {}, .text = *text}};
  const auto* array = node->as_array();
  if (array == nullptr) fail(key, std::string(kExpected));
  if (!array->empty() && array->front().is_number()) return std::vector<NumbersOrText>{numbers_of(*array)};
  std::vector<NumbersOrText> result;
  for (const toml::node& element : *array) {
    if (const auto* inner = element.as_array()) {
      result.push_back(numbers_of(*inner));
    } else if (const auto text = element.value<std::string>()) {
      result.push_back({.numbers = {}, .text = *text});
    } else {
      fail(key, std::string(kExpected));
    }
  }
  return result;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_table()) return TomlTable(*value, file_, fmt::format("[{}]", key));
  fail(key, fmt::format("expected a table, [{}]", key));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node* node = find(key);
  std::vector<TomlTable> result;
  if (node == nullptr) return result;
  const auto* array = node->as_array();
  if (array == nullptr) fail(key, fmt::format("expected tables, [[{}]] each", key));
  for (const toml::node& element : *array) {
    const auto* value = element.as_table();
    if (value == nullptr) fail(key, fmt::format("expected tables, [[{}]] each", key));
    result.emplace_back(*value, file_, fmt::format("[[{}]] {}", key, result.size() + 1));
  }
  return result;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> result;
  for (const auto& entry : *table_) result.emplace_back(entry.first.str());
  return result;
}

std::string TomlTable::require_text(std::string_view key, std::string_view what) {
  if (auto value = text(key)) return *value;
  throw ReadError(file_, static_cast<std::size_t>(table_->source().begin.line), "{}: '{}' is missing; write {}", where_,
                  key, what);
}

std::string TomlTable::choice(std::string_view key,
                              std::string_view otherwise,
                              const std::vector<std::string>& allowed) {
  const std::string value = text(key).value_or(std::string(otherwise));
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    std::vector<std::string> named;
    std::copy_if(allowed.begin(), allowed.end(), std::back_inserter(named),
                 [](const std::string& word) { return !word.empty(); });
    fail(key,
         fmt::format("found \"{}\", expected {}{}", value, named.size() > 1 ? "one of " : "", fmt::join(named, ", ")));
  }
  return value;
}

bool TomlTable::is_text(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr && node->is_string();
}

bool TomlTable::is_table(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr && node->is_table();
}

namespace {

/// Returns a key without '_' and without a unit at its end: "high_pass" and "highpass_hz" agree.
std::string plain_key(std::string_view key) {
  static constexpr std::array<std::string_view, 16> kUnits{"hz", "s", "ms", "m",  "mm",  "cm",    "kg",  "n",
                                                           "nm", "v", "mv", "uv", "deg", "degps", "rad", "ppm"};
  const std::size_t last = key.rfind('_');
  if (last != std::string_view::npos && last > 0 &&
      std::find(kUnits.begin(), kUnits.end(), key.substr(last + 1)) != kUnits.end())
    key = key.substr(0, last);
  std::string plain(key);
  std::erase(plain, '_');
  return plain;
}

/// Returns the known key that resembles an unknown one.
std::optional<std::string> nearest_key(std::string_view key, const std::vector<std::string>& known) {
  std::vector<std::string> plain;
  for (const std::string& k : known) plain.push_back(plain_key(k));
  const auto near = nearest_word(plain_key(key), plain);
  if (!near) return nearest_word(key, known);
  return known[static_cast<std::size_t>(std::find(plain.begin(), plain.end(), *near) - plain.begin())];
}

}  // namespace

void TomlTable::finish() const {
  for (const auto& entry : *table_) {
    const std::string key(entry.first.str());
    if (asked_.contains(key)) continue;
    const std::vector<std::string> known(asked_.begin(), asked_.end());
    const auto near = nearest_key(key, known);
    fail(key, near ? fmt::format("unknown key; did you mean '{}'?", *near)
                   : fmt::format("unknown key; known are {}", fmt::join(known, ", ")));
  }
}

namespace {

/// Tracks whether a key or a value stands at the present place of a TOML text.
struct Place {
  bool in_value = false;
  std::string brackets;  ///< Open brackets of lists and tables in values.

  void pass(char c) {
    if (c == '=') in_value = true;
    if (in_value && (c == '[' || c == '{')) brackets += c;
    if ((c == ']' || c == '}') && !brackets.empty()) {
      brackets.pop_back();
      in_value = true;
    }
    if ((c == '{' || c == ',') && brackets.ends_with('{')) in_value = false;
  }
  void end_line() {
    if (brackets.empty()) in_value = false;
  }
};

/// Refuses letters beyond ASCII outside quotes and remarks, where TOML has none. toml++ 3.3 looks
/// such letters up in a table of blanks without reaching its end, so that they must not get there.
void refuse_letters_outside_quotes(std::string_view text, const std::filesystem::path& file) {
  enum class In { plain, remark, quotes };
  In in = In::plain;
  char quote = '"';
  bool many_lines = false;
  std::size_t line = 1;
  Place place;
  char before = '\n';  // the last character outside of quotes that is no blank
  for (std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool ascii = static_cast<unsigned char>(c) < 0x80U;
    const auto three = [&] { return text.substr(i, 3) == std::string(3, quote); };
    if (c == '\n') {
      ++line;
      if (in != In::quotes || !many_lines) {
        before = '\n';
        place.end_line();
      }
      if (in == In::remark || (in == In::quotes && !many_lines)) in = In::plain;
    } else if (in == In::quotes) {
      const bool escape = quote == '"' && c == '\\';
      // toml++ skips blanks and line ends behind a backslash and looks up the character after them.
      const std::size_t after = escape ? text.find_first_not_of(" \t\r\n", i + 1) : text.npos;
      if (after != text.npos && after > i + 1 && static_cast<unsigned char>(text[after]) >= 0x80U)
        throw ReadError(file, line, "not valid TOML: a letter beyond ASCII first after a backslash and blanks");
      if (escape && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0x80U) {
        if (text[i + 1] != '\n') ++i;
      } else if (escape) {
        throw ReadError(file, line, "not valid TOML: a backslash before a letter beyond ASCII");
      } else if (c == quote && (!many_lines || three())) {
        i += many_lines ? 2 : 0;
        in = In::plain;
      }
    } else if (in == In::plain) {
      if (!ascii) {
        throw ReadError(file, line,
                        "not valid TOML: a letter beyond ASCII outside of quotes; put the name or text in quotes");
      }
      if (c != '\t' && c != '\n' && c != '\r' && (static_cast<unsigned char>(c) < 0x20U || c == 0x7f))
        throw ReadError(file, line, "not valid TOML: a byte {:#04x}, which is no text", static_cast<unsigned>(c));
      if (c == '#') in = In::remark;
      // toml++ looks through a number to its end; these characters are no numbers.
      const bool opens = std::string_view("\n=[,{").find(before) != std::string_view::npos;
      if (place.in_value && (c == '=' || ((c == '[' || c == '{') && !opens)))
        throw ReadError(file, line, "not valid TOML: a '{}' in the middle of a value", c);
      // Elsewhere a quote is a mistake and opens no text; after a point it opens one only in a dotted key.
      const bool begins = opens || (before == '.' && !place.in_value);
      const auto is_digit = [](char of) { return of >= '0' && of <= '9'; };
      if (c == ',' && place.in_value && place.brackets.empty() && is_digit(before) && i + 1 < text.size() &&
          is_digit(text[i + 1]))
        throw ReadError(file, line, "not valid TOML: a number with a comma; write it with a point");
      place.pass(c);
      if (c != ' ' && c != '\t' && c != '\r') before = c;
      if ((c == '"' || c == '\'') && !begins)
        throw ReadError(file, line, "not valid TOML: a quote in the middle of a value");
      if (c == '"' || c == '\'') {
        in = In::quotes;
        quote = c;
        many_lines = place.in_value && three();  // a key has one line
        i += many_lines ? 2 : 0;
      }
    }
  }
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::filesystem::path& file) {
  if (const std::string other = wrong_kind(file, {FileFormat::toml}, "a study or protocol (.toml)"); !other.empty())
    throw ReadError(file, 0, other);
  if (text.size() > kLargestDocument_bytes) {
    throw ReadError(file, 0, "the document has {} MB; expected at most {} MB", text.size() >> 20U,
                    kLargestDocument_bytes >> 20U);
  }
  refuse_letters_outside_quotes(text, file);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw ReadError(file, static_cast<std::size_t>(error.source().begin.line), "not valid TOML: {}",
                    error.description());
  }
}

}  // namespace myoid::inline ground
