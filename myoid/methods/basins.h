#pragma once

#include "myoid/core/progress.h"
#include "myoid/identification/estimator.h"
#include "myoid/intervals/result.h"
#include "myoid/math/multistart.h"
#include "myoid/methods/start_box.h"

namespace myoid::identification {

/// Searches from the given start and Sobol points of the box, in parallel. Two ends are one basin if no unknown differs
/// by more than 0.04 spreads. `plain_samples` is the number of residuals of an unweighted cost, whose variance then
/// scales the cost to chi-square; 0: the cost is weighted. Throws Interrupted.
[[nodiscard]] BasinTable find_basins(const math::LocalSearch& search,
                                     const StartBox& box,
                                     int starts,
                                     Eigen::Index plain_samples = 0,
                                     const Progress& progress = {});

/// Returns the minima of the estimator's own search, with these weights.
[[nodiscard]] BasinTable find_basins(const Estimator& estimator, const Weighting& weighting, int starts);

/// Calls `report_other_minima` for a least-squares fit of method torque with these options: with
/// the fit's table if several starts were asked for, otherwise with searches from 24 points
/// at the weights of its minimum. The posterior's intervals are over all of its modes already.
void look_around(const StudyData& data, EstimatorOptions options, IdentificationResult& result);

/// Warns of numbers that other minima of the table put outside their reported intervals. Such minima are lower than
/// `cost` or at most a chi-square of 4 above it. Identified numbers among them become weak.
void report_other_minima(const BasinTable& table,
                         const std::vector<Unknown>& free,
                         double cost,
                         IdentificationResult& result);

/// Returns the minima of the source paper's plain Gauss-Newton steps on one muscle in one branch.
/// Empty if every number is held or the case is not fitted (PaperCase::obstacle).
[[nodiscard]] BasinTable find_paper_basins(const StudyData& data, std::size_t muscle, bool shortening, int starts);

}  // namespace myoid::identification
