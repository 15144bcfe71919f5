#pragma once

#include <Eigen/Core>

#include "myoid/identification/estimator.h"
#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// Standard deviation [m] of a muscle's tendon slack length that is held: 0 where it is measured
/// (`MuscleSetup::fixed`, or a rule of the study that states a value or holds it), the rule's
/// `prior_sd` where it gives one, else that of its prior (`MuscleSetup::priors`); 0 without one.
[[nodiscard]] double held_slack_sd_m(const StudyData& data, std::size_t muscle);

/// Estimates rest on tendon slack lengths that are held. With a rigid tendon only l0 + l_ts acts,
/// so that an error of l_ts goes into l0 whole. Column k is the shift of the estimates, p x muscles
/// in the solver's scale, where the slack length of muscle k is a standard deviation s_k longer,
///
///   dz = -(J W J' + P)^-1 J W j_k s_k,      j_k = dT^/dl_ts,k,  W = nu / s^2,  P the priors',
///
/// and 0 for parameters on a bound and for slack lengths that are unknowns or measured. Without
/// priors (`EstimatorOptions::priors`) nothing is believed of tendons, and all is 0.
[[nodiscard]] Eigen::MatrixXd held_tendon_shift(const Estimator& estimator,
                                                const Estimator::Solution& solution,
                                                const StudyData& data);

}  // namespace myoid::identification
