#include "myoid/cohort/person_study.h"

#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"
#include "myoid/study/read_study.h"
#include "myoid/study/study_text.h"

namespace myoid::cohort {
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
  std::vector<std::string> known{"name", "label"};
  for (const auto& [name, cell] : person.facts) {
    known.push_back(name);
    if (name != word) continue;
    if (!cell.empty()) return cell;
    throw ReadError(file, line, fmt::format("the person '{}' has no value in the column '{}'", person.name, word));
  }
  throw ReadError(file, line,
                  fmt::format("found {{{}}}, expected a column of the manifest: {}", word, fmt::join(known, ", ")));
}

}  // namespace

std::string filled_study(std::string_view text, const fs::path& file, const Person& person) {
  std::string filled;
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') ++line;
    const std::size_t length = text[i] == '{' ? word_in_braces(text.substr(i + 1)) : 0;
    if (length == 0) {
      filled += text[i];
      continue;
    }
    filled += value_of(text.substr(i + 1, length - 1), person, file, line);
    i += length;
  }
  return filled;
}

fs::path person_study(const Person& person, const fs::path& folder) {
  const std::string text = recording::read_text_file(person.study);
  const std::string filled = filled_study(text, person.study, person);
  if (filled == text) return person.study;
  // Absolute paths hold in the folder of the results, too.
  Study study = parse_study(filled, fs::absolute(person.study).lexically_normal());
  study.file = fs::absolute(folder / "study.toml").lexically_normal();
  const std::string own = study_toml(study);
  const fs::path place = folder / "study.toml";
  recording::write_file(place, own);
  return place;
}

}  // namespace myoid::cohort
