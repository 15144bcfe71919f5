#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/methods/cross_validation.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/run/resting_torque.h"
#include "myoid/run/study_result.h"
#include "myoid/study/phases/phases.h"

namespace myoid::results {

/// Returns the table of all estimates, one row per muscle x parameter x method x case, with the columns of
/// docs/guide/run.md. Each number is the shortest text that reads back the same; a missing number is an empty cell.
[[nodiscard]] std::string parameters_csv(const std::vector<fit::IdentificationResult>& methods);

/// Returns the parameters that predict each fold, one row per fold and parameter, from fits without
/// that fold. With the held values (muscles.csv or the model) and the lag they allow a new
/// computation of the left-out R2 (docs/theory/identification.md).
[[nodiscard]] std::string fold_parameters_csv(const std::vector<fit::Fold>& folds);

/// Returns the draws from the posterior of a method, one row each: `weight`, and every unknown in SI.
[[nodiscard]] std::string posterior_csv(const fit::IdentificationResult& method);

/// The content of parameters.json beyond the estimates and the folds.
struct ParameterContext {
  std::vector<study::TrialPhases> phases;
  std::vector<run::RestingJoint> resting;
  std::string left_out = "trial";  ///< Kind of a fold, if there are folds: trial, condition, block.
  std::string starting_values;     ///< Starting values from the literature, as a sentence; empty: none.
};

/// Returns all estimates with covariance, diagnostics, folds, phases and resting torques.
[[nodiscard]] std::string parameters_json(const std::vector<fit::IdentificationResult>& methods,
                                          const std::vector<fit::Fold>& folds,
                                          const Provenance& provenance,
                                          const ParameterContext& context = {});

/// Writes parameters.json, parameters.csv and, if there are any, fold_parameters.csv, voluntary_torque.csv,
/// posterior.csv.
void write_parameter_files(const std::vector<fit::IdentificationResult>& methods,
                           const std::vector<fit::Fold>& folds,
                           const Provenance& provenance,
                           const ParameterContext& context,
                           const std::filesystem::path& folder);

/// Returns the context of a finished study; `result` must outlive it.
[[nodiscard]] ParameterContext parameter_context(const run::StudyResult& result);

}  // namespace myoid::results
