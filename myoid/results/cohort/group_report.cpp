#include "myoid/results/cohort/group_report.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/results/cohort/group_changes.h"
#include "myoid/results/cohort/group_page.h"
#include "myoid/results/cohort/group_person.h"
#include "myoid/results/comparison/change_sentences.h"

namespace myoid::results {
namespace {

std::vector<PersonChange> changes_of(const GroupReportOptions& options) {
  const std::vector<GroupRun> first = group_runs(options.persons), second = group_runs(options.after);
  if (first.size() != second.size())
    throw InvalidInput(
        fmt::format("--group names {} and --after {}: give both sessions of the same persons, in the same order",
                    counted(first.size(), "run"), counted(second.size(), "run")));
  std::vector<PersonChange> changes;
  for (std::size_t i = 0; i < first.size(); ++i)
    changes.push_back(
        {first[i].name, page_of(second[i], options.folder), compare_runs(first[i].folder, second[i].folder)});
  return changes;
}

/// Returns the persons' changes: "P7: Biceps stronger by 150 N (25 %, ...)."
std::string change_sentence(const std::vector<PersonChange>& changes) {
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> found, treated;
  for (const PersonChange& person : changes) {
    if (!person.comparison.one_recording.empty()) treated.push_back(person.person);
    for (const ComparedParameter* p : counted_parameters(person.comparison))
      if (p->change == Change::differs) found.push_back(fmt::format("{}: {}", person.person, change_text(*p)));
  }
  if (!treated.empty())
    found.insert(found.begin(), fmt::format("Differences of {} are of the treatment: both runs rest on one recording",
                                            fmt::join(treated, ", ")));
  if (found.empty()) return "No number of any person changed by more than chance explains.";
  const std::size_t more = found.size() - std::min(found.size(), kNamed);
  found.resize(found.size() - more);
  return fmt::format("{}{}.", fmt::join(found, ". "), more > 0 ? fmt::format(". And {} more", more) : "");
}

/// Returns a warning if persons are not of one kind: other joints or muscles, or one recording in two runs. Each person
/// is compared with the first, recordings with all before.
std::optional<page::Gate> kind_gate(const std::vector<GroupPerson>& persons) {
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> found;
  for (std::size_t i = 1; i < persons.size(); ++i) {
    for (std::size_t before = 0; before < i; ++before) {
      const study::IdentityDifferences unlike =
          study::differences(persons[before].identity, persons[i].identity, study::Whose::several_persons);
      std::vector<std::string> texts = unlike.grave;
      texts.insert(texts.end(), unlike.other.begin(), unlike.other.end());
      if (texts.empty()) continue;
      found.push_back(fmt::format("{} and {}: {}", persons[before].name, persons[i].name, fmt::join(texts, "; ")));
      break;
    }
  }
  if (found.empty()) return std::nullopt;
  const std::size_t more = found.size() - std::min(found.size(), kNamed);
  found.resize(found.size() - more);
  return page::Gate{"Persons of one kind", page::GateStatus::warn,
                    fmt::format("{}{}", fmt::join(found, "; "), more > 0 ? fmt::format("; and {} more", more) : ""),
                    "the same coordinates and muscles, and no recording twice",
                    "Medians, spreads and outliers mean nothing among persons of several kinds."};
}

/// Returns a warning if files of the runs were changed since the runs wrote them.
std::optional<page::Gate> changed_gate(const std::vector<GroupPerson>& persons,
                                       const std::vector<std::filesystem::path>& after) {
  std::vector<std::string> found;
  for (const GroupPerson& person : persons) found.insert(found.end(), person.changed.begin(), person.changed.end());
  if (!after.empty()) {
    for (const GroupRun& run : group_runs(after))
      for (std::string& text : changed_files(run)) found.push_back(std::move(text));
  }
  if (found.empty()) return std::nullopt;
  return page::Gate{"Results as they were written", page::GateStatus::warn, fmt::format("{}", fmt::join(found, "; ")),
                    "every file that is read has the content on the list .myoid.files of its folder",
                    "Numbers of the group may not be those of the runs."};
}

}  // namespace

page::Report group_report(const GroupReportOptions& options) {
  const std::vector<GroupPerson> persons = read_group_persons(options.persons, options.folder);
  GroupPage beside = group_page(persons);
  page::Report page;
  page.title = "A group";
  page.subtitle = counted(persons.size(), "person");
  if (!beside.outliers.empty())
    page.headline = outlier_sentence(beside.outliers);
  else if (persons.size() >= kFewestForOutliers)
    page.headline = "No person's numbers lie far from the others'.";
  if (!options.after.empty()) {
    const std::vector<PersonChange> changes = changes_of(options);
    page.title = "Two sessions";
    page.headline = change_sentence(changes) + (page.headline.empty() ? "" : " " + page.headline);
    page.sections.push_back(change_section(changes));
  }
  page.sections.push_back(std::move(beside.persons));
  if (std::optional<page::Gate> gate = kind_gate(persons)) page.gates.push_back(std::move(*gate));
  if (std::optional<page::Gate> gate = changed_gate(persons, options.after)) page.gates.push_back(std::move(*gate));
  page.provenance = {{"program", fmt::format("myoid {}", version())}};
  const auto add_folders = [&](const char* what, const std::vector<std::filesystem::path>& folders) {
    constexpr std::size_t kMostFolders = 200;
    for (std::size_t i = 0; i < std::min(folders.size(), kMostFolders); ++i)
      page.provenance.push_back({what, folders[i].string()});
    if (folders.size() > kMostFolders)
      page.provenance.push_back({what, fmt::format("and {} more", folders.size() - kMostFolders)});
  };
  add_folders("persons", options.persons);
  add_folders("second sessions", options.after);
  return page;
}

}  // namespace myoid::results
