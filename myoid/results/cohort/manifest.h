#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace myoid::results {

/// One person of a cohort: one row of the manifest, one job.
struct Person {
  std::string name;             ///< Any text.
  std::string id;               ///< Made from the name: the folder of results, and the person's word in workflows.
  std::string label;            ///< BIDS label: made from the name without "sub-".
  std::filesystem::path study;  ///< Study file, or template of one (`person_study`).
  /// The manifest's further columns in their order: name and cell; a cell "n/a" is empty.
  std::vector<std::pair<std::string, std::string>> facts;
};

struct Manifest {
  std::filesystem::path file;  ///< CSV file, or folder of the BIDS data set.
  std::vector<Person> persons;

  /// Names of the further columns, which all persons share.
  [[nodiscard]] std::vector<std::string> fact_names() const;
};

/// Reads the persons of a cohort.
///
/// A file is a table with the columns `name` and `study` (a path relative to the table) and any
/// further columns. A folder is a BIDS data set: its persons are the folders `sub-*` in
/// alphabetical order, their further columns are those of participants.tsv if that file exists, and
/// the study of every person is `study`, or `code/study.toml` of the data set if `study` is empty.
///
/// Throws ReadError with the line: no person, no column `name` or `study`, an empty cell there, a text that cannot be a
/// name (`name_refusal`), two persons with one name.
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& file, const std::filesystem::path& study = {});

/// Returns the persons with these names, ids or BIDS labels ("01", "sub-01"), in the order of the
/// manifest; all persons if there are no names. Throws InvalidInput for a name that no person has.
[[nodiscard]] std::vector<const Person*> chosen_persons(const Manifest& manifest,
                                                        const std::vector<std::string>& names);

/// Returns the folder of a person's results in the folder of the cohort.
[[nodiscard]] std::filesystem::path person_folder(const std::filesystem::path& cohort, const Person& person);

/// Folder of all persons' results in the folder of a cohort.
inline constexpr std::string_view kPersonsFolder = "persons";

}  // namespace myoid::results
