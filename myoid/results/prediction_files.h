#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/name_ids.h"

namespace myoid::results {

/// The ends of a 95 % band, mean -+ 1.96 standard deviations.
struct Band {
  Eigen::VectorXd low, high;
};
/// Returns the band; empty without a standard deviation.
[[nodiscard]] Band prediction_band(const Eigen::VectorXd& mean, const Eigen::VectorXd& sd);

/// Returns a sentence on the reading of the bands: what they hold, and what they take for exact.
[[nodiscard]] std::string band_sentence(const std::vector<fit::TrialFit>& predictions);

/// Writes predicted_torque_<joint>.sto (`<joint>_measured`, `_predicted`, and with a band `_low`, `_high` [N m]) and
/// predicted_forces.sto (each muscle, and its `_low` and `_high`, not below 0 [N]) of one trial, and by the posterior
/// drive.sto. `joints` holds the id of each joint for the names of files.
void write_prediction(const fit::TrialFit& prediction,
                      const std::vector<std::string>& muscles,
                      const NameIds& joints,
                      const std::filesystem::path& folder,
                      const std::vector<std::string>& comments);

/// Returns the folder of each predicted trial.
[[nodiscard]] NameIds prediction_folders(const std::vector<fit::TrialFit>& predictions);

/// Writes each trial's `write_prediction` into the trial's folder, and predictions.csv. Each .sto says band_sentence.
void write_predictions(const std::vector<fit::TrialFit>& predictions,
                       const std::vector<std::string>& muscles,
                       const Provenance& provenance,
                       const std::filesystem::path& folder);

/// Writes the same for the trials that took no part in the fit; nothing if there are none.
void write_held_back(const fit::IdentificationResult& fit,
                     const fit::StudyData& data,
                     const Provenance& provenance,
                     const std::filesystem::path& folder);

/// Returns the table predictions.csv, a row for each trial and joint: trial, joint, fitted (whether
/// the trial took part in the fit), samples, rmse_nm, nrmse_range, r2, band_rmse_nm and band_r2
/// (both torques below the cut-off of the fit), covered (share of the samples within the band).
[[nodiscard]] std::string predictions_csv(const std::vector<fit::TrialFit>& predictions);

}  // namespace myoid::results
