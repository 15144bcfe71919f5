#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/body/dynamics/joint_capacity.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Capacities of the study's coordinates that turn, by name.
using Capacities = std::map<std::string, body::JointCapacity>;
[[nodiscard]] Capacities joint_capacities(const Study& study, const body::BodyModel& model);

/// Finds impossible inputs: an external torque beyond any joint's capacity (N mm?), a held mass beyond the muscles'
/// strength, angles far outside the model's range (sign or convention?), the laboratory's vertical across the trunk, a
/// passive trial without a measured torque. Each finding has numbers and a remedy.
[[nodiscard]] std::vector<Remark> implausible(const Study& study,
                                              const body::BodyModel& model,
                                              const Capacities& capacities,
                                              const TrialSpec& trial,
                                              const TrialInput& input);

/// Activation that a trial with active muscles exceeds at some time.
inline constexpr double kFlatActivation = kLimits.emg.flat_activation;

}  // namespace myoid::study
