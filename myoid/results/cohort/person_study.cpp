#include "myoid/results/cohort/person_study.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/study/read_study.h"
#include "myoid/study/study_text.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;

/// Returns the length of "word}" at the begin of the text, 0 without one: TOML's own braces hold "=".
std::size_t word_in_braces(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size() && (std::isalnum(static_cast<unsigned char>(text[length])) != 0 || text[length] == '_'))
    ++length;
  const bool closed = length > 0 && length < text.size() && text[length] == '}';
  return closed ? length + 1 : 0;
}

std::string value_of(std::string_view word, const Person& person, const fs::path& file, std::size_t line) {
  if (word == "name") return person.name;
  if (word == "label") return person.label;
  if (word == "id") return person.id;
  std::vector<std::string> known{"name", "label", "id"};
  for (const auto& [name, cell] : person.facts) {
    known.push_back(name);
    if (name != word) continue;
    if (!cell.empty()) return cell;
    throw ReadError(file, line, fmt::format("the person '{}' has no value in the column '{}'", person.name, word));
  }
  throw ReadError(file, line,
                  fmt::format("found {{{}}}, expected a column of the manifest: {}", word, fmt::join(known, ", ")));
}

/// A stretch of a TOML text: a string with its quotes, a remark to the end of its line, or what is between them.
struct TomlPart {
  enum class Kind { bare, remark, basic, literal };
  Kind kind = Kind::bare;
  std::size_t length = 0;
  std::size_t quotes = 0;  ///< At each end of a string: 1 or 3.
};

/// Returns the first stretch of a text that is not empty. A string without an end goes to the end of the text: TOML's
/// reader refuses it.
TomlPart first_part(std::string_view text) {
  using Kind = TomlPart::Kind;
  const char first = text[0];
  if (first == '#') return {Kind::remark, std::min(text.find('\n'), text.size()), 0};
  if (first != '"' && first != '\'') return {Kind::bare, std::min(text.find_first_of("#\"'"), text.size()), 0};
  const Kind kind = first == '"' ? Kind::basic : Kind::literal;
  const std::size_t quotes = text.starts_with(std::string(3, first)) ? 3 : 1;
  const std::string end(quotes, first);
  for (std::size_t i = quotes; i < text.size(); ++i) {
    if (kind == Kind::basic && text[i] == '\\') {
      ++i;
    } else if (text.substr(i).starts_with(end)) {
      return {kind, i + quotes, quotes};
    }
  }
  return {kind, text.size(), 0};
}

/// Returns a value as it stands in a basic string.
std::string inside_quotes(const std::string& value) {
  const std::string quoted = toml_text(value);
  return quoted.substr(1, quoted.size() - 2);
}

}  // namespace

std::string filled_study(std::string_view text, const fs::path& file, const Person& person) {
  std::string filled;
  std::size_t line = 1;
  while (!text.empty()) {
    const TomlPart part = first_part(text);
    const std::string_view content = text.substr(0, part.length);
    text.remove_prefix(part.length);
    std::string result;
    bool any = false;
    for (std::size_t i = 0; i < content.size(); ++i) {
      const std::size_t length = content[i] == '{' ? word_in_braces(content.substr(i + 1)) : 0;
      if (length == 0) {
        result += content[i];
        continue;
      }
      const auto above = static_cast<std::size_t>(std::ranges::count(content.substr(0, i), '\n'));
      const std::string value = value_of(content.substr(i + 1, length - 1), person, file, line + above);
      result += part.kind == TomlPart::Kind::basic ? inside_quotes(value) : value;
      i += length;
      any = true;
    }
    // A literal string knows no escapes: with a value in it, it becomes a basic one.
    if (any && part.kind == TomlPart::Kind::literal)
      result = toml_text(std::string_view(result).substr(part.quotes, result.size() - 2 * part.quotes));
    filled += result;
    line += static_cast<std::size_t>(std::ranges::count(content, '\n'));
  }
  return filled;
}

void add_bids_filter(const fs::path& file, BidsFilter& filter) {
  static const std::map<std::string, std::string> shorts{{"session", "ses"}, {"acquisition", "acq"}};
  using Entities = std::map<std::string, nlohmann::json>;
  try {
    for (const auto& [modality, entities] : parse_json(read_text_file(file)).get<std::map<std::string, Entities>>()) {
      for (const auto& [name, values] : entities) {
        const auto known = shorts.find(name);
        std::vector<std::string>& of = filter[known == shorts.end() ? name : known->second];
        if (values.is_string())
          of.push_back(values.get<std::string>());
        else
          for (const auto& value : values.get<std::vector<std::string>>()) of.push_back(value);
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw ReadError(file, 0, "is no filter of BIDS, {{\"motion\": {{\"session\": \"01\"}}}}: {}",
                    json_error_text(error));
  }
}

bool passes(const study::TrialSpec& trial, const BidsFilter& filter) {
  for (const auto* path : {&trial.markers, &trial.motion, &trial.emg}) {
    if (!*path) continue;
    std::string name = "_" + (*path)->stem().string() + "_";
    for (const auto& [entity, values] : filter) {
      const std::size_t at = name.find("_" + entity + "-");
      if (at == std::string::npos) continue;
      const std::size_t begin = at + entity.size() + 2;
      if (std::ranges::find(values, name.substr(begin, name.find('_', begin) - begin)) == values.end()) return false;
    }
  }
  return true;
}

fs::path person_study(const Person& person, const fs::path& folder, const BidsFilter& filter) {
  const std::string text = read_text_file(person.study);
  const std::string filled = filled_study(text, person.study, person);
  if (filled == text && filter.empty()) return person.study;
  // Absolute paths hold in the folder of the results, too.
  study::Study study = study::parse_study(filled, fs::absolute(person.study).lexically_normal());
  study.file = fs::absolute(folder / "study.toml").lexically_normal();
  std::erase_if(study.trials, [&](const study::TrialSpec& trial) { return !passes(trial, filter); });
  if (study.trials.empty()) throw ReadError(person.study, 0, "the filter of sessions and tasks leaves no trial");
  const std::string own = study::study_toml(study);
  const fs::path place = folder / "study.toml";
  write_file(place, own);
  return place;
}

}  // namespace myoid::results
