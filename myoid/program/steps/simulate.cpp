#include "myoid/program/steps/simulate.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/held_mass.h"
#include "myoid/body/simulation/arm_model.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/page/write_report.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/simulate_setup.h"
#include "myoid/program/steps/stage_input.h"

namespace myoid::program {
namespace {

/// Fills empty words of the options with the defaults of the kind of model.
SimulateOptions with_defaults(SimulateOptions o) {
  const bool arm4 = o.model == "arm4";
  if (!o.curves) o.curves = arm4 ? body::MuscleCurves::paper : body::MuscleCurves::file;
  if (!o.activation) o.activation = arm4 ? muscle::ActivationLaw::two_lags : muscle::ActivationLaw::thelen;
  return o;
}

void refuse_impossible(const SimulateOptions& o) {
  if (!o.excitations.empty() && !o.excite.empty())
    throw InvalidInput("give either --excitations or --excite, not both");
  if (o.model == "arm4") return;
  if (o.horizontal) throw InvalidInput("--horizontal belongs to arm4; a model file says its gravity itself");
}

Provenance provenance_of(const SimulateOptions& o, const Drive& drive) {
  Provenance provenance;
  provenance.command = o.call.command;
  if (o.model != "arm4") provenance.inputs.push_back({o.model, sha256(read_text_file(o.model))});
  if (!o.excitations.empty()) provenance.inputs.push_back({o.excitations, sha256(read_text_file(o.excitations))});
  provenance.options_json = json_text({{"model", o.model},
                                       {"excitations", o.excitations},
                                       {"excite", o.excite},
                                       {"rest", o.rest},
                                       {"tendon", choice_name(o.tendon)},
                                       {"curves", choice_name(*o.curves)},
                                       {"activation", choice_name(*o.activation)},
                                       {"initial", o.initial},
                                       {"initial_speed", o.initial_speed},
                                       {"lock", o.lock},
                                       {"horizontal", o.horizontal},
                                       {"held_mass_kg", o.held.mass_kg},
                                       {"held_body", o.held.body},
                                       {"held_at_m", o.held.at_m},
                                       {"rate_hz", o.rate_hz},
                                       {"tolerance", o.tolerance},
                                       {"energy", o.energy},
                                       {"sensitivity", o.sensitivity},
                                       {"start_s", drive.start_s},
                                       {"end_s", drive.end_s}},
                                      -1);
  return provenance;
}

/// Steps that an integration may take. Stiff arms need some 5,000 a second; a model with a path of a million meters
/// would need billions.
constexpr double kLeastSteps = 1e5, kStepsPerSecond = 1e5;

body::SimulationOptions integration_options(const SimulateOptions& o, double start_s, double end_s) {
  body::SimulationOptions options;
  options.end_s = end_s;
  options.output_rate_hz = o.rate_hz;
  options.energy = o.energy;
  options.ode.relative_tolerance = o.tolerance;
  options.ode.absolute_tolerance = 0.01 * o.tolerance;
  options.ode.max_steps = std::min(options.ode.max_steps,
                                   static_cast<long>(kLeastSteps + kStepsPerSecond * std::min(end_s - start_s, 1e3)));
  options.progress = o.call.progress;
  return options;
}

body::ModelSetup setup_of(const SimulateOptions& o) {
  return {.mode = o.tendon, .curves = *o.curves, .activation = *o.activation};
}

/// Loads the arm, whose shoulder stays outside the simulation.
body::SimulationModel load_arm(const SimulateOptions& o, SimulateResult& result, Remarks& remarks) {
  result.body = load_model("arm4", body::Compatibility::exact, remarks);
  const Vec3 shoulder = body::arm4_shoulder_rad(o.horizontal);
  result.held = {
      {"shoulder_flexion", shoulder.x()}, {"shoulder_adduction", shoulder.y()}, {"shoulder_rotation", shoulder.z()}};
  return body::make_arm_model({.horizontal = o.horizontal, .held_mass_kg = o.held.mass_kg, .model = setup_of(o)});
}

body::SimulationModel load_file(const SimulateOptions& o, SimulateResult& result, Remarks& remarks) {
  result.body = load_model(o.model, body::Compatibility::exact, remarks);
  if (o.held.mass_kg != 0.0) {
    result.body = body::with_held_mass(std::move(result.body), o.held.body,
                                       Vec3(o.held.at_m[0], o.held.at_m[1], o.held.at_m[2]), o.held.mass_kg);
  }
  body::SimulationModel model = body::make_simulation_model(result.body, setup_of(o));
  if (model.idle_actuators > 0)
    remarks.warn(fmt::format("{}: its {} actuators exert nothing", o.model, model.idle_actuators));
  return model;
}

/// Warns of simulations that ended early, and of jumps in the equations.
void tell_trouble(const SimulateResult& result, Remarks& remarks) {
  if (result.sensitivities && result.sensitivities->status != math::OdeStatus::done)
    remarks.warn(fmt::format("sensitivities not to the end: {}", result.sensitivities->message));
  const body::Simulation& s = result.simulation;
  if (s.jumps_passed > 0) {
    remarks.warn(
        fmt::format("{} times the equations jumped, as where the path of a muscle does; each was passed by a step of 1 "
                    "ns, and energy is not kept there",
                    s.jumps_passed));
  }
  if (s.status != math::OdeStatus::done) remarks.warn(fmt::format("not simulated to the end: {}", s.message));
}

/// Visits the laws of the muscles and their excitations.
void visit_muscles(SimulateOptions& o, study::SettingVisitor& v) {
  v.path("excitations", o.excitations,
         {.says = "Excitation per muscle over time (.sto), 0 to 1, linear between its samples."});
  v.texts(
      "excite", o.excite,
      {.says = "Instead: MUSCLE=LEVEL, or LEVEL@START (a step), or LEVEL@START+DURATION (a burst); may be repeated; "
               "'all' is every muscle."});
  v.number("rest", o.rest, {.says = "Excitation where --excite says nothing.", .limits = study::within(0.0, 1.0)});
  v.choice("tendon", o.tendon, {.says = "mass: with the source paper's muscle mass."});
  v.choice("curves", o.curves,
           {.says = "file: the curves of the muscle's class.", .otherwise = "file for .osim, paper for arm4"});
  v.choice("activation", o.activation,
           {.says = "Law of activation.", .otherwise = "thelen for .osim, two_lags for arm4"});
}

/// Visits the start of the movement, its constraints and loads.
void visit_movement(SimulateOptions& o, study::SettingVisitor& v) {
  v.texts(
      "initial", o.initial,
      {.says = "COORDINATE=VALUE at the start [deg, m]; may be repeated.", .otherwise = "the model's default posture"});
  v.texts("initial-speed", o.initial_speed, {.says = "COORDINATE=SPEED at the start [deg/s, m/s]."});
  v.texts("lock", o.lock, {.says = "Coordinate that does not move; may be repeated."});
  v.flag("horizontal", o.horizontal, {.says = "arm4 without gravity."});
  visit(o.held, v);
}

}  // namespace

bool SimulateResult::finished() const {
  return simulation.status == math::OdeStatus::done &&
         (!sensitivities || sensitivities->status == math::OdeStatus::done);
}

void visit(SimulateOptions& o, study::SettingVisitor& v) {
  v.path("model", o.model, {.says = "OpenSim model (.osim), or arm4."});
  v.folder("out", o.out, {.says = "Folder for the results.", .required = "a folder"});
  visit_muscles(o, v);
  visit_movement(o, v);
  v.number("rate", o.rate_hz, {.says = "Samples of the results.", .limits = study::above_zero("Hz")});
  v.number("tolerance", o.tolerance,
           {.says = "Relative local error of the integration.", .limits = study::within(1e-13, 1e-2)});
  v.flag("energy", o.energy, {.says = "Also the work of every element, and whether it adds up."});
  v.texts("sensitivity", o.sensitivity,
          {.says = "Also the derivatives by this parameter of the model, such as BIC.max_isometric_force, 'BIC.*' or "
                   "'*'; may be repeated."});
  v.flag("figures", o.figures, {.says = "Also a figure of the movement (.svg, .csv)."});
}

SimulateResult simulate(const SimulateOptions& options) {
  check_options(options);
  const SimulateOptions o = with_defaults(options);
  refuse_impossible(o);
  Remarks remarks(o.call);
  SimulateResult result;
  const body::SimulationModel model = o.model == "arm4" ? load_arm(o, result, remarks) : load_file(o, result, remarks);
  std::vector<std::string> muscles;
  for (const auto& m : model.muscles) muscles.push_back(m.name);
  std::vector<NamedCoordinate> coordinates;
  for (const body::Coordinate& c : model.body.coordinates)
    coordinates.push_back({c.name, c.motion == body::MotionType::rotational});
  Drive drive = read_drive(o, muscles, remarks);
  body::SimulationInput input;
  input.excitation = std::move(drive.excitation);
  input.device = body::default_devices(model);
  body::SimulationStart start = body::default_start(model, drive.start_s);
  refuse_followers(o, model.body);
  place(o, coordinates, start, input.device);
  const std::vector<std::string> wanted = wanted_parameters(o, model);
  const body::SimulationOptions integration = integration_options(o, drive.start_s, drive.end_s);
  result.simulation = body::simulate(model, input, start, integration);
  if (!wanted.empty() && result.simulation.status == math::OdeStatus::done)
    result.sensitivities = body::simulate_sensitivities(model, input, start, integration, wanted);
  result.provenance = provenance_of(o, drive);
  if (o.figures) result.figures.push_back(results::movement_figure(result.simulation));
  tell_trouble(result, remarks);
  result.remarks = remarks.list();
  return result;
}

void write_simulate(const SimulateResult& result, const std::filesystem::path& folder) {
  const body::Simulation& s = result.simulation;
  results::write_simulation(s, result.body, result.held, result.provenance, folder);
  if (result.sensitivities) results::write_sensitivities(*result.sensitivities, result.provenance, folder);
  for (const page::Figure& figure : result.figures) write_figure(figure, folder);
}

}  // namespace myoid::program
