#include "myoid/results/cohort/manifest.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/recording/tables/csv_reader.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;
using recording::CsvTable;

constexpr std::string_view kSub = "sub-";

/// Adds persons whose names are free.
class Roll {
 public:
  explicit Roll(Manifest& manifest) : manifest_(&manifest) {}

  void add(Person person, std::size_t line) {
    if (const std::string reason = name_refusal(person.name); !reason.empty())
      throw ReadError(manifest_->file, line, fmt::format("the name of a person: {}", reason));
    const auto [other, is_new] = lines_.emplace(person.name, line);
    if (!is_new)
      throw ReadError(
          manifest_->file, line,
          fmt::format("the person '{}' stands in line {} too; give each person one name", person.name, other->second));
    manifest_->persons.push_back(std::move(person));
  }

  /// Gives every person an id and a BIDS label.
  void finish() {
    std::vector<std::string> names, bare;
    for (const Person& person : manifest_->persons) {
      names.push_back(person.name);
      bare.push_back(person.name.starts_with(kSub) ? person.name.substr(kSub.size()) : person.name);
    }
    const std::vector<std::string> ids = ids_of(names);
    const std::vector<std::string> labels = ids_of(bare, IdFor::label);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      manifest_->persons[i].id = ids[i];
      manifest_->persons[i].label = labels[i];
    }
  }

 private:
  Manifest* manifest_;
  std::map<std::string, std::size_t> lines_;
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
              .id = {},
              .label = {},
              .study = file.parent_path() / row[study],
              .facts = facts_of(table, row, {name, study})},
             table.lines[i]);
  }
  if (manifest.persons.empty())
    throw ReadError(file, table.header_line, "the table has no person; add one row a person");
  roll.finish();
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
    roll.add({.name = name, .id = {}, .label = {}, .study = file, .facts = participants.of(name)}, 0);
  if (names.empty()) throw ReadError(folder, 0, "the folder has no folder sub-…; a BIDS data set has one a person");
  roll.finish();
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
  // A name goes before an id and a label: another person may be called so.
  const auto fitting = [&](const std::string& name) -> const Person* {
    const std::string label = name.starts_with(kSub) ? name.substr(kSub.size()) : name;
    for (const auto& [member, text] :
         {std::pair{&Person::name, name}, std::pair{&Person::id, name}, std::pair{&Person::label, label}}) {
      const auto found = std::ranges::find(manifest.persons, text, member);
      if (found != manifest.persons.end()) return &*found;
    }
    return nullptr;
  };
  std::set<const Person*> wanted;
  for (const std::string& name : names) {
    if (const Person* found = fitting(name)) {
      wanted.insert(found);
      continue;
    }
    std::vector<std::string> known;
    for (const Person& person : manifest.persons) known.push_back(person.name);
    throw InvalidInput(fmt::format("{} has no person '{}'{}; it has {} persons", manifest.file.string(), name,
                                   did_you_mean(name, known), known.size()));
  }
  std::vector<const Person*> chosen;
  for (const Person& person : manifest.persons) {
    if (names.empty() || wanted.contains(&person)) chosen.push_back(&person);
  }
  return chosen;
}

fs::path person_folder(const fs::path& cohort, const Person& person) { return cohort / kPersonsFolder / person.id; }

}  // namespace myoid::results
