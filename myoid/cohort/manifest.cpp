#include "myoid/cohort/manifest.h"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/files/toml_table.h"
#include "myoid/tables/csv_reader.h"

namespace myoid::cohort {
namespace {

namespace fs = std::filesystem;
using recording::CsvTable;

constexpr std::string_view kSub = "sub-";

bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

std::string label_of(std::string_view name) {
  if (name.starts_with(kSub)) name.remove_prefix(kSub.size());
  std::string label;
  std::ranges::copy_if(name, std::back_inserter(label), is_letter_or_digit);
  return label;
}

void check_name(const fs::path& file, std::size_t line, const std::string& name) {
  const bool known =
      std::ranges::all_of(name, [](char c) { return is_letter_or_digit(c) || c == '-' || c == '_' || c == '.'; });
  if (known && !name.starts_with('.') && !name.starts_with('-') && !label_of(name).empty()) return;
  throw ReadError(file, line,
                  fmt::format("found the name '{}', expected letters, digits, '-', '_' and '.', the first a letter or "
                              "digit; it names a folder of results",
                              name));
}

/// Adds a person whose name and label are free.
class Roll {
 public:
  explicit Roll(Manifest& manifest) : manifest_(&manifest) {}

  void add(Person person, std::size_t line) {
    check_name(manifest_->file, line, person.name);
    person.label = label_of(person.name);
    const auto [other, is_new] = by_label_.emplace(person.label, person.name);
    if (!is_new)
      throw ReadError(manifest_->file, line,
                      fmt::format("the persons '{}' and '{}' have one BIDS label, '{}' (the letters and digits of the "
                                  "name); rename one of them",
                                  other->second, person.name, person.label));
    manifest_->persons.push_back(std::move(person));
  }

 private:
  Manifest* manifest_;
  std::map<std::string, std::string> by_label_;
};

std::size_t column(const CsvTable& table, const fs::path& file, std::string_view name) {
  const auto found = std::ranges::find(table.names, name);
  if (found == table.names.end())
    throw ReadError(file, table.header_line,
                    fmt::format("no column '{}'; found the columns {}", name, fmt::join(table.names, ", ")));
  return static_cast<std::size_t>(found - table.names.begin());
}

/// Returns the cells of a row outside the columns `without`.
std::vector<std::pair<std::string, std::string>> facts_of(const CsvTable& table,
                                                          const std::vector<std::string>& row,
                                                          const std::vector<std::size_t>& without) {
  std::vector<std::pair<std::string, std::string>> facts;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (std::ranges::find(without, c) != without.end()) continue;
    facts.emplace_back(table.names[c], row[c] == "n/a" ? "" : row[c]);
  }
  return facts;
}

Manifest read_table(const fs::path& file) {
  const CsvTable table = recording::read_csv_table(file);
  const std::size_t name = column(table, file, "name");
  const std::size_t study = column(table, file, "study");
  Manifest manifest{.file = file, .persons = {}};
  Roll roll(manifest);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<std::string>& row = table.rows[i];
    if (row[study].empty())
      throw ReadError(file, table.lines[i],
                      fmt::format("the person '{}' has no study; name the study file", row[name]));
    roll.add({.name = row[name],
              .label = {},
              .study = file.parent_path() / row[study],
              .facts = facts_of(table, row, {name, study})},
             table.lines[i]);
  }
  if (manifest.persons.empty())
    throw ReadError(file, table.header_line, "the table has no person; add one row a person");
  return manifest;
}

/// The columns of participants.tsv by person; one without a row has empty cells.
class Participants {
 public:
  explicit Participants(const fs::path& file) {
    if (!fs::exists(file)) return;
    const CsvTable table = recording::read_csv_table(file);
    const std::size_t id = column(table, file, "participant_id");
    for (std::size_t c = 0; c < table.names.size(); ++c) {
      if (c != id) absent_.emplace_back(table.names[c], "");
    }
    for (const std::vector<std::string>& row : table.rows) by_id_[row[id]] = facts_of(table, row, {id});
  }

  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& of(const std::string& id) const {
    const auto found = by_id_.find(id);
    return found == by_id_.end() ? absent_ : found->second;
  }

 private:
  std::vector<std::pair<std::string, std::string>> absent_;
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> by_id_;
};

Manifest read_bids(const fs::path& folder, const fs::path& study) {
  const Participants participants(folder / "participants.tsv");
  const fs::path file = study.empty() ? folder / "code" / "study.toml" : study;
  if (!fs::exists(file))
    throw ReadError(file, 0,
                    "there is no such file; it has to be the study of every person, with {name} for the folder sub-… "
                    "and {label} for its label");
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name.starts_with(kSub)) names.push_back(name);
  }
  std::ranges::sort(names);
  Manifest manifest{.file = folder, .persons = {}};
  Roll roll(manifest);
  for (const std::string& name : names)
    roll.add({.name = name, .label = {}, .study = file, .facts = participants.of(name)}, 0);
  if (names.empty()) throw ReadError(folder, 0, "the folder has no folder sub-…; a BIDS data set has one a person");
  return manifest;
}

}  // namespace

std::vector<std::string> Manifest::fact_names() const {
  std::vector<std::string> names;
  for (const auto& [name, cell] : persons.front().facts) names.push_back(name);
  return names;
}

Manifest read_manifest(const fs::path& file, const fs::path& study) {
  if (fs::is_directory(file)) return read_bids(file, study);
  if (!study.empty())
    throw InvalidInput(fmt::format(
        "--study goes with a BIDS data set; {} is a table, whose column 'study' names the study of each person",
        file.string()));
  return read_table(file);
}

std::vector<const Person*> chosen_persons(const Manifest& manifest, const std::vector<std::string>& names) {
  const auto answers = [](const Person& person, const std::string& name) {
    return name == person.name || name == person.label || name == "sub-" + person.label;
  };
  for (const std::string& name : names) {
    if (std::ranges::any_of(manifest.persons, [&](const Person& person) { return answers(person, name); })) continue;
    std::vector<std::string> known;
    for (const Person& person : manifest.persons) known.push_back(person.name);
    const auto near = recording::nearest_word(name, known);
    throw InvalidInput(fmt::format("{} has no person '{}'{}; it has {} persons", manifest.file.string(), name,
                                   near ? fmt::format(" (did you mean '{}'?)", *near) : "", known.size()));
  }
  std::vector<const Person*> chosen;
  for (const Person& person : manifest.persons) {
    if (names.empty() || std::ranges::any_of(names, [&](const std::string& name) { return answers(person, name); }))
      chosen.push_back(&person);
  }
  return chosen;
}

fs::path person_folder(const fs::path& cohort, const Person& person) { return cohort / kPersonsFolder / person.name; }

}  // namespace myoid::cohort
