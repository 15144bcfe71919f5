#include "myoid/program/commands/simulate.h"

#include <fmt/format.h>

#include "myoid/ground/files/output_file.h"
#include "myoid/page/write_report.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"
#include "myoid/results/simulation_files.h"

namespace myoid::program {
namespace {

void draw_paper_figures(const std::string& out, const Context& context) {
  context.prepare_folder(out);
  for (const page::Figure& figure : results::paper_figures()) {
    write_figure(figure, out);
    say("{}/figures/{}.svg\n", out, figure.id);
  }
}

/// Adds the laws of the muscles and their excitations.
void add_muscle_options(CLI::App& command, program::SimulateOptions& o) {
  command.add_option("--excitations", o.excitations,
                     "Excitation per muscle over time (.sto), 0 to 1, linear between its samples");
  command.add_option("--excite", o.excite,
                     "Instead: MUSCLE=LEVEL, or LEVEL@START (a step), or LEVEL@START+DURATION (a burst); may be "
                     "repeated; 'all' is every muscle");
  command.add_option("--rest", o.rest, "Excitation where --excite says nothing (default 0.01)");
  command.add_option("--tendon", o.tendon, "rigid, equilibrium (default) or mass (the source paper's muscle mass)")
      ->check(one_of(program::tendon_names()));
  command
      .add_option("--curves", o.curves,
                  "file (default for .osim), paper (default for arm4), thelen, de_groote, millard")
      ->check(one_of(program::curve_names()));
  command
      .add_option("--activation", o.activation,
                  "two_lags (default for arm4), thelen (default for .osim), de_groote, recursive, envelope")
      ->check(one_of(program::activation_names()));
}

/// Adds the start of the movement, its constraints and loads.
void add_movement_options(CLI::App& command, program::SimulateOptions& o) {
  command.add_option("--initial", o.initial,
                     "COORDINATE=VALUE at the start [deg, m]; may be repeated (default: the model's default posture)");
  command.add_option("--initial-speed", o.initial_speed, "COORDINATE=SPEED at the start [deg/s, m/s]");
  command.add_option("--lock", o.lock, "Coordinate that does not move; may be repeated");
  command.add_flag("--horizontal", o.horizontal, "arm4 without gravity");
  command.add_option("--held-mass", o.held_mass_kg, "Mass held in the hand [kg] (default 0)");
  command.add_option("--held-body", o.held_body, "Body of the model that holds it");
  command.add_option("--held-at", o.held_at_m, "Where on that body, x y z [m]")->expected(3);
}

/// Adds the samples and the further results.
void add_output_options(CLI::App& command, program::SimulateOptions& o) {
  command.add_option("--rate", o.rate_hz, "Samples of the results [Hz] (default 200)");
  command.add_option("--tolerance", o.tolerance, "Relative local error of the integration (default 1e-8)");
  command.add_flag("--energy", o.energy, "Also the work of every element, and whether it adds up");
  command.add_option(
      "--sensitivity", o.sensitivity,
      "Also the derivatives by this parameter of the model, such as BIC.max_isometric_force, 'BIC.*' or '*'; "
      "may be repeated");
  command.add_flag("--figures", o.figures, "Also a figure of the movement (.svg, .csv)");
}

}  // namespace

void add_simulate(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("simulate",
                          "Forward dynamics: excitations of the muscles to motion, forces and lengths.\n"
                          "Example: myoid simulate --model arm4 --excite BIC=0.1@0.2+0.3 --end 2 --out sim");
  const auto out = std::make_shared<std::string>();
  const auto paper_figures_only = std::make_shared<bool>(false);
  const auto o = std::make_shared<program::SimulateOptions>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4 (default)");
  command.add_option("--out", *out, "Folder for the results")->required();
  add_muscle_options(command, *o);
  add_movement_options(command, *o);
  add_output_options(command, *o);
  command.add_flag("--paper-figures", *paper_figures_only,
                   "Only the source paper's figures 2 and 4, drawn by this program");
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o, out, paper_figures_only] {
    if (*paper_figures_only) return draw_paper_figures(*out, context);
    context.prepare_folder(*out);
    protect_files(*out, program::kSimulateFiles, {o->model, o->excitations});
    o->call = context.call();
    const program::SimulateResult result = program::simulate(*o);
    context.end_progress();
    program::write_simulate(result, *out);
    if (!result.finished()) context.exit_code = kQualityGateFailed;
    if (context.json) {
      say_whole(results::simulation_json(result.simulation, result.provenance));
    } else {
      say("{}\n", *out);
    }
  });
}

}  // namespace myoid::program
