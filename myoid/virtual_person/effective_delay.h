#pragma once

#include <memory>
#include <vector>

#include "myoid/virtual_person/performance.h"

namespace myoid::twin {

/// The electromechanical delay of a person at level L2 in terms of the fitted model: the lag d by
/// which the torques of its muscles, each with a gain of its own in every trial,
///
///   r_model(q) F(u(t - d), l_model - l_ts, v_model) ,   u: excitation at the electrode,
///
/// come closest to what the muscles made beyond their torque at rest, over the isometric ramps (or,
/// without one, all trials that are fitted: relaxed ones and greatest efforts are not), samples
/// weighted as in a fit: a noise of 0.3 N m, and one of 14 % of the muscle's torque [s]. As the
/// delay between EMG and isometric force that is measured (Cavanagh & Komi 1979, Med Sci Sports
/// 11:159-163), it holds the pure delay, the activation's dynamics, and the time in which the
/// fibers stretch the tendon. Between 0 and 0.25 s, to about a millisecond.
[[nodiscard]] double effective_delay_s(
    const TrueArm& person,
    const VirtualArm& modelled,
    const HillSet& muscles,
    const std::vector<std::unique_ptr<Performance>>& performances);

}  // namespace myoid::twin
