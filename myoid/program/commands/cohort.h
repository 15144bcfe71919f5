#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/fit/measurement/options.h"
#include "myoid/page/write_report.h"
#include "myoid/program/steps/call.h"
#include "myoid/results/cohort/group.h"
#include "myoid/results/cohort/outcome.h"
#include "myoid/results/cohort/person_study.h"
#include "myoid/results/cohort/workflow.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// The step of a cohort that a BIDS App is asked for.
enum class AnalysisLevel { participant, group };
inline constexpr std::string_view kAnalysisLevelNames[] = {"participant", "group"};
constexpr ChoiceNames choice_names(AnalysisLevel) { return kAnalysisLevelNames; }

/// Many persons, each with a study: `run` for each, then all results side by side.
struct CohortOptions {
  Call call;
  std::string manifest;                      ///< Table of the persons, or folder of a BIDS data set.
  std::string study;                         ///< BIDS: the study of every person; empty: code/study.toml.
  std::vector<std::string> persons;          ///< Names or labels; empty: all persons.
  page::Kept kept = page::Kept::page;        ///< Files of each person.
  std::vector<std::string> sessions, tasks;  ///< Trials in use, by these entities of their files' names; empty: all.
  std::vector<std::string> entities;         ///< Further ones, "NAME=VALUE".
  std::string filter_file;                   ///< The same as a file of a BIDS App; empty: none.
  std::filesystem::path work;                ///< Folder of the stages of persons under way; empty: the person's own.
  std::optional<std::size_t> jobs;           ///< Persons computed at the same time; empty: as many as threads.
  std::optional<std::size_t> memory_mb;      ///< Permits a person at a time for every 500.
  bool group = false;                        ///< Only the group, whose persons are computed.
  std::optional<AnalysisLevel> level;        ///< Empty: both.
  std::optional<results::Engine> workflow;   ///< Only the files for this engine.
  std::string out;                           ///< Folder of the results.
  /// Receives the end of each person at once; may be empty. Called by one thread at a time.
  std::function<void(const results::PersonOutcome&)> heard;
};
void visit(CohortOptions& options, study::SettingVisitor& v);

/// Computes the persons and writes each into a folder of its own, `persons/NAME` in `folder`. A
/// person with current results is not computed again. A person whose computation fails is recorded,
/// and the others go on. The files hold no times and are the same to the byte for every number of
/// jobs and threads. Throws InvalidInput for an unreadable manifest and for an unknown person.
std::vector<results::PersonOutcome> write_cohort_persons(const CohortOptions& options,
                                                         const std::filesystem::path& folder);

/// Puts the persons' results in `folder` side by side, and writes tables, page and BIDS derivative.
results::Group write_cohort_group(const CohortOptions& options, const std::filesystem::path& folder);

/// Writes the files with which the engine `workflow` computes the cohort into `workflow` in `folder`;
/// returns the command that starts the engine.
std::string write_cohort_workflow(const CohortOptions& options, const std::filesystem::path& folder);

/// Makes and signs the folder of a cohort with a readable manifest. Throws InvalidInput for a file, for a folder with
/// other content than a cohort's unless `overwrite`, for one that is or holds the BIDS data set, for a file that the
/// group's results would replace, and for the manifest as `write_cohort_persons` does; then no folder is made.
void prepare_cohort_folder(const CohortOptions& options, const std::filesystem::path& folder);

}  // namespace myoid::program
