#pragma once

#include <filesystem>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::program {

/// Reads the members of method torque in a run's parameters.json that predictions need
/// (fit::TrialPredictions): `values`, `lag`, `solution`, `covariance`, `torque_sd_nm`,
/// `envelope_variance`, `noise`. `data` and `options` are the study's. Throws ReadError for another
/// file or an earlier version, and InvalidInput if the study has other unknowns.
[[nodiscard]] fit::IdentificationResult read_fit(const std::filesystem::path& folder,
                                                 const fit::StudyData& data,
                                                 const fit::EstimatorOptions& options);

}  // namespace myoid::program
