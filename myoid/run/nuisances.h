#pragma once

#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/study/study.h"

namespace myoid {

/// Returns the nuisances: unknowns beside the muscles' parameters, each with a prior about its absence. [[parameter]]
/// tables of the study override them. A fit without nuisances would ascribe their effects to the muscles.
///
/// - `length_activation`, one for all muscles, 0 +- 0.1: fibers of low activation have a longer
/// optimal length (Lloyd & Besier 2003: 15 %);
/// - `emg_exponent` of every channel, ln p = 0 +- 0.2: EMG is not proportional to activation. Not
/// if the EMG is given as activation, nor without a maximal contraction, nor for channels that stay
/// below half of it in all fitted trials: small efforts do not determine the exponent, and a free
/// exponent lets the strengths grow without limit;
/// - `joint_stiffness`, `joint_torque_offset` and `joint_viscosity` of every joint with known
/// motion, 0 +- 0.8 %, 0.8 % and 0.16 % (per rad, -, per rad/s) of its muscles' joint capacity, sum
/// of largest |r| times F_max: at the elbow 1 N m/rad, 1 N m and 0.2 N m s/rad, the size of a
/// relaxed joint's own torque (muscle::elbow_passive).
[[nodiscard]] std::vector<identification::ParameterRule> nuisance_rules(const EmgSpec& emg,
                                                                        const identification::StudyData& data);

}  // namespace myoid
