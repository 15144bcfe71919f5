#include "myoid/program/steps/muscle.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {
namespace {

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
  for (std::size_t i = 0; i < fit.all.estimates.size(); ++i) {
    const muscle::IsolatedEstimate& e = fit.all.estimates[i];
    const EstimateJudgment& judgment = fit.judgments[i];
    json["estimates"].push_back({{"parameter", e.parameter},
                                 {"start", e.start},
                                 {"estimate", e.value},
                                 {"std_error", e.std_error},
                                 {"ci_low", judgment.low},
                                 {"ci_high", judgment.high},
                                 {"verdict", fit::name(judgment.verdict)},
                                 {"reason", judgment.reason},
                                 {"at_bound", e.at_bound},
                                 {"told", e.told},
                                 {"scatter", e.scatter}});
  }
  for (const LawsComparison& row : fit.laws)
    json["laws"].push_back({{"laws", choice_name(row.laws)},
                            {"predicted_from_the_others", row.predicted},
                            {"worse_by", row.worse_by},
                            {"std_error", row.std_error},
                            {"ties", row.ties}});
  return json;
}

void print_laws(const program::MuscleFit& fit) {
  if (fit.laws.empty()) return;
  say("\n{:<12}{:>12}{:>18}\n", "laws", "predicted", "worse than best");
  for (const LawsComparison& row : fit.laws)
    say("{:<12}{:>12.2f}{:>10.2f} ± {:.2f}{}\n", choice_name(row.laws), 100.0 * row.predicted, 100.0 * row.worse_by,
        100.0 * row.std_error, row.ties && row.worse_by > 0.0 ? "  ties with the best" : "");
}

void print_fit(const MuscleResult& result) {
  const program::MuscleFit& fit = *result.fit;
  say("{}: {} ({} simulated experiments)\n\n", result.name, fit.all.message, fit.all.evaluations);
  say("{:<28}{:>12}{:>12}{:>12}{:>12}  {}\n", "parameter", "start", "estimate", "95 % from", "to", "verdict");
  for (std::size_t i = 0; i < fit.all.estimates.size(); ++i) {
    const muscle::IsolatedEstimate& e = fit.all.estimates[i];
    const EstimateJudgment& judgment = fit.judgments[i];
    const std::string unit = symbol(e.unit).empty() ? "" : fmt::format(" [{}]", symbol(e.unit));
    say("{:<28}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.5g}  {}{}{}{}\n", e.parameter + unit, e.start, e.value, judgment.low,
        judgment.high, fit::name(judgment.verdict), e.at_bound ? ", at its bound" : "",
        e.told ? "" : ", not told by the recordings",
        e.scatter > 0.0 ? fmt::format(", ± {:.0f} % among the recordings", 100.0 * e.scatter) : "");
  }
  if (std::ranges::any_of(fit.all.estimates, &muscle::IsolatedEstimate::at_bound))
    say("the standard errors of the others hold only if the value at the bound is true: the recordings pull beyond "
        "it\n");
  say("\n{:<34}{:>12}{:>12}{:>12}\n", fmt::format("mean absolute error [% of {:.4g} N]", fit.relative_to_n), "start",
      "fitted", "predicted");
  for (const program::RecordingErrors& error : fit.errors)
    say("{:<34}{:>12.2f}{:>12.2f}{:>12}\n", error.recording, 100.0 * error.starting_values, 100.0 * error.fitted,
        std::isfinite(error.predicted) ? fmt::format("{:.2f}", 100.0 * error.predicted) : "-");
  if (fit.errors.size() > 1) say("predicted: with the parameters that the other recordings give\n");
  print_laws(fit);
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

void carry_out(Context& context, const MuscleOptions& o, const CLI::App& /*command*/) {
  if (!o.out.empty()) context.prepare_file(o.out, o.inputs());
  if (!o.fitted.empty()) context.prepare_file(o.fitted, o.inputs());
  const program::MuscleResult result = program::muscle(o);
  context.end_progress();
  if (!o.out.empty()) program::write_muscle(result, o.out);
  if (!o.fitted.empty()) program::write_fitted_muscle(result, o.fitted);
  if (failed(result)) context.exit_code = kQualityGateFailed;
  if (result.simulated && result.simulated->simulated.status != math::OdeStatus::done) return;
  if (context.json) {
    say_whole(json_text(result.fit ? fit_json(result) : simulation_json(result)) + "\n");
    return;
  }
  result.fit ? print_fit(result) : print_simulation(result);
  for (const std::string& path : {o.out, o.fitted})
    if (!path.empty()) say("{}\n", path);
}

}  // namespace

void add_muscle(CLI::App& app, Context& context) {
  add_command<MuscleOptions>(
      app, context, "muscle",
      "One muscle alone: which force does it make under an imposed length?\n"
      "Example: myoid muscle --muscle soleus.toml --length length.sto --excitation 1 --out force.sto",
      {.threads = false, .seed = false}, carry_out);
}

}  // namespace myoid::program
