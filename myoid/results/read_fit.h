#pragma once

#include <filesystem>

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid {

/// Reads method torque of a run's parameters.json as far as predictions need it
/// (identification::TrialPredictions): `values`, `lag`, `solution`, `covariance`, `torque_sd_nm`,
/// `envelope_variance`, `noise`. `data` and `options` are the study's. Throws ReadError for a file
/// that is none or of an earlier version, and InvalidInput if the unknowns of the study are others.
[[nodiscard]] identification::IdentificationResult read_fit(
    const std::filesystem::path& folder,
    const identification::StudyData& data,
    const identification::EstimatorOptions& options);

}  // namespace myoid
