#include "myoid/cohort/group.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/counted.h"
#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"
#include "myoid/math/statistics.h"
#include "myoid/recording/bids_derivative.h"
#include "myoid/report/tables.h"
#include "myoid/report/write_report.h"
#include "myoid/tables/csv_reader.h"

namespace myoid::cohort {
namespace {

namespace fs = std::filesystem;
using recording::CsvTable;
using report::Cell;

/// A number of one person that the recording tells.
struct Told {
  std::string person;
  double estimate = 0.0;
  double low = 0.0, high = 0.0;  ///< 95 % interval.
};

/// One parameter of one muscle over the persons.
struct Comparable {
  std::string parameter, muscle, unit;
  std::vector<Told> told;
};

report::Badge badge(const std::optional<Outcome>& outcome) {
  if (!outcome) return report::Badge::weak;
  switch (outcome->kind) {
    case OutcomeKind::done:
      return report::Badge::good;
    case OutcomeKind::gate_failed:
    case OutcomeKind::trials_failed:
      return report::Badge::weak;
    case OutcomeKind::failed:
      return report::Badge::bad;
  }
  return report::Badge::none;
}

bool has_results(const PersonOutcome& each) {
  return each.outcome && each.outcome->kind != OutcomeKind::failed;
}

std::string cell(const CsvTable& table, const std::vector<std::string>& row, const char* name) {
  const auto found = std::find(table.names.begin(), table.names.end(), name);
  return found == table.names.end() ? ""
                                    : row[static_cast<std::size_t>(found - table.names.begin())];
}

/// Collects the numbers of method torque (of the first method where torque was not asked for).
class Collection {
 public:
  void add(const std::string& person, const CsvTable& table) {
    std::string method;
    for (const auto& row : table.rows) {
      const std::string here = cell(table, row, "method");
      if (method.empty() || here == "torque") method = here;
    }
    for (const auto& row : table.rows) {
      if (cell(table, row, "method") == method) take(person, table, row);
    }
  }
  [[nodiscard]] std::vector<Comparable> list() const { return list_; }

 private:
  void take(const std::string& person, const CsvTable& table, const std::vector<std::string>& row) {
    const std::string verdict = cell(table, row, "verdict");
    const auto estimate = recording::parse_number(cell(table, row, "estimate"));
    const auto low = recording::parse_number(cell(table, row, "ci_low"));
    const auto high = recording::parse_number(cell(table, row, "ci_high"));
    if ((verdict != "identified" && verdict != "weak") || !estimate || !low || !high) return;
    const std::string muscle = cell(table, row, "muscle");
    const std::string fit_case = cell(table, row, "case");
    const std::string parameter =
        cell(table, row, "parameter") + (fit_case == "both" ? "" : ", " + fit_case);
    auto found = std::find_if(list_.begin(), list_.end(), [&](const Comparable& c) {
      return c.parameter == parameter && c.muscle == muscle;
    });
    if (found == list_.end())
      found = list_.insert(list_.end(), {parameter, muscle, cell(table, row, "unit"), {}});
    found->told.push_back({person, *estimate, *low, *high});
  }

  std::vector<Comparable> list_;
};

/// Each parameter's panel: the muscles side by side, in each the persons in order.
report::Panel strip(const std::string& parameter,
                    const std::vector<Comparable>& all,
                    const std::map<std::string, double>& place) {
  report::Panel panel;
  panel.title = parameter;
  panel.y.label = parameter;
  report::Series series;
  series.role = report::Role::points;
  for (const Comparable& c : all) {
    if (c.parameter != parameter) continue;
    panel.y.unit = c.unit == "1" ? "" : c.unit;
    const auto middle = static_cast<double>(panel.x.categories.size());
    panel.x.categories.push_back(c.muscle.empty() ? "all" : c.muscle);
    for (const Told& t : c.told) {
      series.x.push_back(middle + place.at(t.person));
      series.y.push_back(t.estimate);
      series.y_lower.push_back(t.low);
      series.y_upper.push_back(t.high);
    }
  }
  panel.series.push_back(std::move(series));
  return panel;
}

std::string id_of(const std::string& parameter) {
  std::string id;
  for (const char c : parameter) id += (c == ',' || c == ' ') ? '_' : c;
  return id;
}

std::vector<Cell> row_of(std::vector<std::string> texts) {
  std::vector<Cell> row;
  for (std::string& text : texts)
    row.push_back({.text = std::move(text), .badge = report::Badge::none, .hint = {}});
  return row;
}

/// Name and further columns.
std::vector<std::string> own_cells(const Person& person) {
  std::vector<std::string> texts{person.name};
  for (const auto& [name, text] : person.facts) texts.push_back(text);
  return texts;
}

report::Table summary_table(const std::vector<Comparable>& all, std::size_t persons) {
  report::Table table{.id = "summary",
                      .title = "Numbers that the recordings tell",
                      .caption = "Verdict identified or weak. Every person counts once.",
                      .columns = {"parameter", "muscle", "unit", "persons", "mean",
                                  "SD between persons", "median half width of the 95 % intervals"},
                      .rows = {}};
  for (const Comparable& c : all) {
    std::vector<double> estimates, widths;
    for (const Told& t : c.told) {
      estimates.push_back(t.estimate);
      widths.push_back(0.5 * (t.high - t.low));
    }
    const auto count = static_cast<double>(estimates.size());
    const double mean = std::accumulate(estimates.begin(), estimates.end(), 0.0) / count;
    double squares = 0.0;
    for (const double estimate : estimates) squares += (estimate - mean) * (estimate - mean);
    const std::string sd =
        estimates.size() < 2 ? "-" : report::format_value(std::sqrt(squares / (count - 1.0)));
    table.rows.push_back(row_of(
        {c.parameter, c.muscle, c.unit, fmt::format("{} of {}", estimates.size(), persons),
         report::format_value(mean), sd, report::format_value(math::median(std::move(widths)))}));
  }
  return table;
}

report::Table persons_table(const Manifest& manifest, const std::vector<PersonOutcome>& outcomes) {
  report::Table table{
      .id = "persons", .title = "Persons", .caption = {}, .columns = {"person"}, .rows = {}};
  for (const std::string& name : manifest.fact_names()) table.columns.push_back(name);
  for (const char* name : {"study", "outcome", "message"}) table.columns.emplace_back(name);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Person& person = manifest.persons[i];
    const std::optional<Outcome>& outcome = outcomes[i].outcome;
    std::vector<std::string> texts = own_cells(person);
    texts.push_back(person.study.string());
    texts.push_back(outcome ? std::string(choice_name(outcome->kind)) : "not computed");
    texts.push_back(outcome ? outcome->message : "");
    table.rows.push_back(row_of(std::move(texts)));
    table.rows.back()[table.rows.back().size() - 2].badge = badge(outcome);
  }
  return table;
}

/// The rows of parameters.csv behind the person's own columns.
void add_parameters(report::Table& table, const Person& person, const CsvTable& parameters) {
  if (table.columns.empty()) {
    table.columns.emplace_back("person");
    for (const auto& [name, text] : person.facts) table.columns.push_back(name);
    table.columns.insert(table.columns.end(), parameters.names.begin(), parameters.names.end());
  }
  for (const auto& row : parameters.rows) {
    std::vector<std::string> texts = own_cells(person);
    texts.insert(texts.end(), row.begin(), row.end());
    table.rows.push_back(row_of(std::move(texts)));
  }
}

report::Report page_of(const Manifest& manifest,
                       const Group& group,
                       const std::vector<Comparable>& all) {
  report::Report page;
  const auto computed = static_cast<std::size_t>(
      std::count_if(group.outcomes.begin(), group.outcomes.end(), has_results));
  page.title = "A cohort";
  page.subtitle = counted(group.outcomes.size(), "person");
  page.headline = fmt::format("{} of {} persons have results.", computed, group.outcomes.size());
  for (const std::string& line : failures(group.outcomes))
    page.headline += " Without: " + line + ".";
  page.links = {{"every number of every person", "cohort.csv"}, {"the persons", "persons.csv"}};
  for (std::size_t i = 0; i < group.outcomes.size(); ++i) {
    const Person& person = manifest.persons[i];
    if (has_results(group.outcomes[i]))
      page.links.push_back({person.name, (person_folder("", person) / "report.html").string()});
  }

  report::Section numbers{.id = "numbers", .heading = "The persons beside each other"};
  numbers.paragraphs.push_back(
      "A point is a person, the bar the 95 % interval. Numbers that a recording does not tell are "
      "left out. The spread of the points holds the differences between people and the errors of "
      "the estimates.");
  if (!all.empty()) numbers.tables.push_back(summary_table(all, computed));
  std::map<std::string, double> place;
  const auto last = static_cast<double>(std::max<std::size_t>(group.outcomes.size(), 2) - 1);
  for (std::size_t i = 0; i < group.outcomes.size(); ++i)
    place[group.outcomes[i].person] = 0.7 * (static_cast<double>(i) / last - 0.5);
  for (const Comparable& c : all) {
    const std::string id = id_of(c.parameter);
    if (std::any_of(numbers.figures.begin(), numbers.figures.end(),
                    [&](const report::Figure& figure) { return figure.id == id; }))
      continue;
    numbers.figures.push_back({.id = id,
                               .title = c.parameter,
                               .caption = "Each muscle: the persons from left to right.",
                               .panels = {strip(c.parameter, all, place)}});
  }
  report::Section people{.id = "people", .heading = "The persons"};
  people.tables.push_back(group.persons);
  page.sections = {std::move(numbers), std::move(people)};
  page.provenance = {{"program", fmt::format("myoid {}", version())},
                     {"manifest", manifest.file.string()}};
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
  group.parameters.id = "cohort";
  Collection collection;
  for (const Person& person : manifest.persons) {
    const fs::path place = person_folder(folder, person);
    group.outcomes.push_back({.person = person.name, .outcome = read_outcome(place)});
    if (!has_results(group.outcomes.back())) continue;
    const CsvTable parameters = recording::read_csv_table(place / "parameters.csv");
    add_parameters(group.parameters, person, parameters);
    collection.add(person.name, parameters);
  }
  group.persons = persons_table(manifest, group.outcomes);
  group.page = page_of(manifest, group, collection.list());
  return group;
}

void write_group(const Group& group, const Manifest& manifest, const fs::path& folder) {
  recording::write_file(folder / "persons.csv", report::table_csv(group.persons));
  report::write_report(group.page, folder);
  recording::write_file(folder / "participants.tsv", participants_tsv(manifest));
  recording::write_file(folder / ".bidsignore",
                        "persons/\nworkflow/\nfigures/\ntables/\n*.csv\nreport.*\n");
  for (std::size_t i = 0; i < manifest.persons.size(); ++i) {
    const Person& person = manifest.persons[i];
    std::error_code ignored;
    fs::remove_all(folder / ("sub-" + person.label), ignored);
    if (has_results(group.outcomes[i]))
      recording::write_bids_derivative(person_folder(folder, person), folder, person.label);
  }
  // Last: a workflow takes this file as the end of the step.
  recording::write_file(folder / "cohort.csv", report::table_csv(group.parameters));
}

}  // namespace myoid::cohort
