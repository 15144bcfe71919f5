#include "myoid/body/simulation/simulation_model.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/body/osim/muscle_laws.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// Returns the laws that the setup asks for; with MuscleCurves::file the muscle's class decides.
muscle::MusculotendonLaws laws_of(const body::MuscleProperties& p, MuscleCurves curves, muscle::TendonMode mode) {
  const muscle::MusculotendonLaws own = body::class_laws(p, mode);
  switch (curves) {
    case MuscleCurves::file:
      break;
    case MuscleCurves::paper:
      return muscle::paper_laws(mode);
    case MuscleCurves::thelen:
      return muscle::thelen_laws(mode);
    case MuscleCurves::de_groote:
      return own.length == muscle::LengthLaw::de_groote ? own : muscle::de_groote_laws(mode);
    case MuscleCurves::millard:
      return muscle::millard_laws(mode);
  }
  return own;
}

ModelMuscle muscle_of(const body::Muscle& m, int index, const ModelSetup& setup) {
  const body::MuscleProperties& p = m.properties;
  ModelMuscle result{.name = m.name, .index = index, .parameters = {}, .laws = {}, .activation = {}};
  const bool as_file = setup.curves == MuscleCurves::file;
  const bool equilibrium = setup.mode == muscle::TendonMode::equilibrium;
  const body::MuscleStates states = body::muscle_states(p);
  result.laws =
      laws_of(p, setup.curves, as_file && equilibrium && states.rigid_tendon ? muscle::TendonMode::rigid : setup.mode);
  result.parameters = body::musculotendon_parameters(p, result.laws);
  // Only Thelen's equilibrium works without damping; other units take the published damping.
  const bool undamped = equilibrium && result.laws.velocity == muscle::VelocityLaw::thelen;
  if (!(result.parameters.damping > 0.0) && !undamped)
    result.parameters.damping = muscle::published_defaults(result.parameters.hill, result.laws).damping;
  result.activation.law = as_file && states.no_activation_dynamics ? muscle::ActivationLaw::envelope : setup.activation;
  result.activation.excitation_time_s = setup.excitation_time_s;
  result.activation.activation_time_s = p.activation_time_s;
  result.activation.deactivation_time_s = p.deactivation_time_s;
  try {
    muscle::validate(result.parameters, result.laws);
    muscle::validate(result.activation);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("muscle {}: {}", m.name, error.what()));
  }
  return result;
}

/// Returns Millard's curves with the file's shape. A simulated unit of Millard's is damped: f_l is
/// never a divisor and needs no minimum.
muscle::MillardShape shape_of(const body::Muscle& m) {
  muscle::MillardShape shape = body::millard_shape(m.properties);
  shape.active.minimum = 0.0;
  return shape;
}

muscle::JointPassive<double> joint_of(const body::Coordinate& coordinate, const ModelSetup& setup) {
  muscle::JointPassive<double> joint;
  joint.viscosity_nms_per_rad = setup.joint_viscosity;
  if (setup.stops && coordinate.clamped) {
    const double width = coordinate.motion == body::MotionType::translational ? 0.003 : 3.0 * kDegree;
    joint.lower_stop_torque_nm = joint.upper_stop_torque_nm = 1.0;
    joint.lower_stop_rad = coordinate.lower;
    joint.upper_stop_rad = coordinate.upper;
    joint.lower_stop_width_rad = joint.upper_stop_width_rad = width;
  }
  return joint;
}

}  // namespace

SimulationModel make_simulation_model(body::BodyModel body, const ModelSetup& setup) {
  if (!body.constraints.empty()) {
    throw ModelError(
        fmt::format("the model has a closed loop ({} '{}'), which is not simulated; remove the constraint, or couple "
                    "coordinates instead",
                    body.constraints[0].class_name, body.constraints[0].name));
  }
  SimulationModel result;
  for (std::size_t i = 0; i < body.muscles.size(); ++i) {
    if (!body.muscles[i].applies_force) continue;
    result.muscles.push_back(muscle_of(body.muscles[i], static_cast<int>(i), setup));
    result.millard.push_back(shape_of(body.muscles[i]));
  }
  for (const body::Coordinate& coordinate : body.coordinates) result.joints.push_back(joint_of(coordinate, setup));
  for (const body::PassiveForce& force : body.passive_forces) {
    if (std::holds_alternative<body::PrescribedForce>(force.law)) {
      throw ModelError(
          fmt::format("force '{}' (PrescribedForce) is given over time; a simulation has only forces of posture and "
                      "speed: take it out of the model",
                      force.name));
    }
  }
  // A single spring on a coordinate joins the joint, whose stored energy is known.
  std::vector<char> sprung(body.coordinates.size(), 0);
  std::erase_if(body.passive_forces, [&](const body::PassiveForce& force) {
    const auto* spring = std::get_if<body::CoordinateSpring>(&force.law);
    if (spring == nullptr) return false;
    const auto k = static_cast<std::size_t>(spring->coordinate);
    if (sprung[k] != 0) return false;
    sprung[k] = 1;
    result.joints[k].stiffness_nm_per_rad = spring->stiffness;
    result.joints[k].neutral_rad = spring->rest;
    result.joints[k].viscosity_nms_per_rad += spring->viscosity;
    return true;
  });
  for (const body::CoordinateCoupler& c : body.couplers) {
    if (body.coordinates[static_cast<std::size_t>(c.dependent)].prescribed) {
      throw ModelError(
          fmt::format("coordinate '{}' follows '{}' through the coupler '{}' and is prescribed too; take one of the "
                      "two out of the model",
                      body.coordinates[static_cast<std::size_t>(c.dependent)].name,
                      body.coordinates[static_cast<std::size_t>(c.independent)].name, c.name));
    }
  }
  result.idle_actuators =
      body.actuators.size() + body.point_actuators.size() + body.torque_actuators.size() + body.path_actuators.size();
  result.body = std::move(body);
  return result;
}

SimulationStart default_start(const SimulationModel& model, double time_s) {
  const Eigen::VectorXd q = model.body.default_q();
  SimulationStart start{.time_s = time_s, .q = std::vector<double>(q.begin(), q.end())};
  for (std::size_t k = 0; k < start.q.size(); ++k) {
    const body::Coordinate& coordinate = model.body.coordinates[k];
    start.qdot.push_back(coordinate.locked ? 0.0 : coordinate.default_speed);
    if (!coordinate.prescribed) continue;
    const body::FunctionValue now = body::evaluate(*coordinate.prescribed, time_s);
    start.q[k] = now.value;
    start.qdot[k] = now.first;
  }
  return start;
}

std::vector<Device> default_devices(const SimulationModel& model) {
  std::vector<Device> devices;
  for (const body::Coordinate& coordinate : model.body.coordinates) {
    Device device;
    if (coordinate.prescribed) {
      device.acceleration = [f = *coordinate.prescribed](double t) { return body::evaluate(f, t).second; };
    } else if (coordinate.locked) {
      device = locked();
    }
    devices.push_back(std::move(device));
  }
  // A coordinate that follows another one is held by holding that one.
  for (std::size_t pass = 0; pass < model.body.couplers.size(); ++pass) {
    for (const body::CoordinateCoupler& c : model.body.couplers) {
      Device& dependent = devices[static_cast<std::size_t>(c.dependent)];
      if (!dependent.acceleration) continue;
      dependent = {};
      Device& independent = devices[static_cast<std::size_t>(c.independent)];
      if (!independent.acceleration) independent = locked();
    }
  }
  return devices;
}

}  // namespace myoid::body
