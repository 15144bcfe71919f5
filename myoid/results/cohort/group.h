#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/page/report.h"
#include "myoid/results/cohort/manifest.h"
#include "myoid/results/cohort/outcome.h"

namespace myoid::results {

/// The results of all persons side by side.
struct Group {
  std::vector<PersonOutcome> outcomes;  ///< In the order of the manifest.
  page::Table persons;                  ///< Person, further columns, study, outcome, message.
  std::vector<std::string> columns;     ///< Of cohort.csv: person, further columns, every column of parameters.csv.
  page::Report page;
};

/// Reads outcome.json and parameters.csv of every person in the folder of the cohort. Persons who
/// failed or are not computed yet stand in `persons` and on the page, not in cohort.csv.
///
/// The page is that of group_page.h, with the manifest's columns.
[[nodiscard]] Group read_group(const Manifest& manifest, const std::filesystem::path& folder);

/// Writes persons.csv, cohort.csv (person by person, whose parameters.csv it reads again), the page with its figures
/// and tables, and a BIDS derivative: dataset_description.json, participants.tsv, sub-LABEL of every person with
/// results, and a .bidsignore for the other files. Removes its earlier results first, so that a person without results
/// has no derivative; files of other programs stay as they are.
void write_group(const Group& group, const Manifest& manifest, const std::filesystem::path& folder);

}  // namespace myoid::results
