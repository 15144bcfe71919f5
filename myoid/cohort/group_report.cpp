#include "myoid/cohort/group_report.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/cohort/group_page.h"
#include "myoid/cohort/group_person.h"
#include "myoid/core/counted.h"
#include "myoid/core/error.h"
#include "myoid/core/provenance.h"
#include "myoid/results/group_changes.h"

namespace myoid::cohort {
namespace {

report::Section changes_of(const GroupReportOptions& options) {
  const std::vector<GroupRun> first = group_runs(options.persons),
                              second = group_runs(options.after);
  if (first.size() != second.size())
    throw InvalidInput(
        fmt::format("--group names {} and --after {}: give both sessions of the same persons, in "
                    "the same order",
                    counted(first.size(), "run"), counted(second.size(), "run")));
  std::vector<PersonChange> changes;
  for (std::size_t i = 0; i < first.size(); ++i)
    changes.push_back({first[i].name, page_of(second[i], options.folder),
                       compare_runs(first[i].folder, second[i].folder)});
  return change_section(changes);
}

}  // namespace

report::Report group_report(const GroupReportOptions& options) {
  const std::vector<GroupPerson> persons = read_group_persons(options.persons, options.folder);
  GroupPage beside = group_page(persons);
  report::Report page;
  page.title = "A group";
  page.subtitle = counted(persons.size(), "person");
  page.headline = beside.outliers.empty() ? "No person's numbers lie far from the others'."
                                          : outlier_sentence(beside.outliers);
  if (!options.after.empty()) page.sections.push_back(changes_of(options));
  page.sections.push_back(std::move(beside.persons));
  page.provenance = {{"program", fmt::format("myoid {}", version())}};
  for (const std::filesystem::path& folder : options.persons)
    page.provenance.push_back({"persons", folder.string()});
  for (const std::filesystem::path& folder : options.after)
    page.provenance.push_back({"second sessions", folder.string()});
  return page;
}

}  // namespace myoid::cohort
