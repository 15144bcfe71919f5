#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Returns the row of one owner of an unknown at `z`, in the solver's scale: names, values and prior, not yet its
/// interval, shrinkage and verdict.
[[nodiscard]] ParameterEstimate row_of(const Unknown& p,
                                       const Unknown::Target& target,
                                       const ParameterMap& map,
                                       double z);

/// Returns the row of V_sh V_shl of a muscle whose slope ratio is the unknown: names and start, no estimate.
[[nodiscard]] ParameterEstimate product_row_of(const MuscleSetup& muscle);

/// Returns of every muscle the range of its musculotendon lengths in the calibration trials while it is active (above 2
/// % of the greatest EMG), without a tenth of a second at either end [m]. Activation acts `delay_s` after the EMG.
[[nodiscard]] std::vector<double> active_length_spans_m(const StudyData& data, double delay_s);

/// Returns |z - prior mean| / prior sd, in the solver's scale.
[[nodiscard]] double distance_from_prior(const Unknown& parameter, double z);

/// Returns the |N(0, 1)| that is as improbable as a sum of `count` squares of at least this size
/// (chi-square): several deviations as one number of standard deviations.
[[nodiscard]] double equivalent_deviations(double sum_of_squares, int count);

/// Returns one distance for each muscle that has free parameters with priors, at the numbers `z`.
[[nodiscard]] std::vector<PriorDistance> prior_distances(const std::vector<Unknown>& free,
                                                         const Eigen::VectorXd& z,
                                                         const StudyData& data);

/// Adds a line for each muscle whose distance exceeds VerdictRules::prior_conflict.
void add_distances_to(std::vector<Remark>& warnings, const std::vector<PriorDistance>& distances);

}  // namespace myoid::fit
