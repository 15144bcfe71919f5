#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/forces/actuator_columns.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/ground/core/index.h"
#include "myoid/opensim/analysis_reports.h"
#include "myoid/opensim/model_controls.h"
#include "myoid/opensim/tool_stages.h"

namespace myoid::opensim {
namespace {

using body::Signal;
using body::SimulationModel;
using body::SimulationStart;

/// Returns the row of a states file that the motion starts from: posture, speeds, activations and fibers.
SimulationStart start_of(AnalysisRun& run, const SimulationModel& model, double& start_s) {
  std::vector<Remark>& remarks = run.result.remarks;
  const auto path = run.setup.file(run.setup.tool(), "states_file");
  if (!path) {
    remarks.push_back({.says = "there is no <states_file>: the motion starts from the model's default state"});
    return body::default_start(model, start_s);
  }
  const TimeSeries q = read_coordinates(run.model, *path, MissingCoordinate::default_value, remarks);
  const Eigen::Index row = row_at(q.time_s(), start_s);
  start_s = q.time_s()[row];
  SimulationStart start = body::default_start(model, start_s);
  const auto speeds = read_speeds(run.model, *path, false, remarks);
  for (std::size_t c = 0; c < start.q.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    const body::Coordinate& k = model.body.coordinates[c];
    if (k.prescribed && !k.locked) continue;
    start.q[c] = q.values()(row, column);
    start.qdot[c] = speeds && !k.locked ? speeds->values()(row, column) : 0.0;
  }
  read_muscle_states(run, *path);
  for (const body::ModelMuscle& muscle : model.muscles) {
    if (run.activation.size() > 0) {
      const double a = run.activation(row, muscle.index);
      start.activation.push_back({a, a});
    }
    if (run.fiber_length_m.size() > 0 && !run.equilibrium)
      start.fiber.push_back({run.fiber_length_m(row, muscle.index), 0.0});
  }
  return start;
}

/// Returns the control of every muscle, clamped to its bounds as in OpenSim; a muscle without control rests.
std::vector<Signal> excitations_of(const ToolRun& run, const SimulationModel& model, const ModelControls& controls) {
  std::vector<Signal> result;
  std::string without;
  for (const body::ModelMuscle& muscle : model.muscles) {
    const body::MuscleProperties& p = model.body.muscles[at(muscle.index)].properties;
    const double least = std::clamp(p.minimum_activation, 0.0, 1.0);
    const auto control = controls.find(muscle.name);
    if (control == controls.end()) {
      without += (without.empty() ? "" : ", ") + muscle.name;
      result.push_back(body::constant(least));
      continue;
    }
    Signal signal = control->second;
    for (double& value : signal.value) value = std::clamp(value, least, 1.0);
    result.push_back(std::move(signal));
  }
  if (!without.empty()) run.note("no control for {}: at their least activation", without);
  return result;
}

/// Returns the sum of controls times strengths, at the nodes of all.
Signal sum_of(const std::vector<std::pair<double, const Signal*>>& parts) {
  std::set<double> times;
  for (const auto& [strength, signal] : parts) times.insert(signal->time_s.begin(), signal->time_s.end());
  Signal sum;
  for (const double t : times) {
    double value = 0.0;
    for (const auto& [strength, signal] : parts) value += strength * body::value_at(*signal, t);
    sum.time_s.push_back(t);
    sum.value.push_back(value);
  }
  return sum;
}

/// Forces along coordinates by the controls of CoordinateActuators; empty if there are none.
std::vector<Signal> coordinate_forces(const OpensimSetup& setup,
                                      const body::BodyModel& model,
                                      const ModelControls& controls) {
  std::vector<std::vector<std::pair<double, const Signal*>>> parts(model.coordinates.size());
  bool any = false;
  for (const body::Actuator& a : body::actuators_of(model)) {
    const auto control = controls.find(a.name);
    if (control == controls.end() || a.kind == body::Actuator::Kind::muscle) continue;
    if (a.kind != body::Actuator::Kind::coordinate) {
      const auto& values = control->second.value;
      if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; })) continue;
      setup.xml().fail(setup.tool(),
                       "actuator '{}' acts on bodies and is controlled: such forces are not part of forward dynamics "
                       "here; muscles and CoordinateActuators are",
                       a.name);
    }
    const body::CoordinateActuator& actuator = model.actuators[a.index];
    parts[at(actuator.coordinate)].emplace_back(actuator.optimal_force, &control->second);
    any = true;
  }
  std::vector<Signal> result;
  if (!any) return result;
  for (const auto& part : parts) result.push_back(part.empty() ? body::constant(0.0) : sum_of(part));
  return result;
}

/// States by the paths that OpenSim gives them.
TimeSeries states_table(const SimulationModel& model, const body::Simulation& s) {
  ColumnTable table;
  for (const body::Coordinate& c : model.body.coordinates) {
    const std::string path = fmt::format("/jointset/{}/{}/", model.body.joints[at(c.joint)].name, c.name);
    const bool turns = c.motion == body::MotionType::rotational;
    const Unit unit = turns ? Unit::radian : Unit::dimensionless;
    table.add(path + "value", unit, s.motion.column(c.name));
    table.add(path + "speed", unit, s.motion.column(c.name + "_speed"));
  }
  for (const body::ModelMuscle& muscle : model.muscles) {
    const std::string path = "/forceset/" + muscle.name + "/";
    table.add(path + "activation", Unit::dimensionless, s.activation.column(muscle.name));
    table.add(path + "fiber_length", Unit::dimensionless, s.fiber_length.column(muscle.name));
  }
  return table.at_times(s.motion.time_s());
}

TimeSeries controls_table(const body::BodyModel& model, const ModelControls& controls, const body::Simulation& s) {
  ColumnTable table;
  const Eigen::VectorXd& times = s.motion.time_s();
  for (const body::Actuator& actuator : body::actuators_of(model)) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(times.size());
    if (const auto control = controls.find(actuator.name); control != controls.end()) {
      for (Eigen::Index i = 0; i < times.size(); ++i) values[i] = body::value_at(control->second, times[i]);
    }
    table.add(actuator.name, Unit::dimensionless, std::move(values));
  }
  return table.at_times(times);
}

/// Throws ReadError for external loads; notes the analyses that are not run.
void refuse_and_note(const ToolRun& run) {
  const OpensimSetup& setup = run.setup;
  const auto& xml = setup.xml();
  const std::string loads = xml.word(setup.tool(), "external_loads_file");
  if (!loads.empty() && loads != "Unassigned") {
    xml.fail(xml.property(setup.tool(), "external_loads_file"),
             "loads on bodies are not part of forward dynamics here; leave them out, or use InverseDynamicsTool and "
             "StaticOptimization for a motion that is known");
  }
  for (const auto node : body::OsimXml::objects(xml.property(setup.tool(), "AnalysisSet"))) {
    if (!xml.flag(node, "on", true)) continue;
    run.note("analysis {} is not done: run an AnalyzeTool with it and <states_file> {}_states.sto", node.name(),
             setup.name());
  }
}

}  // namespace

void run_forward(const ToolRun& tool_run) {
  AnalysisRun run{tool_run};
  const OpensimSetup& setup = run.setup;
  ToolResult& result = run.result;
  const auto& xml = setup.xml();
  const auto tool = setup.tool();
  refuse_and_note(run);
  run.model = setup_model(setup, run.options.compat, {}, result.remarks);
  run.add_remarks(body::implausible(run.model), setup.required_file(tool, "model_file").string());
  run.decimals = std::clamp(static_cast<int>(xml.number(tool, "output_precision", 8.0)), 1, 30);
  run.equilibrium = xml.flag(tool, "solve_for_equilibrium_for_auxiliary_states", false);
  const auto states_file = claim_result(run, "states.sto");
  const auto degrees_file = claim_result(run, "states_degrees.mot");
  const auto controls_file = claim_result(run, "controls.sto");
  const ModelControls controls = read_model_controls(setup);
  const SimulationModel model = body::make_simulation_model(run.model, {.stops = false});
  double start_s = xml.number(tool, "initial_time", 0.0);
  const SimulationStart start = start_of(run, model, start_s);
  body::SimulationOptions how;
  how.end_s = xml.number(tool, "final_time", 1.0);
  if (!(how.end_s > start_s)) {
    xml.fail(tool, "<final_time> {} s, expected after the start at {} s", how.end_s, start_s);
  }
  how.ode.relative_tolerance = std::min(1e-8, xml.number(tool, "integrator_error_tolerance", 1e-5));
  how.ode.absolute_tolerance = 0.01 * how.ode.relative_tolerance;
  how.progress = run.options.progress;
  const body::Simulation done = body::simulate(model,
                                               {.excitation = excitations_of(run, model, controls),
                                                .external = coordinate_forces(setup, run.model, controls),
                                                .device = body::default_devices(model)},
                                               start, how);
  const TimeSeries states = states_table(model, done);
  write_opensim_storage(states_file, states, {.title = "states", .decimals = run.decimals});
  write_opensim_storage(degrees_file, states, {.title = setup.name(), .in_degrees = true, .decimals = run.decimals});
  write_opensim_storage(controls_file, controls_table(run.model, controls, done),
                        {.title = "ModelControls", .decimals = run.decimals});
  result.frames = static_cast<int>(states.sample_count());
  result.summary = fmt::format("{} to {} s, {} rows", start_s, done.reached_s, result.frames);
  if (done.status != math::OdeStatus::done) {
    result.frames_failed = 1;
    run.note("not simulated to the end: {}", done.message);
  }
}

}  // namespace myoid::opensim
