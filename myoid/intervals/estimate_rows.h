#pragma once

#include <vector>

#include "myoid/identification/estimator.h"
#include "myoid/intervals/reported_interval.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Returns the row of one owner of an unknown at `z`, in the solver's scale: names, values and prior, not yet its
/// interval, shrinkage and verdict.
[[nodiscard]] ParameterEstimate row_of(const Unknown& p,
                                       const Unknown::Target& target,
                                       const ParameterMap& map,
                                       double z);

/// Returns the row of V_sh V_shl of a muscle whose slope ratio is the unknown: names and start, no estimate.
[[nodiscard]] ParameterEstimate product_row_of(const MuscleSetup& muscle);

/// Returns the rows of parameters.csv of one solution with their intervals and verdicts: one row
/// for each unknown and owner, and one for each product V_sh V_shl that follows from a slope ratio.
/// `fit` holds the covariance, the values and the distances from the priors of the same solution.
[[nodiscard]] std::vector<ParameterEstimate> estimate_rows(const Estimator& estimator,
                                                           const Estimator::Solution& solution,
                                                           const StudyData& data,
                                                           const Intervals& intervals,
                                                           const IdentificationResult& fit);

}  // namespace myoid::identification
