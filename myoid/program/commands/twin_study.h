#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/provenance.h"
#include "myoid/lab/twin/twin_study.h"
#include "myoid/program/steps/call.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Options of studies of many virtual persons, compared with their true parameters.
struct TwinStudyOptions {
  Call call;
  std::string protocol;             ///< Protocol of the recording (.toml).
  std::optional<lab::Level> level;  ///< Empty: the protocol's.
  std::optional<double> offset;     ///< Mean of the persons' distances from the priors, in sd.
  std::vector<std::string> truth;   ///< Keys of [truth] beyond the protocol's: "KEY=VALUE".
  lab::TwinStudyOptions study;      ///< Its seed and progress are the call's.
  std::string out;                  ///< Folder of `write_twin_study`.
};
void visit(TwinStudyOptions& options, study::SettingVisitor& v);

struct TwinStudyResult {
  lab::TwinStudyResult study;  ///< After a stop: the finished persons.
  std::vector<lab::TwinSummary> summaries;
  Provenance provenance;
  std::vector<Remark> remarks;
};

[[nodiscard]] TwinStudyResult twin_study(const TwinStudyOptions& options);

/// Writes persons.csv, summary.csv, predictions.csv and run.json.
void write_twin_study(const TwinStudyResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
