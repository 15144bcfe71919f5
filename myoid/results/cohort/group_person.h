#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/page/report.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/study/run_identity.h"

namespace myoid::results {

/// A parameter of one person, from a row of parameters.csv, in the unit in which people say it (`page::plain_unit`).
struct GroupNumber {
  std::string parameter;  ///< With its case, where that is not "both".
  std::string muscle;     ///< Muscle, EMG channel, joint or "subject".
  std::string unit;       ///< Empty: dimensionless.
  fit::Verdict verdict = fit::Verdict::not_identifiable;
  double estimate = 0.0;
  std::optional<double> low, high;                     ///< 95 % interval of the person.
  std::optional<double> given, given_low, given_high;  ///< The same given geometry and sensors; may be empty.
  std::optional<double> truth;                         ///< In a virtual recording.
};

/// A number that says how good a recording and its fit are.
struct Quality {
  std::string name, unit;
  double value = 0.0;
  std::optional<page::GateStatus> status = {};  ///< Of a number that is judged.
};

/// One person of a group.
struct GroupPerson {
  std::string name;
  std::string page;  ///< The person's report, relative to the group's; empty: none.
  std::vector<GroupNumber> numbers;
  std::vector<Quality> quality;
  study::RunIdentity identity = {};       ///< Of a run; unknown for a virtual person.
  std::vector<std::string> changed = {};  ///< Sentences on files of a run that were changed since it wrote them.
};

/// Returns the numbers of method torque, or of the first method where torque was not asked for.
/// Numbers of other methods and rows without an estimate are left out.
[[nodiscard]] std::vector<GroupNumber> group_numbers(const recording::CsvTable& parameters);

/// Returns the quality of the run in this folder, each number as far as the run has it: questions that were not
/// answered well (report.json), R2 of the fitted samples and, as medians over trials, R2 and torque error of the trials
/// left out (parameters.json), marker error (run.json). Throws ReadError for a damaged file.
[[nodiscard]] std::vector<Quality> run_quality(const std::filesystem::path& folder);

/// A run of a group.
struct GroupRun {
  std::string name;  ///< The part of the folder's path in which the runs differ.
  std::filesystem::path folder;
};

/// Finds the runs in these folders: each is the folder of a run, or holds folders of runs at any
/// depth down to three. Throws ReadError for a folder without a run.
[[nodiscard]] std::vector<GroupRun> group_runs(const std::vector<std::filesystem::path>& folders);

/// Returns a sentence on each file that a group reads of a run and that was changed since the run wrote it.
[[nodiscard]] std::vector<std::string> changed_files(const GroupRun& run);

/// Returns the report of a run, relative to this folder; empty if the run has none.
[[nodiscard]] std::string page_of(const GroupRun& run, const std::filesystem::path& page_folder);

/// Reads the persons of a group: of every run, and of the folders of twin-studies (persons.csv with
/// seeds), whose persons bring their truth and no reports. Throws as `group_runs`.
[[nodiscard]] std::vector<GroupPerson> read_group_persons(const std::vector<std::filesystem::path>& folders,
                                                          const std::filesystem::path& page_folder);

}  // namespace myoid::results
