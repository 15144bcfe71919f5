#pragma once

#include <filesystem>

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid {

/// Reads the members of method torque in a run's parameters.json that predictions need
/// (identification::TrialPredictions): `values`, `lag`, `solution`, `covariance`, `torque_sd_nm`,
/// `envelope_variance`, `noise`. `data` and `options` are the study's. Throws ReadError for another
/// file or an earlier version, and InvalidInput if the study has other unknowns.
[[nodiscard]] identification::IdentificationResult read_fit(const std::filesystem::path& folder,
                                                            const identification::StudyData& data,
                                                            const identification::EstimatorOptions& options);

}  // namespace myoid
