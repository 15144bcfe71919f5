#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/parameters.h"
#include "myoid/identification/study_data.h"
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

/// Gives the last `count` estimates, which are one unknown of several owners, the worst of their
/// verdicts with its reason. A number of one owner stays unchanged.
void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count);

}  // namespace myoid::identification
