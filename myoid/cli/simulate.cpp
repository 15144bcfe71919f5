#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/arm/arm4.h"
#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/core/units.h"
#include "myoid/dynamics/held_mass.h"
#include "myoid/files/text_file.h"
#include "myoid/recording/recording.h"
#include "myoid/results/sensitivity_files.h"
#include "myoid/results/simulation_files.h"
#include "myoid/simulation/arm_parameters.h"
#include "myoid/simulation/excitation_text.h"
#include "myoid/simulation/forward_simulation.h"
#include "myoid/simulation/sensitivity.h"
#include "myoid/simulation/simulation_model.h"
#include "myoid/tables/storage_reader.h"

namespace myoid::cli {
namespace {

using simulation::Signal;

struct SimulateOptions {
  std::string model = "arm4";
  std::string excitations, out, tendon, curves, activation, held_body;
  std::vector<std::string> excite, initial, speed, lock, sensitivity;
  std::vector<double> held_at{0.0, 0.0, 0.0};
  double rest = 0.01;
  double held_mass_kg = 0.0;
  double rate_hz = 200.0;
  double tolerance = 1e-8;
  bool horizontal = false, energy = false, figures = false, paper_figures = false;
};

const std::map<std::string, muscle::TendonMode> kModes = {
    {"rigid", muscle::TendonMode::rigid},
    {"equilibrium", muscle::TendonMode::equilibrium},
    {"mass", muscle::TendonMode::mass}};
const std::map<std::string, simulation::MuscleCurves> kCurves = {
    {"file", simulation::MuscleCurves::file},
    {"paper", simulation::MuscleCurves::paper},
    {"thelen", simulation::MuscleCurves::thelen},
    {"de_groote", simulation::MuscleCurves::de_groote},
    {"millard", simulation::MuscleCurves::millard}};
const std::map<std::string, muscle::ActivationLaw> kLaws = {
    {"envelope", muscle::ActivationLaw::envelope},
    {"two_lags", muscle::ActivationLaw::two_lags},
    {"thelen", muscle::ActivationLaw::thelen},
    {"de_groote", muscle::ActivationLaw::de_groote},
    {"recursive", muscle::ActivationLaw::recursive}};

template <typename Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> result;
  for (const auto& [key, value] : map) result.push_back(key);
  return result;
}

muscle::MusculotendonLaws laws_of(simulation::MuscleCurves curves, muscle::TendonMode mode) {
  switch (curves) {
    case simulation::MuscleCurves::thelen:
      return muscle::thelen_laws(mode);
    case simulation::MuscleCurves::de_groote:
      return muscle::de_groote_laws(mode);
    case simulation::MuscleCurves::millard:
      return muscle::millard_laws(mode);
    case simulation::MuscleCurves::file:
    case simulation::MuscleCurves::paper:
      break;
  }
  return muscle::paper_laws(mode);
}

/// "NAME=NUMBER" of an option.
std::pair<std::string, double> assignment(const std::string& text, std::string_view option) {
  const std::size_t at = text.find('=');
  const auto number =
      at == std::string::npos ? std::nullopt : recording::parse_number(text.substr(at + 1));
  if (at == 0 || !number || !std::isfinite(*number))
    throw InvalidInput(fmt::format("{} '{}': expected NAME=NUMBER", option, text));
  return {text.substr(0, at), *number};
}

/// From the file or the command line; `end_s` becomes the end of the file.
std::vector<Signal> excitations(const SimulateOptions& o,
                                const std::vector<std::string>& muscles,
                                const Context& context,
                                double& start_s,
                                std::optional<double>& end_s) {
  if (o.excitations.empty()) return simulation::described_excitations(o.excite, o.rest, muscles);
  const recording::Storage file = recording::read_storage(o.excitations);
  for (const recording::Repair& repair : file.repairs)
    context.warn(recording::to_string(o.excitations, repair));
  try {
    std::vector<Signal> signals = simulation::excitations_from(file.data, muscles);
    if (!context.start_s) start_s = file.data.time_s()[0];
    if (!end_s) end_s = file.data.time_s()[file.data.sample_count() - 1];
    return signals;
  } catch (const ReadError&) {
    throw;
  } catch (const InvalidInput& error) {
    throw ReadError(o.excitations, 0, error.what());
  }
}

std::string options_json(const SimulateOptions& o, double start_s, double end_s) {
  return json_text({{"model", o.model},           {"excitations", o.excitations},
                    {"excite", o.excite},         {"rest", o.rest},
                    {"tendon", o.tendon},         {"curves", o.curves},
                    {"activation", o.activation}, {"initial", o.initial},
                    {"initial_speed", o.speed},   {"lock", o.lock},
                    {"horizontal", o.horizontal}, {"held_mass_kg", o.held_mass_kg},
                    {"held_body", o.held_body},   {"held_at_m", o.held_at},
                    {"rate_hz", o.rate_hz},       {"tolerance", o.tolerance},
                    {"energy", o.energy},         {"sensitivity", o.sensitivity},
                    {"start_s", start_s},         {"end_s", end_s}},
                   -1);
}

/// Sets what --initial, --initial-speed and --lock name among the coordinates.
void place(const SimulateOptions& o,
           const std::vector<std::pair<std::string, bool>>& coordinates,
           simulation::SimulationStart& start,
           std::vector<simulation::Device>& devices) {
  const auto index = [&](const std::string& name, std::string_view option) {
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      if (coordinates[k].first == name) return k;
    }
    std::string names;
    for (const auto& [each, turns] : coordinates) names += (names.empty() ? "" : ", ") + each;
    throw InvalidInput(
        fmt::format("{} {}: the model has no such coordinate; there are {}", option, name, names));
  };
  start.qdot.resize(coordinates.size(), 0.0);
  for (const std::string& text : o.initial) {
    const auto [name, value] = assignment(text, "--initial");
    const std::size_t k = index(name, "--initial");
    start.q[k] = coordinates[k].second ? value * kDegree : value;
  }
  for (const std::string& text : o.speed) {
    const auto [name, value] = assignment(text, "--initial-speed");
    const std::size_t k = index(name, "--initial-speed");
    start.qdot[k] = coordinates[k].second ? value * kDegree : value;
  }
  for (const std::string& name : o.lock) devices[index(name, "--lock")] = simulation::locked();
}

/// What follows another coordinate cannot be placed by itself. (`simulate` refuses to hold it.)
void refuse_followers(const SimulateOptions& o, const model::BodyModel& body) {
  for (const model::CoordinateCoupler& c : body.couplers) {
    const std::string& name = body.coordinates[static_cast<std::size_t>(c.dependent)].name;
    for (const auto* list : {&o.initial, &o.speed}) {
      for (const std::string& text : *list) {
        if (!text.starts_with(name + "=")) continue;
        throw InvalidInput(
            fmt::format("{}: the coordinate follows '{}' (coupler '{}'); place that", text,
                        body.coordinates[static_cast<std::size_t>(c.independent)].name, c.name));
      }
    }
  }
}

struct Outcome {
  simulation::Simulation simulation;
  std::optional<simulation::Sensitivities> sensitivities;
  model::BodyModel body;
  HeldCoordinates held;
  double start_s = 0.0, end_s = 0.0;
};

simulation::SimulationOptions run_options(const SimulateOptions& o,
                                          const Context& context,
                                          double end_s) {
  simulation::SimulationOptions options;
  options.end_s = end_s;
  options.output_rate_hz = o.rate_hz;
  options.energy = o.energy;
  options.ode.relative_tolerance = o.tolerance;
  options.ode.absolute_tolerance = 0.01 * o.tolerance;
  options.progress = context.progress();
  return options;
}

/// The parameters of --sensitivity: names, or the beginning of names before a '*'.
std::vector<std::string> wanted_parameters(const SimulateOptions& o,
                                           const simulation::Arm<double>& arm) {
  std::vector<std::string> all = simulation::arm_parameter_names(arm);
  all.insert(all.end(), {"start_angle", "start_speed"});
  std::vector<std::string> result;
  for (const std::string& text : o.sensitivity) {
    const std::string head = text.ends_with('*') ? text.substr(0, text.size() - 1) : text;
    bool found = false;
    for (const std::string& name : all) {
      if (text.ends_with('*') ? !name.starts_with(head) : name != text) continue;
      found = true;
      if (std::find(result.begin(), result.end(), name) == result.end()) result.push_back(name);
    }
    if (!found) {
      throw InvalidInput(fmt::format("--sensitivity {}: no such parameter; there are {}", text,
                                     fmt::join(all, ", ")));
    }
  }
  return result;
}

Outcome simulate_arm4(SimulateOptions& o, const Context& context) {
  if (o.tendon.empty()) o.tendon = "equilibrium";
  if (o.curves.empty()) o.curves = "paper";
  if (o.activation.empty()) o.activation = "two_lags";
  simulation::ArmSetup setup;
  setup.horizontal = o.horizontal;
  setup.held_mass_kg = o.held_mass_kg;
  setup.laws = laws_of(kCurves.at(o.curves), kModes.at(o.tendon));
  setup.activation.law = kLaws.at(o.activation);
  const simulation::Arm<double> arm = simulation::make_arm(setup);
  std::vector<std::string> muscles;
  for (const auto& m : arm.muscles) muscles.push_back(m.name);

  Outcome result{.simulation = {}, .body = load_model("arm4", context), .held = {}};
  result.start_s = context.start_s.value_or(0.0);
  std::optional<double> end_s = context.end_s;
  simulation::SimulationInput input;
  input.excitation = excitations(o, muscles, context, result.start_s, end_s);
  result.end_s = end_s.value_or(result.start_s + 1.0);
  simulation::SimulationStart start{.time_s = result.start_s, .q = {0.0}};
  input.device = {simulation::Device{}};
  place(o, {{"elbow_flexion", true}}, start, input.device);
  const simulation::SimulationOptions options = run_options(o, context, result.end_s);
  const std::vector<std::string> wanted = wanted_parameters(o, arm);
  result.simulation = simulation::simulate(arm, input, start, options);
  if (!wanted.empty() && result.simulation.status == math::OdeStatus::done) {
    result.sensitivities = simulation::simulate_sensitivities(arm, input, start, options, wanted);
  }
  const Vec3 shoulder = model::arm4_shoulder_rad(o.horizontal);
  result.held = {{"shoulder_flexion", shoulder.x()},
                 {"shoulder_adduction", shoulder.y()},
                 {"shoulder_rotation", shoulder.z()}};
  return result;
}

Outcome simulate_file(SimulateOptions& o, const Context& context) {
  if (o.tendon.empty()) o.tendon = "equilibrium";
  if (o.curves.empty()) o.curves = "file";
  if (o.activation.empty()) o.activation = "thelen";
  if (o.horizontal)
    throw InvalidInput("--horizontal belongs to arm4; a model file says its gravity itself");
  if (!o.sensitivity.empty()) {
    throw InvalidInput(
        "--sensitivity belongs to arm4; of a model file, simulate twice and take differences");
  }
  model::BodyModel body = load_model(o.model, context);
  if (o.held_mass_kg != 0.0) {
    body = dynamics::with_held_mass(std::move(body), o.held_body,
                                    Vec3(o.held_at[0], o.held_at[1], o.held_at[2]), o.held_mass_kg);
  }
  const simulation::SimulationModel model =
      simulation::make_simulation_model(std::move(body), {.mode = kModes.at(o.tendon),
                                                          .curves = kCurves.at(o.curves),
                                                          .activation = kLaws.at(o.activation)});
  for (const std::string& note : model.notes) context.warn(fmt::format("{}: {}", o.model, note));
  std::vector<std::string> muscles;
  for (const auto& m : model.muscles) muscles.push_back(m.name);
  std::vector<std::pair<std::string, bool>> coordinates;
  for (const model::Coordinate& c : model.body.coordinates)
    coordinates.emplace_back(c.name, c.motion == model::MotionType::rotational);

  Outcome result{.simulation = {}, .body = model.body, .held = {}};
  result.start_s = context.start_s.value_or(0.0);
  std::optional<double> end_s = context.end_s;
  simulation::SimulationInput input;
  input.excitation = excitations(o, muscles, context, result.start_s, end_s);
  input.device = simulation::default_devices(model);
  result.end_s = end_s.value_or(result.start_s + 1.0);
  simulation::SimulationStart start = simulation::default_start(model, result.start_s);
  refuse_followers(o, model.body);
  place(o, coordinates, start, input.device);
  result.simulation =
      simulation::simulate(model, input, start, run_options(o, context, result.end_s));
  return result;
}

void draw_paper_figures(const SimulateOptions& o, const Context& context) {
  context.prepare_folder(o.out);
  for (const report::Figure& figure : paper_figures()) {
    write_figure(figure, o.out);
    fmt::print("{}/figures/{}.svg\n", o.out, figure.id);
  }
}

void run(SimulateOptions& o, Context& context) {
  if (o.paper_figures) return draw_paper_figures(o, context);
  if (!o.excitations.empty() && !o.excite.empty())
    throw InvalidInput("give either --excitations or --excite, not both");
  if (!(o.rest >= 0.0 && o.rest <= 1.0))
    throw InvalidInput(fmt::format("--rest {}: expected 0 to 1", o.rest));
  if (!(o.tolerance >= 1e-13 && o.tolerance <= 1e-2))
    throw InvalidInput(fmt::format("--tolerance {}: expected 1e-13 to 0.01", o.tolerance));
  context.prepare_folder(o.out);
  context.protect_inputs(o.out,
                         {"motion.mot", "speeds.sto", "accelerations.sto", "excitation.sto",
                          "activation.sto", "forces.sto", "fiber_forces.sto", "MuscleAnalysis_",
                          "torques.sto", "states.sto", "energy.sto", "simulation.json"},
                         {o.model, o.excitations});
  Outcome outcome = o.model == "arm4" ? simulate_arm4(o, context) : simulate_file(o, context);
  context.end_progress();
  Provenance provenance;
  provenance.command = context.command_line;
  if (o.model != "arm4")
    provenance.inputs.push_back({o.model, sha256(recording::read_text_file(o.model))});
  if (!o.excitations.empty())
    provenance.inputs.push_back({o.excitations, sha256(recording::read_text_file(o.excitations))});
  provenance.options_json = options_json(o, outcome.start_s, outcome.end_s);
  const simulation::Simulation& s = outcome.simulation;
  write_simulation(s, outcome.body, outcome.held, provenance, o.out);
  if (outcome.sensitivities) {
    std::vector<std::string> muscles;
    for (const Channel& channel : s.activation.channels()) muscles.push_back(channel.name);
    write_sensitivities(*outcome.sensitivities, muscles, provenance, o.out);
    if (outcome.sensitivities->status != math::OdeStatus::done) {
      context.warn(fmt::format("sensitivities not to the end: {}", outcome.sensitivities->message));
      context.exit_code = kQualityGateFailed;
    }
  }
  if (o.figures) write_figure(movement_figure(s), o.out);
  if (s.jumps_passed > 0) {
    context.warn(fmt::format(
        "{} times the equations jumped, as where the path of a muscle does; each was passed by a "
        "step of 1 ns, and energy is not kept there",
        s.jumps_passed));
  }
  if (s.status != math::OdeStatus::done) {
    context.warn(fmt::format("not simulated to the end: {}", s.message));
    context.exit_code = kQualityGateFailed;
  }
  if (context.json) {
    fmt::print("{}", simulation_json(s, provenance));
  } else {
    fmt::print("{}\n", o.out);
  }
}

}  // namespace

void add_simulate(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "simulate",
      "Forward dynamics: excitations of the muscles to motion, forces and lengths.\n"
      "Example: myoid simulate --model arm4 --excite BIC=0.1@0.2+0.3 --end 2 --out sim");
  const auto o = std::make_shared<SimulateOptions>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4 (default)");
  command.add_option("--excitations", o->excitations,
                     "Excitation per muscle over time (.sto), 0 to 1, linear between its samples");
  command.add_option("--excite", o->excite,
                     "Instead: MUSCLE=LEVEL, or LEVEL@START (a step), or LEVEL@START+DURATION (a "
                     "burst); may be repeated; 'all' is every muscle");
  command.add_option("--rest", o->rest, "Excitation where --excite says nothing (default 0.01)");
  command.add_option("--out", o->out, "Folder for the results")->required();
  command
      .add_option("--tendon", o->tendon,
                  "rigid, equilibrium (default) or mass (the source paper's muscle mass)")
      ->check(CLI::IsMember(keys(kModes)));
  command
      .add_option("--curves", o->curves,
                  "file (default for .osim), paper (default for arm4), thelen, de_groote, millard")
      ->check(CLI::IsMember(keys(kCurves)));
  command
      .add_option("--activation", o->activation,
                  "two_lags (default for arm4), thelen (default for .osim), de_groote, recursive, "
                  "envelope")
      ->check(CLI::IsMember(keys(kLaws)));
  command.add_option("--initial", o->initial,
                     "COORDINATE=VALUE at the start [deg, m]; may be repeated (default: the "
                     "model's default posture)");
  command.add_option("--initial-speed", o->speed, "COORDINATE=SPEED at the start [deg/s, m/s]");
  command.add_option("--lock", o->lock, "Coordinate that does not move; may be repeated");
  command.add_flag("--horizontal", o->horizontal, "arm4 without gravity");
  command.add_option("--held-mass", o->held_mass_kg, "Mass held in the hand [kg] (default 0)");
  command.add_option("--held-body", o->held_body, "Body of the model that holds it");
  command.add_option("--held-at", o->held_at, "Where on that body, x y z [m]")->expected(3);
  command.add_option("--rate", o->rate_hz, "Samples of the results [Hz] (default 200)");
  command.add_option("--tolerance", o->tolerance,
                     "Relative local error of the integration (default 1e-8)");
  command.add_flag("--energy", o->energy, "Also the work of every element, and whether it adds up");
  command.add_option("--sensitivity", o->sensitivity,
                     "Also the derivatives by this parameter of arm4, such as "
                     "BIC.max_isometric_force, 'BIC.*' or '*'; may be repeated");
  command.add_flag("--figures", o->figures, "Also a figure of the movement (.svg, .csv)");
  command.add_flag("--paper-figures", o->paper_figures,
                   "Only the source paper's figures 2 and 4, drawn by this program");
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o] { run(*o, context); });
}

}  // namespace myoid::cli
