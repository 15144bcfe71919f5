#pragma once

#include <vector>

#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// Returns these samples of a trial, in rising order, as a trial of their own with the whole EMG.
[[nodiscard]] TrialData at_rows(const TrialData& trial, const std::vector<Eigen::Index>& rows);

}  // namespace myoid::identification
