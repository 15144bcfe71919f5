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

/// Capacities of the study's coordinates that turn, by name.
using Capacities = std::map<std::string, dynamics::JointCapacity>;
[[nodiscard]] Capacities joint_capacities(const Study& study, const model::BodyModel& model);

/// Finds impossible inputs: an external torque beyond any joint's capacity (N mm?), a held mass beyond the muscles'
/// strength, angles far outside the model's range (sign or convention?), the laboratory's vertical across the trunk, a
/// passive trial without a measured torque. Each finding has numbers and a remedy.
[[nodiscard]] std::vector<Remark> implausible(const Study& study,
                                              const model::BodyModel& model,
                                              const Capacities& capacities,
                                              const TrialSpec& trial,
                                              const TrialInput& input);

/// Activation that a trial with active muscles exceeds at some time.
inline constexpr double kFlatActivation = kLimits.flat_activation;

/// Returns the size that one sample in a hundred exceeds, so that a single spike does not decide.
[[nodiscard]] double usual_peak(const Eigen::Ref<const Eigen::VectorXd>& values);

/// The origin of a torque: a file, whose unit may be wrong, or inverse dynamics.
enum class TorqueSource { file, computed };

/// Returns "16194 N m at elbow_flexion is more than ...; N mm?" for too large a torque, else an empty text.
[[nodiscard]] std::string too_much_torque(const std::string& coordinate,
                                          double peak_nm,
                                          double greatest_nm,
                                          const std::string& what_it_is,
                                          TorqueSource source = TorqueSource::file);

}  // namespace myoid
