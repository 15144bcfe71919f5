#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/units.h"
#include "myoid/simulation/arm.h"

namespace myoid::simulation {

/// Calls f(name, unit, field) for every number of the arm, in one fixed order: MUSCLE.<names of
/// muscle::visit_parameters>, MUSCLE.path_..., MUSCLE.<times of activation>, joint_..., arm_....
template <typename ArmType, typename F>
void visit_arm_parameters(ArmType& arm, F&& f) {
  for (auto& m : arm.muscles) {
    const std::string head = m.name + ".";
    muscle::visit_parameters(
        m.parameters, [&](std::string_view name, Unit unit, auto& field) { f(head + std::string(name), unit, field); });
    f(head + "path_constant", Unit::meter, m.path.constant_m);
    f(head + "path_above", Unit::meter, m.path.above_m);
    f(head + "path_below", Unit::meter, m.path.below_m);
    f(head + "path_straight", Unit::radian, m.path.straight_rad);
    f(head + "path_pulley", Unit::meter, m.path.pulley_m);
    f(head + "excitation_time", Unit::second, m.activation.excitation_time_s);
    f(head + "activation_time", Unit::second, m.activation.activation_time_s);
    f(head + "deactivation_time", Unit::second, m.activation.deactivation_time_s);
  }
  auto& j = arm.joint;
  f("joint_stiffness", Unit::newton_meter, j.stiffness_nm_per_rad);
  f("joint_neutral", Unit::radian, j.neutral_rad);
  f("joint_viscosity", Unit::newton_meter_second, j.viscosity_nms_per_rad);
  f("joint_lower_stop_torque", Unit::newton_meter, j.lower_stop_torque_nm);
  f("joint_lower_stop", Unit::radian, j.lower_stop_rad);
  f("joint_lower_stop_width", Unit::radian, j.lower_stop_width_rad);
  f("joint_upper_stop_torque", Unit::newton_meter, j.upper_stop_torque_nm);
  f("joint_upper_stop", Unit::radian, j.upper_stop_rad);
  f("joint_upper_stop_width", Unit::radian, j.upper_stop_width_rad);
  f("arm_inertia", Unit::kilogram_meter2, arm.inertia_kgm2);
  f("arm_static_moment", Unit::kilogram, arm.static_moment_kgm);
  f("arm_held_mass", Unit::kilogram, arm.held_mass_kg);
  f("arm_held_at", Unit::meter, arm.held_at_m);
  f("arm_gravity", Unit::meter_per_second2, arm.gravity_mps2);
}

/// Returns the same arm in another scalar, without derivatives: seed them afterwards.
template <typename T>
[[nodiscard]] Arm<T> lifted_arm(const Arm<double>& arm) {
  Arm<T> result;
  for (const ArmMuscle<double>& m : arm.muscles) {
    ArmMuscle<T> muscle;
    muscle.name = m.name;
    muscle.laws = m.laws;
    muscle.activation.law = m.activation.law;
    muscle.activation.steepness = m.activation.steepness;
    result.muscles.push_back(std::move(muscle));
  }
  std::vector<T*> fields;
  visit_arm_parameters(result, [&](const auto&, Unit, T& field) { fields.push_back(&field); });
  std::size_t k = 0;
  visit_arm_parameters(arm, [&](const auto&, Unit, const double& value) { *fields[k++] = T(value); });
  return result;
}

/// Returns the names of the parameters. ("arm_static_moment" is in kg m, for which there is no Unit.)
[[nodiscard]] std::vector<std::string> arm_parameter_names(const Arm<double>& arm);

/// Returns one parameter. Throws InvalidInput listing the names if there is none of this name.
[[nodiscard]] double& arm_parameter(Arm<double>& arm, std::string_view name);

}  // namespace myoid::simulation
