#pragma once

#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/study/study.h"

namespace myoid {

/// Returns the nuisances: unknowns beside the muscles' parameters, each with a prior about its
/// absence.
/// [[parameter]] tables of the study override them. A fit without them would blame the muscles.
///
/// - `length_activation`, one for all muscles, 0 +- 0.1: fibers that are little active are at their
///   best when longer (Lloyd & Besier 2003: 15 %);
/// - `emg_exponent` of every channel, ln p = 0 +- 0.2: EMG is not proportional to activation. Not
///   where the EMG is given as activation; nor without a maximal contraction; nor for channels
///   that stay below half of it in all that is fitted: small efforts do not say how EMG rises, and
///   an exponent that nothing bounds makes the strengths run away;
/// - of every joint whose motion is known `joint_stiffness`, `joint_torque_offset` and
///   `joint_viscosity`, 0 +- 0.8 %, 0.8 % and 0.16 % (per rad, -, per rad/s) of what its muscles
///   could exert together, sum of largest |r| times F_max: at the elbow 1 N m/rad, 1 N m and 0.2 N
///   m s/rad, the size of a relaxed joint's own torque (muscle::elbow_passive).
[[nodiscard]] std::vector<identification::ParameterRule> nuisance_rules(
    const EmgSpec& emg, const identification::StudyData& data);

}  // namespace myoid
