#pragma once

#include <Eigen/Core>

#include "myoid/identification/estimator.h"
#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// Returns the standard deviation [m] of a muscle's held tendon slack length: 0 if measured (`MuscleSetup::fixed`, or a
/// rule of the study that states a value or holds it), the rule's `prior_sd` if it gives one, else that of the muscle's
/// prior (`MuscleSetup::priors`); 0 without a prior.
[[nodiscard]] double held_slack_sd_m(const StudyData& data, std::size_t muscle);

/// Returns the shift of the estimates by errors of held tendon slack lengths. With a rigid tendon only l0 + l_ts acts,
/// so an error of l_ts moves l0 by the same amount. Column k is the shift, p x muscles in the solver's scale, if the
/// slack length of muscle k is a standard deviation s_k longer,
///
///   dz = -(J W J' + P)^-1 J W j_k s_k,      j_k = dT^/dl_ts,k,  W = nu / s^2,  P the priors',
///
/// and 0 for parameters on a bound and for slack lengths that are unknowns or measured. Without
/// priors (`EstimatorOptions::priors`) tendons have no prior, and all shifts are 0.
[[nodiscard]] Eigen::MatrixXd held_tendon_shift(const Estimator& estimator,
                                                const Estimator::Solution& solution,
                                                const StudyData& data);

}  // namespace myoid::identification
