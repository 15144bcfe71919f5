#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/program/steps/call.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Options of predictions of torque and muscle forces by the fit of a finished run.
struct PredictOptions {
  Call call;
  std::string folder;               ///< Folder of the run, with run.json and parameters.json.
  std::string study;                ///< Study with the trials; empty: the study of the run.
  std::vector<std::string> trials;  ///< Names; empty: all trials that took no part in the fit.
  std::string out;                  ///< Folder of `write_predict`.
};
void visit(PredictOptions& options, study::SettingVisitor& v);

struct PredictResult {
  std::vector<fit::TrialFit> trials;  ///< One for each trial and joint.
  std::vector<std::string> muscles;
  Provenance provenance;
  std::vector<Remark> remarks;
};

/// Computes motion, torque and activation of the study as the run did, and predicts the trials by
/// fit::TrialPredictions. A trial of another study is scaled by that study's own maximal
/// contractions. Throws ReadError for a folder without a run and for recordings that differ from
/// the run's. Throws InvalidInput for unknown trials and for another study with other muscles.
[[nodiscard]] PredictResult predict(const PredictOptions& options);

/// Writes predictions.csv and predictions.json, and into a folder of each trial
/// predicted_torque_<joint>.sto and predicted_forces.sto.
void write_predict(const PredictResult& result, const std::filesystem::path& folder);

/// Returns the text of predictions.json.
[[nodiscard]] std::string predict_json(const PredictResult& result);

}  // namespace myoid::program
