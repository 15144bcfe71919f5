#include "myoid/program/commands/muscle.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {
namespace {

using program::MuscleResult;

bool failed(const MuscleResult& result) {
  if (result.fit) return !result.fit->converged || result.fit->misses;
  return result.simulated->simulated.status != math::OdeStatus::done;
}

nlohmann::json fit_json(const MuscleResult& result) {
  const program::MuscleFit& fit = *result.fit;
  nlohmann::json errors = nlohmann::json::array();
  for (const program::RecordingErrors& error : fit.errors)
    errors.push_back({{"recording", error.recording},
                      {"starting_values", error.starting_values},
                      {"fitted", error.fitted},
                      {"predicted_from_the_others", error.predicted}});
  nlohmann::json json{
      {"muscle", result.name}, {"converged", fit.converged}, {"moved", fit.all.moved}, {"errors", errors}};
  for (const muscle::IsolatedEstimate& e : fit.all.estimates)
    json["estimates"].push_back({{"parameter", e.parameter},
                                 {"start", e.start},
                                 {"estimate", e.value},
                                 {"std_error", e.std_error},
                                 {"at_bound", e.at_bound},
                                 {"told", e.told}});
  return json;
}

void print_fit(const MuscleResult& result) {
  const program::MuscleFit& fit = *result.fit;
  say("{}: {} ({} simulated experiments)\n\n", result.name, fit.all.message, fit.all.evaluations);
  say("{:<28}{:>14}{:>14}{:>14}\n", "parameter", "start", "estimate", "std error");
  for (const muscle::IsolatedEstimate& e : fit.all.estimates)
    say("{:<28}{:>14.6g}{:>14.6g}{:>14} {}{}{}\n", e.parameter, e.start, e.value,
        e.told ? fmt::format("{:.2g}", e.std_error) : "-", symbol(e.unit), e.at_bound ? ", at its bound" : "",
        e.told ? "" : ", not told by the recordings");
  if (std::ranges::any_of(fit.all.estimates, &muscle::IsolatedEstimate::at_bound))
    say("the standard errors of the others hold only if the value at the bound is true: the recordings pull beyond "
        "it\n");
  say("\n{:<34}{:>12}{:>12}{:>12}\n", fmt::format("mean absolute error [% of {:.4g} N]", fit.relative_to_n), "start",
      "fitted", "predicted");
  for (const program::RecordingErrors& error : fit.errors)
    say("{:<34}{:>12.2f}{:>12.2f}{:>12.2f}\n", error.recording, 100.0 * error.starting_values, 100.0 * error.fitted,
        100.0 * error.predicted);
  if (fit.errors.size() > 1) say("predicted: with the parameters that the other recordings give\n");
}

nlohmann::json simulation_json(const MuscleResult& result) {
  const Eigen::VectorXd force = result.simulated->simulated.series.column("tendon_force");
  nlohmann::json json{{"muscle", result.name},
                      {"samples", force.size()},
                      {"least_force_n", force.minCoeff()},
                      {"greatest_force_n", force.maxCoeff()}};
  if (const auto& comparison = result.simulated->comparison) {
    json["mean_absolute_error_n"] = comparison->error_n;
    json["mean_absolute_error"] = comparison->share;
  }
  return json;
}

void print_simulation(const MuscleResult& result) {
  const Eigen::VectorXd force = result.simulated->simulated.series.column("tendon_force");
  say("{}: {} samples, force {:.4g} to {:.4g} N\n", result.name, force.size(), force.minCoeff(), force.maxCoeff());
  if (const auto& comparison = result.simulated->comparison) {
    say("mean absolute error {:.4g} N, {:.2f} % of {:.4g} N, over {} samples\n", comparison->error_n,
        100.0 * comparison->share, comparison->error_n / comparison->share, comparison->samples);
  }
}

}  // namespace

void add_muscle(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "muscle",
      "One muscle alone: which force does it make under an imposed length?\n"
      "Example: myoid muscle --muscle soleus.toml --length length.sto --excitation 1 --out force.sto");
  const auto o = std::make_shared<program::MuscleOptions>();
  command.add_option("--muscle", o->muscle, "The muscle (.toml)")->required();
  command.add_option("--length", o->lengths, "Length of fiber and tendon together over time [m] (.sto, .mot, .csv)")
      ->required();
  command.add_option("--column", o->column, "Which column of it (default: the only one)");
  command.add_option("--scale", o->scales, "Its numbers times this ... (default 1); with several files one for each");
  command.add_option("--offset", o->offset_m, "... plus this are the length [m] (default 0)");
  command.add_option("--activation", o->activation,
                     "Activation, a number in 0..1 or a file; with several --length one, or one for each");
  command.add_option("--excitation", o->excitation,
                     "Excitation, a number in 0..1 or a file; with several --length one, or one for each");
  command.add_option("--drive-column", o->drive_column, "Which column of these files (default: the only one)");
  command.add_option("--initial-activation", o->initial_activation,
                     "Activation at the start, with --excitation: a number, or `settled` on the first excitation "
                     "(default 0.01: at rest)");
  command.add_option("--measured", o->measured, "Measured force over time [N], to compare");
  command.add_option("--measured-column", o->measured_column, "Which column of it (default: the only one)");
  command
      .add_option("--fit", o->fit,
                  "Parameters to identify from one or several --length and --measured, by comma: "
                  "max_isometric_force,tendon_strain,...; each recording is also predicted from the others")
      ->delimiter(',');
  command.add_option("--isometric-force", o->isometric_n,
                     "Force that the error is related to [N] (default: F_max of the muscle)");
  command.add_option("--tolerance", o->tolerance, "Relative, of the integration (default 1e-9)")
      ->check(between(1e-13, 1e-3));
  const auto out = std::make_shared<std::string>();
  command.add_option("--out", *out,
                     "Forces, lengths, velocities, activation over time (.sto); with --fit the parameters (.csv)");
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&context, o, out] {
    if (!out->empty()) {
      std::vector<std::string> inputs{o->muscle};
      for (const auto* files : {&o->lengths, &o->activation, &o->excitation, &o->measured})
        inputs.insert(inputs.end(), files->begin(), files->end());
      context.prepare_file(*out, inputs);
    }
    o->call = context.call();
    const program::MuscleResult result = program::muscle(*o);
    context.end_progress();
    if (!out->empty()) program::write_muscle(result, *out);
    if (failed(result)) context.exit_code = kQualityGateFailed;
    if (result.simulated && result.simulated->simulated.status != math::OdeStatus::done) return;
    if (context.json) {
      say_whole(json_text(result.fit ? fit_json(result) : simulation_json(result)) + "\n");
      return;
    }
    result.fit ? print_fit(result) : print_simulation(result);
    if (!out->empty()) say("{}\n", *out);
  });
}

}  // namespace myoid::program
