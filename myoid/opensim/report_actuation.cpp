#include <limits>
#include <utility>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/forces/actuation.h"
#include "myoid/body/forces/actuator_columns.h"
#include "myoid/body/forces/static_optimization.h"
#include "myoid/ground/core/index.h"
#include "myoid/opensim/analysis_reports.h"

namespace myoid::opensim {
namespace {

/// Returns the model with muscles and actuators of unbounded control.
body::BodyModel without_bounds(body::BodyModel model) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (body::Muscle& muscle : model.muscles) muscle.properties.control = {-kInfinity, kInfinity};
  body::visit_actuators(model, [&](auto& list) {
    for (auto& actuator : list) {
      actuator.min_control = -kInfinity;
      actuator.max_control = kInfinity;
    }
  });
  return model;
}

body::BodyModel with_coordinate_actuators_only(body::BodyModel model) {
  body::visit_actuators(model, [](auto& list) { list.clear(); });
  return with_coordinate_actuators(std::move(model));
}

/// Returns "<coordinate>_moment", "_force", or the name alone where the coordinate is neither an angle nor a length.
std::string column_name(const body::Coordinate& coordinate) {
  return coordinate.motion == body::MotionType::coupled ? coordinate.name : body::generalized_force_name(coordinate);
}

}  // namespace

void report_actuation(AnalysisRun& run, pugi::xml_node node) {
  const TimeSeries& forces = forces_of_states(run);
  if (forces.channel_count() == 0) run.setup.xml().fail(node, "Actuation: the model has neither muscles nor actuators");
  body::Actuation result =
      body::actuation(run.model, run.moved, forces,
                      {.speeds_of_opensim = run.options.compat == body::kOpenSim452, .progress = run.options.progress});
  const auto write = [&](const char* quantity, const char* title, const TimeSeries& table) {
    write_result(run, analysis_name(node) + quantity, table,
                 {.title = title,
                  .description = "\nThis file contains the forces, the speeds or the powers of the "
                                 "actuators.\nSpeeds of muscles and other paths are rates of lengthening; "
                                 "a positive power does work on the model.\nUnits are S.I. units (seconds, "
                                 "meters, Newtons, radians, Watts)\n\n"});
  };
  write("_force.sto", "ActuatorForces", forces);
  write("_speed.sto", "ActuatorSpeeds", result.speed);
  write("_power.sto", "ActuatorPowers", result.power_w);
}

void report_inverse_dynamics(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const auto path = claim_result(run, analysis_name(node) + ".sto");
  const bool use_forces = xml.flag(node, "use_model_force_set", xml.flag(node, "use_model_actuator_set", true));
  const body::BodyModel model = without_bounds(use_forces ? run.model : with_coordinate_actuators_only(run.model));
  std::size_t unknown = 0;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c)
    if (!model.is_constrained(static_cast<int>(c))) ++unknown;
  const std::size_t count = body::actuators_of(model).size();
  if (count < unknown) {
    xml.fail(node,
             "InverseDynamics: {} muscles and actuators for {} coordinates that move; append actuators "
             "(<force_set_files>), or set <use_model_force_set> false",
             count, unknown);
  }
  const body::StaticOptimizationResult solved = body::static_optimization(
      model, run.motion, {.muscle_physiology = false, .loads = run.loads_if_any(), .progress = run.options.progress});
  std::vector<Channel> channels = solved.force.channels();
  if (!use_forces) {
    for (Channel& channel : channels)
      channel.name = column_name(model.coordinates[at(model.coordinate_index(channel.name))]);
  }
  write_opensim_storage(path, {solved.force.time_s(), std::move(channels), solved.force.values()},
                        {.title = "Inverse Dynamics",
                         .description = "This file contains inverse dynamics results.\n\n",
                         .decimals = run.decimals});
  run.result.frames_failed += solved.frames_failed;
}

}  // namespace myoid::opensim
