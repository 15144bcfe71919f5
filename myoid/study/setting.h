#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/stretch.h"
#include "myoid/study/equal_stretches.h"

namespace myoid::study {

/// The allowed numbers of a setting.
struct SettingLimits {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::string_view unit;     ///< "s", "Hz"; empty: dimensionless.
  bool above_lower = false;  ///< `lower` itself is refused.
};
[[nodiscard]] constexpr SettingLimits any_number(std::string_view unit = {}) { return {.unit = unit}; }
[[nodiscard]] constexpr SettingLimits above_zero(std::string_view unit = {}) {
  return {.lower = 0.0, .unit = unit, .above_lower = true};
}
[[nodiscard]] constexpr SettingLimits zero_or_more(std::string_view unit = {}) { return {.lower = 0.0, .unit = unit}; }
[[nodiscard]] constexpr SettingLimits within(double lower, double upper, std::string_view unit = {}) {
  return {.lower = lower, .upper = upper, .unit = unit};
}

/// The facts of a setting that is an option of a command. Other options are named by their keys, several with commas.
struct OptionFacts {
  std::string_view also = {};      ///< Further names, with their dashes: "-w,--work_dir".
  std::string_view keyword = {};   ///< Python's name, if it is not the key's.
  std::string_view group = {};     ///< Heading of the help; empty: the usual one.
  std::string_view needs = {};     ///< Options that must be given, too.
  std::string_view excludes = {};  ///< Options that must not be given.
  bool by_place = false;           ///< An argument: its place names it.
  bool by_comma = false;           ///< One word may hold several values.
  bool one_each = false;           ///< Takes one word each time; several by repeating it.
  bool or_number = false;          ///< A text that Python may give as a number.
};

/// The facts of a setting beyond its C++ type.
struct About {
  std::string_view says;            ///< One sentence of the reference; Markdown.
  SettingLimits limits = {};        ///< Limits of a number.
  std::string_view otherwise = {};  ///< Default in words, if the value itself does not state it.
  std::string_view required = {};   ///< Makes the setting mandatory; the words describe how.
  std::string_view word = {};       ///< Allowed word instead of a number or a list: "estimate".
  std::string_view table = {};      ///< Key of a table allowed instead of a text: "same_as".
  ChoiceNames words = {};           ///< The only allowed texts; empty: any.
  std::size_t count = 0;            ///< Number of entries of a list; 0: any.
  bool silent = false;              ///< Not written: another setting is in force, and both together are refused.
  OptionFacts option = {};          ///< Of a command's option.
};

enum class SettingKind {
  flag,
  number,
  count,
  text,
  path,
  folder,
  texts,
  paths,
  numbers,
  stretches,
  texts_by_name,
  numbers_by_name
};

/// A setting: its key in the file and the facts about it.
struct Setting {
  std::string_view key;
  SettingKind kind = SettingKind::text;
  About about;
};

/// Returns the reason to refuse a number or a word ("found 3 Hz, expected 5 to 2000 Hz"); empty: allowed.
[[nodiscard]] std::string refusal(const Setting& setting, double value);
[[nodiscard]] std::string refusal(const Setting& setting, const std::string& word);
[[nodiscard]] bool is_number(const Setting& setting);

/// Stretches of time and, of a setting that allows a word among them, the word.
struct WordedStretches {
  std::vector<Stretch> stretches;
  bool worded = false;
  bool operator==(const WordedStretches& other) const {
    return worded == other.worded && equal_stretches(stretches, other.stretches);
  }
};

/// The value of a setting as a file holds it; monostate: absent.
using SettingValue = std::variant<std::monostate,
                                  bool,
                                  double,
                                  std::string,
                                  std::vector<std::string>,
                                  std::vector<double>,
                                  WordedStretches,
                                  std::map<std::string, std::string>,
                                  std::map<std::string, double>>;

/// Visits settings one by one, in the order of the reference. `visit(spec, visitor)` names every
/// setting of a struct once; visitors read settings from a file or a command line, write, check or
/// describe them. Each of the functions below returns whether the user gave the setting.
class SettingVisitor {
 public:
  using Inside = std::function<void(SettingVisitor&)>;

  SettingVisitor() = default;
  SettingVisitor(const SettingVisitor&) = delete;
  SettingVisitor& operator=(const SettingVisitor&) = delete;
  virtual ~SettingVisitor() = default;

  bool flag(std::string_view key, bool& value, const About& about);
  bool flag(std::string_view key, std::optional<bool>& value, const About& about);
  /// Visits a flag whose presence makes the value false.
  template <typename Bool>
  bool unset(std::string_view key, Bool& value, const About& about) {
    return met({key, SettingKind::flag, about}, false, [&value](const SettingValue& given) {
      if (std::get<bool>(given)) value = false;
    });
  }
  /// A boolean that the file writes as one of two words, `words[false]` and `words[true]`.
  bool either(std::string_view key, bool& value, const About& about);
  bool number(std::string_view key, double& value, const About& about);
  bool number(std::string_view key, std::optional<double>& value, const About& about);
  /// Visits a number, nothing, or `about.word`, which sets `worded`.
  bool number(std::string_view key, std::optional<double>& value, bool& worded, const About& about);
  template <std::integral Integer>
  bool count(std::string_view key, Integer& value, const About& about) {
    return met({key, SettingKind::count, about}, static_cast<double>(value),
               [&value](const SettingValue& given) { value = static_cast<Integer>(std::get<double>(given)); });
  }
  template <std::integral Integer>
  bool count(std::string_view key, std::optional<Integer>& value, const About& about) {
    return met({key, SettingKind::count, about}, value ? SettingValue(static_cast<double>(*value)) : SettingValue(),
               [&value](const SettingValue& given) { value = static_cast<Integer>(std::get<double>(given)); });
  }
  bool text(std::string_view key, std::string& value, const About& about);
  /// Visits a text, or a table { `about.table` = text }, which goes to `instead`.
  bool text(std::string_view key, std::string& value, std::optional<std::string>& instead, const About& about);
  bool path(std::string_view key, std::filesystem::path& value, const About& about);
  bool path(std::string_view key, std::string& value, const About& about);
  bool folder(std::string_view key, std::string& value, const About& about);
  bool folder(std::string_view key, std::filesystem::path& value, const About& about);
  bool path(std::string_view key, std::optional<std::filesystem::path>& value, const About& about);
  /// Visits a list; an empty one stands for `about.word`, if there is one.
  bool texts(std::string_view key, std::vector<std::string>& value, const About& about);
  bool paths(std::string_view key, std::vector<std::filesystem::path>& value, const About& about);
  bool paths(std::string_view key, std::vector<std::string>& value, const About& about);
  bool numbers(std::string_view key, std::vector<double>& value, const About& about);
  /// Visits a list of stretches [begin, end]; `about.word` among them sets `worded`.
  bool stretches(std::string_view key, std::vector<Stretch>& value, bool& worded, const About& about);
  bool texts_by_name(std::string_view key, std::map<std::string, std::string>& value, const About& about);
  bool numbers_by_name(std::string_view key, std::map<std::string, double>& value, const About& about);

  /// Visits a value of an enumeration; `about.words` are the allowed names (empty: all).
  template <typename Enumeration>
  bool choice(std::string_view key, Enumeration& value, About about) {
    if (about.words.empty()) about.words = choice_names(value);
    return met({key, SettingKind::text, about}, std::string(choice_name(value)), [&value](const SettingValue& given) {
      if (const auto* name = std::get_if<std::string>(&given)) value = *choice_named<Enumeration>(*name);
    });
  }
  /// Visits such a value or none; the one of `about.words` that names no value, if any, stands for none.
  template <typename Enumeration>
  bool choice(std::string_view key, std::optional<Enumeration>& value, About about) {
    if (about.words.empty()) about.words = choice_names(Enumeration{});
    const auto none =
        std::ranges::find_if(about.words, [](std::string_view word) { return !choice_named<Enumeration>(word); });
    const std::string_view now = value ? choice_name(*value) : none == about.words.end() ? "" : *none;
    return met({key, SettingKind::text, about}, std::string(now), [&value](const SettingValue& given) {
      if (const auto* name = std::get_if<std::string>(&given)) value = choice_named<Enumeration>(*name);
    });
  }
  /// Visits a list of such values.
  template <typename Enumeration>
  bool choices(std::string_view key, std::vector<Enumeration>& value, About about) {
    if (about.words.empty()) about.words = choice_names(Enumeration{});
    std::vector<std::string> names;
    for (const Enumeration each : value) names.emplace_back(choice_name(each));
    return met({key, SettingKind::texts, about}, names, [&value](SettingValue given) {
      value.clear();
      for (const std::string& name : std::get<std::vector<std::string>>(given))
        value.push_back(*choice_named<Enumeration>(name));
    });
  }

  /// Visits a table whose settings `inside` visits: [key] of a study or { ... } within a table.
  /// `present`: the table is written.
  bool table(std::string_view key, bool present, const About& about, const Inside& inside) {
    return entered(key, present, about, inside);
  }
  template <typename Spec>
  void table(std::string_view key, Spec& spec, const About& about) {
    entered(key, true, about, [&spec](SettingVisitor& v) { visit(spec, v); });
  }
  template <typename Spec>
  void table(std::string_view key, std::optional<Spec>& spec, const About& about) {
    entered(key, spec.has_value(), about, [&spec](SettingVisitor& v) {
      if (!spec) spec.emplace();
      visit(*spec, v);
    });
  }
  /// Visits one table [[key]] for each of `specs`.
  template <typename Spec>
  void tables(std::string_view key, std::vector<Spec>& specs, const About& about) {
    repeated(key, specs.size(), about, [&specs](std::size_t i, SettingVisitor& v) {
      if (i >= specs.size()) specs.resize(i + 1);
      visit(specs[i], v);
    });
  }

  /// A setting of an earlier version: a file may hold it, and `said` then gets a sentence with the reason why it has no
  /// effect. No other visitor meets it.
  virtual void retired(std::string_view key, std::string_view why, std::vector<std::string>& said);

  /// Refuses a file with contradictory settings: ReadError at the line of `key`.
  virtual void must(bool holds, std::string_view key, const std::string& message);

 protected:
  using Set = std::function<void(SettingValue)>;
  using InsideEach = std::function<void(std::size_t, SettingVisitor&)>;
  /// Visits one setting with its present value and its setter. Returns whether a file gave the setting.
  virtual bool met(const Setting& setting, const SettingValue& now, const Set& set) = 0;
  virtual bool entered(std::string_view key, bool present, const About& about, const Inside& inside) = 0;
  virtual void repeated(std::string_view key, std::size_t count, const About& about, const InsideEach& inside) = 0;
};

/// A visitor of settings outside tables.
class FlatSettingVisitor : public SettingVisitor {
 protected:
  bool entered(std::string_view /*key*/, bool /*present*/, const About& /*about*/, const Inside& /*inside*/) override {
    return false;
  }
  void repeated(std::string_view /*key*/,
                std::size_t /*count*/,
                const About& /*about*/,
                const InsideEach& /*inside*/) override {}
};

}  // namespace myoid::study
