#pragma once

#include <memory>
#include <vector>

#include "myoid/lab/virtual_person/performance.h"

namespace myoid::lab {

/// Returns the electromechanical delay of a person at level L2 for the fitted model: the lag d [s]
/// at which the torques of its muscles, each with its own gain in every trial,
///
///   r_model(q) F(u(t - d), l_model - l_ts, v_model) ,   u: excitation at the electrode,
///
/// come closest to the muscles' torque beyond their torque at rest. The comparison covers the isometric ramps (without
/// one, all fitted trials, which exclude relaxed ones and greatest efforts), with samples weighted as in a fit: a noise
/// of 0.3 N m, and one of 14 % of the muscle's torque. Like the measured delay between EMG and isometric force
/// (Cavanagh & Komi 1979, Med Sci Sports 11:159-163), d includes the pure delay, the activation's dynamics, and the
/// time in which the fibers stretch the tendon. Between 0 and 0.25 s, to about a millisecond.
[[nodiscard]] double effective_delay_s(const TrueArm& person,
                                       const VirtualArm& modelled,
                                       const HillSet& muscles,
                                       const std::vector<std::unique_ptr<Performance>>& performances);

}  // namespace myoid::lab
