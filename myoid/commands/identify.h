#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/commands/identify_options.h"
#include "myoid/core/provenance.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"
#include "myoid/methods/cross_validation.h"
#include "myoid/methods/solver_contest.h"
#include "myoid/results/parameter_files.h"
#include "myoid/study/study.h"

namespace myoid::commands {

struct IdentifyResult {
  identification::IdentificationResult fit;
  identification::StudyData data;  ///< The fitted samples.
  std::vector<identification::Fold> folds;
  std::string why_no_folds;  ///< Empty if there are folds, or none were asked for.
  std::vector<identification::NamedContest> contests;
  Study study;                     ///< The same files and choices for `run` (identify_study.h).
  bool speed_may_be_free = false;  ///< muscles.csv leaves open whether v_max is known.
  ParameterContext told;
  Provenance provenance;
  std::vector<Remark> remarks;
};

/// Reads the files, fits by the method, predicts the left-out parts, and compares solvers if the
/// options ask for this. Throws InvalidInput for options that the method or the files cannot meet.
[[nodiscard]] IdentifyResult identify(const IdentifyOptions& options);

/// Returns the text of parameters.json.
[[nodiscard]] std::string identify_json(const IdentifyResult& result);

/// Initial parts of the names of the files that `write_identify` writes.
inline const std::vector<std::string_view> kIdentifyFiles{"parameters.",  "fold_parameters.", "posterior.",
                                                          "predictions.", "solvers.",         "study."};

/// Writes parameters.json, parameters.csv and, if there are such results, fold_parameters.csv,
/// posterior.csv, solvers.csv, predictions.csv and the folders of predicted trials. study.toml is the study for `run`.
void write_identify(const IdentifyResult& result, const std::filesystem::path& folder);

}  // namespace myoid::commands
