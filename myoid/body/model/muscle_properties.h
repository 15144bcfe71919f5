#pragma once

#include <optional>
#include <string>
#include <variant>

#include "myoid/body/model/functions.h"
#include "myoid/body/model/path_geometry.h"

namespace myoid::body {

/// Corner points and slopes of Millard's curves (force by normalized length, velocity or strain).
struct MillardCurves {
  double active_min_length = 0.4441, active_transition_length = 0.73, active_max_length = 1.8123;
  double active_shallow_slope = 0.8616, active_minimum = 0.1;
  double concentric_slope_at_vmax = 0.0, concentric_slope_near_vmax = 0.25;
  double isometric_slope = 5.0;
  double eccentric_slope_at_vmax = 0.0, eccentric_slope_near_vmax = 0.15, eccentric_force = 1.4;
  double concentric_curviness = 0.6, eccentric_curviness = 0.9;
  double fiber_strain_at_zero_force = 0.0, fiber_strain_at_one_force = 0.7;
  /// A negative number stands for the value that the class computes.
  double fiber_stiffness_at_low_force = -1.0, fiber_stiffness_at_one_force = -1.0;
  double fiber_curviness = -1.0;
  double tendon_strain_at_one_force = 0.049, tendon_stiffness_at_one_force = -1.0;
  double tendon_force_at_toe_end = -1.0, tendon_curviness = -1.0;
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
  double min_control = 0.01;
  double max_control = 1.0;
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
