#include "myoid/results/cohort/group.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/page/tables.h"
#include "myoid/page/write_report.h"
#include "myoid/recording/bids_derivative.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/results/cohort/group_page.h"
#include "myoid/results/cohort/group_person.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;
using page::Cell;

constexpr std::size_t kMostInHeadline = 20;  // persons without results, in the headline
using recording::CsvTable;

page::Badge badge(const std::optional<Outcome>& outcome) {
  if (!outcome) return page::Badge::weak;
  switch (outcome->kind) {
    case OutcomeKind::done:
      return page::Badge::good;
    case OutcomeKind::gate_failed:
    case OutcomeKind::trials_failed:
      return page::Badge::weak;
    case OutcomeKind::failed:
      return page::Badge::bad;
  }
  return page::Badge::none;
}

bool has_results(const PersonOutcome& each) { return each.outcome && each.outcome->kind != OutcomeKind::failed; }

/// Returns the name and further columns.
std::vector<std::string> own_cells(const Person& person) {
  std::vector<std::string> texts{person.name};
  for (const auto& [name, text] : person.facts) texts.push_back(text);
  return texts;
}

page::Table persons_table(const Manifest& manifest, const std::vector<PersonOutcome>& outcomes) {
  page::Table table{.id = "persons", .title = "Persons", .caption = {}, .columns = {"person"}, .rows = {}};
  for (const std::string& name : manifest.fact_names()) table.columns.push_back(name);
  for (const char* name : {"study", "folder", "outcome", "message"}) table.columns.emplace_back(name);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Person& person = manifest.persons[i];
    const std::optional<Outcome>& outcome = outcomes[i].outcome;
    std::vector<std::string> texts = own_cells(person);
    texts.push_back(person.study.string());
    texts.push_back(person_folder("", person).generic_string());
    texts.push_back(outcome ? std::string(choice_name(outcome->kind)) : "not computed");
    texts.push_back(outcome ? outcome->message : "");
    table.rows.push_back(page::text_row(std::move(texts)));
    table.rows.back()[table.rows.back().size() - 2].badge = badge(outcome);
  }
  return table;
}

/// Adds the columns of a person's parameters.csv that are not there yet behind the first `own` columns.
void add_columns(std::vector<std::string>& columns, std::size_t own, const CsvTable& parameters) {
  for (const std::string& name : parameters.names) {
    const auto behind_own = columns.begin() + static_cast<std::ptrdiff_t>(own);
    if (std::find(behind_own, columns.end(), name) == columns.end()) columns.push_back(name);
  }
}

/// Returns the rows of a person's parameters.csv behind the person's own columns. A column that the file does not have
/// stays empty.
std::string rows_of(const Person& person, const CsvTable& parameters, const std::vector<std::string>& columns) {
  const std::vector<std::string> own = own_cells(person);
  std::vector<std::size_t> place;
  for (const std::string& name : parameters.names) {
    const auto found = std::find(columns.begin() + static_cast<std::ptrdiff_t>(own.size()), columns.end(), name);
    place.push_back(static_cast<std::size_t>(found - columns.begin()));
  }
  std::string text;
  for (const auto& row : parameters.rows) {
    std::vector<std::string> texts = own;
    texts.resize(columns.size());
    for (std::size_t i = 0; i < row.size(); ++i)
      if (place[i] < texts.size()) texts[place[i]] = row[i];
    text += page::csv_line(texts);
  }
  return text;
}

/// Writes cohort.csv without holding the rows of more than one person.
void write_numbers(const Group& group, const Manifest& manifest, const fs::path& folder) {
  FileInParts file(folder / "cohort.csv");
  file.append(page::csv_line(group.columns));
  for (std::size_t i = 0; i < manifest.persons.size(); ++i) {
    const Person& person = manifest.persons[i];
    if (!has_results(group.outcomes[i])) continue;
    const CsvTable parameters = recording::read_csv_table(person_folder(folder, person) / "parameters.csv");
    file.append(rows_of(person, parameters, group.columns));
  }
  file.finish();
}

/// Returns the first rows of the persons for the page, those without results before the others.
page::Table shown_persons(page::Table all) {
  constexpr std::size_t kMostOnPage = 200;
  if (all.rows.size() <= kMostOnPage) return all;
  const auto is_done = [](const std::vector<Cell>& row) { return row[row.size() - 2].badge == page::Badge::good; };
  std::ranges::stable_sort(all.rows, {}, is_done);
  all.caption =
      fmt::format("{} of {}, those that are not done first; all are in persons.csv.", kMostOnPage, all.rows.size());
  all.rows.resize(kMostOnPage);
  return all;
}

page::Report page_of(const Manifest& manifest, const Group& group, const std::vector<GroupPerson>& persons) {
  GroupPage beside = group_page(persons);
  page::Report page;
  page.title = "A cohort";
  page.subtitle = counted(group.outcomes.size(), "person");
  page.headline = fmt::format("{} of {} persons have results.", persons.size(), group.outcomes.size());
  const std::vector<std::string> failed = failures(group.outcomes);
  for (std::size_t i = 0; i < std::min(failed.size(), kMostInHeadline); ++i)
    page.headline += " Without: " + failed[i] + ".";
  if (failed.size() > kMostInHeadline)
    page.headline += fmt::format(" And {} more, named in persons.csv.", failed.size() - kMostInHeadline);
  if (!beside.outliers.empty()) page.headline += " " + outlier_sentence(beside.outliers);
  page.links = {{"every number of every person", "cohort.csv"}, {"the persons", "persons.csv"}};
  page::Section people;
  people.id = "people";
  people.heading = "The persons";
  people.tables.push_back(shown_persons(group.persons));
  page.sections = {std::move(beside.persons), std::move(people)};
  page.provenance = {{"program", fmt::format("myoid {}", version())}, {"manifest", manifest.file.string()}};
  return page;
}

std::string participants_tsv(const Manifest& manifest) {
  std::string text = "participant_id";
  for (const std::string& name : manifest.fact_names()) text += "\t" + name;
  text += '\n';
  for (const Person& person : manifest.persons) {
    text += "sub-" + person.label;
    for (const auto& [name, value] : person.facts) text += "\t" + (value.empty() ? "n/a" : value);
    text += '\n';
  }
  return text;
}

}  // namespace

Group read_group(const Manifest& manifest, const fs::path& folder) {
  Group group;
  group.columns = {"person"};
  for (const std::string& name : manifest.fact_names()) group.columns.push_back(name);
  const std::size_t own = group.columns.size();
  std::vector<GroupPerson> persons;
  for (const Person& person : manifest.persons) {
    const fs::path place = person_folder(folder, person);
    group.outcomes.push_back({.person = person.name, .outcome = read_outcome(place)});
    if (!has_results(group.outcomes.back())) continue;
    const CsvTable parameters = recording::read_csv_table(place / "parameters.csv");
    add_columns(group.columns, own, parameters);
    persons.push_back({.name = person.name,
                       .page = (person_folder("", person) / "report.html").generic_string(),
                       .numbers = group_numbers(parameters),
                       .quality = run_quality(place)});
  }
  group.persons = persons_table(manifest, group.outcomes);
  group.page = page_of(manifest, group, persons);
  return group;
}

void write_group(const Group& group, const Manifest& manifest, const fs::path& folder) {
  remove_earlier_results(folder);
  write_file(folder / "persons.csv", page::table_csv(group.persons));
  page::write_report(group.page, folder);
  write_unless_foreign(folder / "participants.tsv", participants_tsv(manifest));
  write_unless_foreign(folder / ".bidsignore", "persons/\nworkflow/\nfigures/\ntables/\n*.csv\nreport.*\n");
  for (std::size_t i = 0; i < manifest.persons.size(); ++i) {
    const Person& person = manifest.persons[i];
    if (has_results(group.outcomes[i]))
      recording::write_bids_derivative(person_folder(folder, person), folder, person.label);
  }
  // Last: a workflow takes this file as the end of the step.
  write_numbers(group, manifest, folder);
}

}  // namespace myoid::results
