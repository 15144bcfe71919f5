#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/intervals/verdicts.h"
#include "myoid/fit/posterior/voluntary_states.h"

namespace myoid::fit {

/// Greatest voluntary torques: rows for IdentificationResult::estimates, and curves over the angle.
struct VoluntaryTorques {
  std::vector<ParameterEstimate> estimates;
  std::vector<VoluntaryCurve> curves;
};

/// Returns each muscle's greatest voluntary torque at each joint that it crosses, the angle at which it is greatest,
/// and its greatest power at the speeds kVoluntarySpeeds_degps that the recording reaches; then the same of all muscles
/// with positive moment arms of a joint together, and of all with negative ones. The torque is that of the activation
/// of the maximal contraction, or where none was recorded (EstimatorOptions::from_mvc) of the channel's largest
/// envelope; steady, at joint angle q [rad] and speed q' [rad/s],
///
///   T(q, q') = r(q) F(z; a, l(q), -r(q) q') + S(q, q') W x,   x | z, y ~ N(x^(z), G^-1)   [N m]
///
/// with lengths and moment arms of the recorded angles (postures.h). The size of a moment arm, the effort of the
/// maximal contraction and its EMG multiply the fitted torque by the same number, so they cancel where x is given the
/// torque y. The scale of the torque stays: a muscle's torque is the measured one over this scale. Noise, drift,
/// cross-talk and the joint's own torque are no part of T. To the first order T is normal over the angles,
///
///   T - T^ = (dT/dz + S W dx^/dz) (z - z^) + S W (x - x^(z)),
///
/// only its size at the peak is taken to be log-normal, as F_max is. Maxima and their angles are those of draws of T.
[[nodiscard]] VoluntaryTorques voluntary_torques(const StudyData& data,
                                                 const EstimatorOptions& options,
                                                 const LinearReading& of_person,
                                                 const LinearReading& given,
                                                 const FitFacts& fit);

/// Speeds of a joint at which power is reported, as of isokinetic dynamometers [deg/s].
inline constexpr int kVoluntarySpeeds_degps[] = {60, 120, 180};

}  // namespace myoid::fit
