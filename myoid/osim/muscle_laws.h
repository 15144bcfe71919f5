#pragma once

#include "myoid/model/body_model.h"
#include "myoid/muscle/literature.h"
#include "myoid/muscle/millard.h"
#include "myoid/muscle/musculotendon_parameters.h"

namespace myoid::model {

/// The source paper's parameters of a model's muscle: l_sh = l0 sqrt(gamma), V_sh = A_f, V_ml =
/// F_len, v_max = (fiber lengths per second) l0, and P such that the eccentric slope at rest is
/// `slope_ratio` times the concentric one (Thelen's own is 2). Pennation is left out.
[[nodiscard]] muscle::HillParameters<double> hill_parameters(
    const MuscleProperties& properties, double slope_ratio = muscle::kLiteratureSlopeRatio);

/// Switches of a muscle's class that leave a state out.
struct MuscleStates {
  bool rigid_tendon = false;
  bool no_activation_dynamics = false;
};
[[nodiscard]] MuscleStates muscle_states(const MuscleProperties& properties);

/// The laws of the muscle's class: Millard's, De Groote's, or Thelen's (2003) for every other one.
[[nodiscard]] muscle::MusculotendonLaws class_laws(const MuscleProperties& properties,
                                                   muscle::TendonMode mode);

/// The numbers of a muscle for these laws: those of the model file where the laws are the class's
/// own, else the published ones. Thelen's class has no damping. Where the class has no exponential
/// passive force, strain and shape are those of the exponential with the slope of its curve at
/// F_max. Not validated.
[[nodiscard]] muscle::MusculotendonParameters<double> musculotendon_parameters(
    const MuscleProperties& properties, const muscle::MusculotendonLaws& laws);

/// The shape of Millard's curves. Where the file leaves a number open, the class takes the
/// published curve's; without Millard's class all are published.
[[nodiscard]] muscle::MillardShape millard_shape(const MuscleProperties& properties);

}  // namespace myoid::model
