#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// toml++ asserts that a name follows "[", but the file's author may get this wrong ("[=emg]").
// Without its assertions toml++ reports this like any other error.
#define TOML_ASSERT(expr) static_assert(true)
#include <toml++/toml.h>

#include "myoid/ground/core/choice.h"

namespace myoid::inline ground {

/// Reads one table of a TOML file strictly: every key is asked for by name and type, and `finish`
/// refuses all other keys, naming the nearest known one. All errors are ReadErrors with the line.
class TomlTable {
 public:
  /// `where` is the table's name in messages: "[emg]".
  TomlTable(const toml::table& table, std::filesystem::path file, std::string where);

  [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }
  /// Makes the key a known one and returns whether the table has it.
  bool asked(std::string_view key) { return find(key) != nullptr; }
  [[nodiscard]] std::optional<std::string> text(std::string_view key);
  [[nodiscard]] std::optional<double> number(std::string_view key);  ///< A finite number; integers are accepted.
  [[nodiscard]] std::optional<bool> flag(std::string_view key);
  /// Returns a string or an array of strings as a list.
  [[nodiscard]] std::optional<std::vector<std::string>> texts(std::string_view key);
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key);
  /// An element of a list: numbers in brackets, or a text.
  struct NumbersOrText {
    std::vector<double> numbers;
    std::optional<std::string> text;
  };
  /// Returns a list of lists of numbers and of texts; a text alone, and two numbers alone, are a list of one element.
  [[nodiscard]] std::optional<std::vector<NumbersOrText>> numbers_or_texts(std::string_view key);
  [[nodiscard]] std::optional<TomlTable> table(std::string_view key);
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key);  ///< [[key]]
  [[nodiscard]] std::vector<std::string> keys() const;

  /// Returns the text; throws if the key is missing. `what` says what to write.
  [[nodiscard]] std::string require_text(std::string_view key, std::string_view what);

  /// Returns one of `allowed`; throws listing them.
  [[nodiscard]] std::string choice(std::string_view key,
                                   std::string_view otherwise,
                                   const std::vector<std::string>& allowed);
  /// Returns an enumerator by one of the names of its enumeration (ground/core/choice.h).
  template <typename Enumeration>
  [[nodiscard]] Enumeration choice(std::string_view key, Enumeration otherwise) {
    const ChoiceNames names = choice_names(otherwise);
    const std::vector<std::string> allowed(names.begin(), names.end());
    return *choice_named<Enumeration>(choice(key, choice_name(otherwise), allowed));
  }

  /// Returns true if the key holds a string.
  [[nodiscard]] bool is_text(std::string_view key) const;
  [[nodiscard]] bool is_table(std::string_view key) const;

  /// Throws for the first key that was never asked for.
  void finish() const;

  /// Throws ReadError at the key's line (or the table's).
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  [[nodiscard]] const toml::node* find(std::string_view key);

  const toml::table* table_;
  std::filesystem::path file_;
  std::string where_;
  std::set<std::string, std::less<>> asked_;
};

/// Parses a TOML text. Throws ReadError with the line of the first syntax error.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::filesystem::path& file);

}  // namespace myoid::inline ground
