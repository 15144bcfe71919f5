#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"
#include "myoid/opensim/projects/project.h"

namespace myoid::opensim {

/// Returns the neural activation of CEINMS from an excitation that is settled before its first sample:
///   u_k = (1 + c1) (1 + c2) e_k - (c1 + c2) u_k-1 - c1 c2 u_k-2
/// With c = -exp(-T / tau) at the sampling interval T it is the answer of two lags with the time constants tau.
[[nodiscard]] Eigen::VectorXd recursive_activation(const Eigen::VectorXd& excitation, double c1, double c2);

/// Returns (exp(A u) - 1) / (exp(A) - 1); u where A is 0.
[[nodiscard]] double exponential_shape(double u, double shape_factor);

/// Muscles over time by a project's own law; channels are the muscles.
struct LawForces {
  TimeSeries activation;  ///< On the clock of the lengths.
  TimeSeries force;       ///< Along the tendon [N].
};

/// Returns what the project's files lack of a law; empty: the law is there. Other programs than CEINMS
/// and CEINMS-RT keep their curves to themselves.
[[nodiscard]] std::string missing_of_law(const Project& project);

/// Computes the forces of muscles by the law of CEINMS, with the project's curves and its calibrated numbers:
///
///   u_k = (1 + c1)(1 + c2) e_k - (c1 + c2) u_(k-1) - c1 c2 u_(k-2),   at the samples of the EMG
///   a   = s (exp(A u) - 1) / (exp(A) - 1),                            at t minus the delay
///   F   = F_max S (f_a(l / (l0 (1 + p (1 - a)))) f_v(v) a + f_p(l / l0) + d v) cos(phi),  sin(phi) = l0 sin(phi0) / l
///
/// e is the weighted mean of the muscle's channels, within 0 and 1 in CEINMS; a muscle without EMG is passive. v is the
/// fiber's speed over the maximal one, by backward differences, within -1 and 1. f_a, f_v and f_p are natural cubic
/// splines through the tables, constant outside them. A stiff tendon gives l^2 = (h sin(phi0))^2 + (l_mt - l_ts)^2, h
/// the optimal length (CEINMS-RT: at the activation). An elastic one balances the force by its curve of force over
/// strain. CEINMS-RT allows no negative force. Sources: Lloyd & Besier 2003 (J. Biomech. 36, 765); Pizzolato et al.
/// 2015 (J. Biomech. 48, 3929); the published programs.
///
/// `emg` has the channels on a clock of its own; `lengths` [m] has the muscles. Throws InvalidInput for a channel or a
/// muscle that is missing, and if `missing_of_law` is not empty.
[[nodiscard]] LawForces forces_by_law(const Project& project,
                                      const TimeSeries& emg,
                                      const TimeSeries& lengths,
                                      const std::vector<std::string>& muscles);

}  // namespace myoid::opensim
