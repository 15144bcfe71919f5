#pragma once

#include "myoid/body/model/body_model.h"
#include "myoid/muscle/literature.h"
#include "myoid/muscle/millard.h"
#include "myoid/muscle/musculotendon_parameters.h"

namespace myoid::body {

/// Returns the source paper's parameters of a model's muscle: l_sh = l0 sqrt(gamma), V_sh = A_f,
/// V_ml = F_len, v_max = (fiber lengths per second) l0, and P such that the eccentric slope at rest
/// is `slope_ratio` times the concentric one (Thelen's own is 2). Pennation is left out.
[[nodiscard]] muscle::HillParameters<double> hill_parameters(const MuscleProperties& properties,
                                                             double slope_ratio = muscle::kLiteratureSlopeRatio);

/// Switches of a muscle's class that leave a state out.
struct MuscleStates {
  bool rigid_tendon = false;
  bool no_activation_dynamics = false;
};
[[nodiscard]] MuscleStates muscle_states(const MuscleProperties& properties);

/// Returns the laws of the muscle's class: Millard's, De Groote's, or Thelen's (2003) for every other one.
[[nodiscard]] muscle::MusculotendonLaws class_laws(const MuscleProperties& properties, muscle::TendonMode mode);

/// Returns the numbers of a muscle for these laws: the model file's if the laws are the class's own, else the published
/// ones. Thelen's class has no damping. If the class has no exponential passive force, strain and shape describe the
/// exponential with the slope of its curve at F_max. Not validated.
[[nodiscard]] muscle::MusculotendonParameters<double> musculotendon_parameters(const MuscleProperties& properties,
                                                                               const muscle::MusculotendonLaws& laws);

/// Returns the shape of Millard's curves. A number that the file leaves open comes from the
/// published curve; without Millard's class all do.
[[nodiscard]] muscle::MillardShape millard_shape(const MuscleProperties& properties);

}  // namespace myoid::body
