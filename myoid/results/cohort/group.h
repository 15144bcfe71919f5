#pragma once

#include <filesystem>
#include <vector>

#include "myoid/page/report.h"
#include "myoid/results/cohort/manifest.h"
#include "myoid/results/cohort/outcome.h"

namespace myoid::results {

/// The results of all persons side by side.
struct Group {
  std::vector<PersonOutcome> outcomes;  ///< In the order of the manifest.
  page::Table persons;                  ///< Person, further columns, study, outcome, message.
  page::Table parameters;               ///< Person, further columns, and the columns of parameters.csv.
  page::Report page;
};

/// Reads outcome.json and parameters.csv of every person in the folder of the cohort. Persons who
/// failed or are not computed yet stand in `persons` and on the page, not in `parameters`.
///
/// The page is that of group_page.h, with the manifest's columns.
[[nodiscard]] Group read_group(const Manifest& manifest, const std::filesystem::path& folder);

/// Writes persons.csv, cohort.csv, the page with its figures and tables, and a BIDS derivative:
/// dataset_description.json, participants.tsv, sub-LABEL of every person with results, and a
/// .bidsignore for the other files. Removes its earlier results first, so that a person without results has no
/// derivative; files of other programs stay as they are.
void write_group(const Group& group, const Manifest& manifest, const std::filesystem::path& folder);

}  // namespace myoid::results
