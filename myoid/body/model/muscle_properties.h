#pragma once

#include <optional>
#include <string>
#include <variant>

#include "myoid/body/model/functions.h"
#include "myoid/body/model/path_geometry.h"
#include "myoid/muscle/millard.h"

namespace myoid::body {

/// Properties of Millard2012EquilibriumMuscle beside MuscleProperties.
struct MillardCurves {
  muscle::MillardShape shape{.active = {.minimum = 0.1}};
  std::optional<double> passive_stiffness_at_one;  ///< Empty: 2 over the strain from zero force to F_max.
  double tendon_strain_at_one_force = 0.049;
  double fiber_damping = 0.1;
  bool ignore_tendon_compliance = false, ignore_activation_dynamics = false;
};

/// Curves of Schutte1993Muscle and Delp1990Muscle; an empty curve stands for the class's own.
struct SchutteCurves {
  double time_scale_s = 0.1, activation1 = 7.667, activation2 = 1.459854, damping = 0.05;
  std::optional<Function> active_force_length, passive_force_length, tendon_force_length;
  std::optional<Function> force_velocity;
};

/// Properties of DeGrooteFregly2016Muscle beside MuscleProperties.
struct DeGrooteCurves {
  double active_width_scale = 1.0, fiber_damping = 0.0;
  double passive_fiber_strain_at_one_force = 0.6, tendon_strain_at_one_force = 0.049;
  bool ignore_passive_fiber_force = false, ignore_tendon_compliance = false;
  bool ignore_activation_dynamics = false, tendon_dynamics_implicit = false;
};

/// The range of excitation or control.
struct ControlRange {
  double least = 0.0, most = 1.0;
};

/// The numbers of a muscle in the model file, in SI. Fields that a muscle class lacks keep Thelen's defaults.
struct MuscleProperties {
  double max_isometric_force_n = 1000.0;
  double optimal_fiber_length_m = 0.1;
  double tendon_slack_length_m = 0.2;
  double pennation_at_optimal_rad = 0.0;
  double max_contraction_velocity = 10.0;  ///< [optimal fiber lengths / s]
  double active_shape = 0.45;              ///< Thelen KshapeActive.
  double passive_shape = 5.0;              ///< Thelen KshapePassive.
  double max_tendon_strain = 0.04;
  double max_muscle_strain = 0.6;
  double concentric_shape = 0.25;  ///< Thelen Af.
  double eccentric_plateau = 1.4;  ///< Thelen Flen.
  double force_velocity_extrapolation = 0.95;
  double max_pennation_rad = 1.4706289056333368;  ///< acos(0.1)
  double activation_time_s = 0.015;
  double deactivation_time_s = 0.05;
  double minimum_activation = 0.01;
  double default_activation = 0.05;
  double default_fiber_length_m = 0.1;
  ControlRange control{0.01, 1.0};
  std::variant<std::monostate, MillardCurves, SchutteCurves, DeGrooteCurves> curves;
};

struct Muscle {
  std::string name;
  std::string class_name;  ///< "Thelen2003Muscle", ...
  bool applies_force = true;
  MuscleProperties properties;
  MusclePath path;
};

}  // namespace myoid::body
