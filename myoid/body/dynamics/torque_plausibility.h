#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

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

/// Upper bound of the body mass that follows from a model.
inline constexpr double kHeavyBody_kg = 200.0;

/// Finds the moments of inverse dynamics on coordinates that turn, as `inverse_dynamics` names them, that are beyond
/// JointCapacity::greatest_nm of their joint: an error for each, the farthest beyond first. `body_mass_kg` 0: that of
/// the model, between kLightBody_kg and kHeavyBody_kg.
[[nodiscard]] std::vector<Remark> implausible_torques(const body::BodyModel& model,
                                                      const TimeSeries& generalized_forces,
                                                      double body_mass_kg = 0.0);

}  // namespace myoid::body
