#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"
#include "myoid/dynamics/joint_capacity.h"
#include "myoid/intake/limits.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Of each of the study's coordinates that turns.
using Capacities = std::map<std::string, dynamics::JointCapacity>;
[[nodiscard]] Capacities joint_capacities(const Study& study, const model::BodyModel& model);

/// What no person can have done or held: an external torque that no joint makes (N mm?), a held
/// mass that no muscle holds, angles far outside the model's range (sign or convention?), the
/// laboratory's vertical lying across the trunk. Each with numbers and remedy.
[[nodiscard]] std::vector<Remark> implausible(const Study& study,
                                              const model::BodyModel& model,
                                              const Capacities& capacities,
                                              const TrialSpec& trial,
                                              const TrialInput& input);

/// The activation that a trial must exceed somewhere to count as one with active muscles.
inline constexpr double kFlatActivation = kLimits.flat_activation;

/// The share of samples by whose size a torque is judged: what one in a hundred exceeds, so that a
/// spike does not.
[[nodiscard]] double usual_peak(const Eigen::Ref<const Eigen::VectorXd>& values);

/// "16194 N m at elbow_flexion is more than ...; N mm?" if it is, else empty.
[[nodiscard]] std::string too_much_torque(const std::string& coordinate,
                                          double peak_nm,
                                          double greatest_nm,
                                          const std::string& what_it_is);

}  // namespace myoid
