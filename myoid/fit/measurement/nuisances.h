#pragma once

#include <string_view>
#include <vector>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Returns the nuisances: unknowns beside the muscles' parameters, each with a prior about its absence. They come
/// first, so that rules of the study or of the user win.
///
/// - `length_activation`, one for all muscles, 0 +- 0.1: fibers of low activation have a longer
/// optimal length (Lloyd & Besier 2003: 15 %);
/// - with `exponents`, `emg_exponent` of every channel, ln p = 0 +- 0.2: EMG is not proportional to activation. Not for
/// channels that stay below half of the maximum in all fitted trials: small efforts do not determine the exponent, and
/// a free exponent lets the strengths grow without limit. `exponents` is for EMG that a maximal contraction scales;
/// - `joint_torque_offset` of every joint and, where its motion is known, `joint_stiffness` and `joint_viscosity`, 0 +-
/// 0.8 %, 0.8 % and 0.16 % (-, per rad, per rad/s) of its muscles' joint capacity, sum of largest |r| times F_max: at
/// the elbow 1 N m, 1 N m/rad and 0.2 N m s/rad, the size of a relaxed joint's own torque (muscle::elbow_passive).
[[nodiscard]] std::vector<ParameterRule> nuisance_rules(const StudyData& data, bool exponents);

inline constexpr double kRow_s = 0.22;  ///< Seconds of movement that count as one row of torque, at least.

/// Returns true if the calibration trials hold at least 1.5 independent rows of torque for each unknown of `data`
/// beside the nuisances: UnseenSpreads::independent_rows of a trial and joint, and at most one per `kRow_s`. From fewer
/// rows a fit gives the nuisances the errors of one movement.
[[nodiscard]] bool tells_nuisances(const StudyData& data, const EstimatorOptions& options);

/// Removes the rules of the nuisances, but for those of one parameter. Rules that the study or the user gives stay, and
/// so do those of `free_speeds`.
void hold_nuisances(StudyData& data, std::string_view but = {});

/// Removes the rules of `free_speeds`.
void hold_speeds(StudyData& data);

}  // namespace myoid::fit
