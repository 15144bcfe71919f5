#include "myoid/body/simulation/model_parameters.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

constexpr char kAxes[] = {'x', 'y', 'z'};

void add_muscle(ModelMuscle& m, std::vector<ModelParameter>& list) {
  muscle::visit_parameters(m.parameters, [&](std::string_view name, Unit, double& value) {
    // The limit of small damping is not the equilibrium without damping.
    if (name != "damping" || value != 0.0) list.push_back({fmt::format("{}.{}", m.name, name), &value});
  });
  list.push_back({m.name + ".excitation_time", &m.activation.excitation_time_s});
  list.push_back({m.name + ".activation_time", &m.activation.activation_time_s});
  list.push_back({m.name + ".deactivation_time", &m.activation.deactivation_time_s});
}

void add_joint(const std::string& coordinate, muscle::JointPassive<double>& j, std::vector<ModelParameter>& list) {
  list.push_back({coordinate + ".stiffness", &j.stiffness_nm_per_rad});
  list.push_back({coordinate + ".neutral", &j.neutral_rad, true});
  list.push_back({coordinate + ".viscosity", &j.viscosity_nms_per_rad});
  list.push_back({coordinate + ".lower_stop_torque", &j.lower_stop_torque_nm});
  list.push_back({coordinate + ".lower_stop", &j.lower_stop_rad, true});
  list.push_back({coordinate + ".lower_stop_width", &j.lower_stop_width_rad});
  list.push_back({coordinate + ".upper_stop_torque", &j.upper_stop_torque_nm});
  list.push_back({coordinate + ".upper_stop", &j.upper_stop_rad, true});
  list.push_back({coordinate + ".upper_stop_width", &j.upper_stop_width_rad});
}

void add_body(body::Body& body, std::vector<ModelParameter>& list) {
  list.push_back({body.name + ".mass", &body.mass_kg});
  for (int axis = 0; axis < 3; ++axis)
    list.push_back({fmt::format("{}.mass_center_{}", body.name, kAxes[axis]), &body.p_BBcm_B[axis], true});
  for (int axis = 0; axis < 3; ++axis)
    list.push_back({fmt::format("{}.inertia_{}{}", body.name, kAxes[axis], kAxes[axis]), &body.I_BBcm_B(axis, axis)});
}

}  // namespace

std::vector<ModelParameter> model_parameters(SimulationModel& model) {
  std::vector<ModelParameter> list;
  for (ModelMuscle& m : model.muscles) add_muscle(m, list);
  for (std::size_t k = 0; k < model.joints.size(); ++k)
    add_joint(model.body.coordinates[k].name, model.joints[k], list);
  for (std::size_t b = 1; b < model.body.bodies.size(); ++b) add_body(model.body.bodies[b], list);  // 0 is ground
  for (int axis = 0; axis < 3; ++axis)
    list.push_back({fmt::format("gravity_{}", kAxes[axis]), &model.body.gravity_G[axis], true});
  return list;
}

ModelParameter model_parameter(SimulationModel& model, std::string_view name) {
  const std::vector<ModelParameter> all = model_parameters(model);
  const auto found = std::ranges::find(all, name, &ModelParameter::name);
  if (found == all.end()) throw InvalidInput(fmt::format("the model has no parameter '{}'", name));
  return *found;
}

}  // namespace myoid::body
