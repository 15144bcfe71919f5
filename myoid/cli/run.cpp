#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/color.h>
#include <fmt/format.h>
#include <unistd.h>

#include "myoid/cli/context.h"
#include "myoid/core/error.h"
#include "myoid/pipeline/result_files.h"
#include "myoid/pipeline/run_study.h"
#include "myoid/pipeline/study_json.h"
#include "myoid/pipeline/study_report.h"
#include "myoid/report/report.h"

namespace myoid::cli {
namespace {

using identification::ParameterEstimate;
using identification::Verdict;

/// In --out: what an interrupted or repeated run need not compute again.
constexpr const char* kStageFolder = ".stages";

/// The table on stdout: what was found, how sure, and whether to believe it.
void print_table(const pipeline::StudyResult& result) {
  for (const identification::IdentificationResult& method : result.methods) {
    fmt::print("\nmethod {}: {}\n", method.method, method.message);
    fmt::print("{:<8} {:<28} {:<12} {:>11} {:>11} {:>25}  {}\n", "muscle", "parameter", "case",
               "initial", "estimate", "95 % interval", "verdict");
    for (const ParameterEstimate& e : method.estimates) {
      const std::string interval = e.ci_low && e.ci_high
                                       ? fmt::format("[{}, {}]", report::format_value(*e.ci_low),
                                                     report::format_value(*e.ci_high))
                                       : "-";
      const std::string unit =
          e.unit == Unit::dimensionless ? "" : fmt::format(" {}", symbol(e.unit));
      fmt::print("{:<8} {:<28} {:<12} {:>11} {:>11} {:>25}  {}\n", e.muscle,
                 e.parameter + (unit.empty() ? "" : " [" + unit.substr(1) + "]"), e.fit_case,
                 report::format_value(e.initial),
                 std::isfinite(e.estimate) ? report::format_value(e.estimate) : "-", interval,
                 identification::name(e.verdict));
    }
  }
  if (!result.folds.empty()) {
    fmt::print(
        "\nleave one trial out: torque predicted for a trial that took no part in the fit\n");
    fmt::print("{:<20} {:>10} {:>8} {:>26} {:>8}\n", "trial", "RMSE [N m]", "R2",
               "literature x gain: RMSE", "R2");
    for (const identification::Fold& f : result.folds) {
      fmt::print("{:<20} {:>10.2f} {:>8.3f} {:>26.2f} {:>8.3f}\n", f.trial, f.identified.rmse_nm,
                 f.identified.r2, f.literature.rmse_nm, f.literature.r2);
    }
  }
}

}  // namespace

void add_run(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "run",
      "The whole pipeline, from a study's recordings to muscle parameters with their uncertainty.\n"
      "Example: myoid run study.toml --out results");
  struct Options {
    std::string study;
    std::string out;
  };
  const auto options = std::make_shared<Options>();
  command.add_option("study", options->study, "study.toml")->required();
  command.add_option("--out", options->out, "Folder for everything that comes out")->required();
  command.add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
  add_common_options(command, context);
  command.callback([&context, options] {
    const auto begin = std::chrono::steady_clock::now();
    const pipeline::Study study = pipeline::read_study(options->study);
    context.prepare_folder(options->out, kStageFolder);
    const pipeline::StudyResult result =
        pipeline::run_study(study, {.progress = context.progress(),
                                    .store = std::filesystem::path(options->out) / kStageFolder});
    Provenance provenance;
    provenance.command = context.command_line;
    provenance.inputs = result.inputs;
    provenance.options_json = pipeline::study_json(study);
    pipeline::write_results(result, provenance, options->out);
    report::write_report(pipeline::study_report(result, provenance), options->out);
    context.end_progress();
    const auto reused = std::count_if(result.trials.begin(), result.trials.end(),
                                      [](const auto& trial) { return trial.ik_reused; });
    if (reused > 0)
      context.log(
          fmt::format("inverse kinematics of {} trials reused: same input as before", reused));
    for (const pipeline::TrialResult& trial : result.trials) {
      if (!trial.failure.empty())
        context.warn(fmt::format("trial {}: {}", trial.spec.name, trial.failure));
      for (const std::string& note : trial.notes) {
        if (context.verbose) context.log(fmt::format("{}: {}", trial.spec.name, note));
      }
    }
    if (context.json) {
      fmt::print("{}", pipeline::parameters_json(result.methods, result.folds, provenance));
    } else {
      print_table(result);
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      context.log(fmt::format("\n{:.1f} s", seconds));
      fmt::print("\nreport: {}/report.html\n", options->out);
    }
    bool gate = false;
    for (const identification::IdentificationResult& method : result.methods) {
      if (method.method != "torque") continue;
      gate = gate || method.termination != math::Termination::converged;
      for (const ParameterEstimate& e : method.estimates)
        gate = gate || (context.strict && e.verdict == Verdict::not_identifiable);
    }
    if (gate) context.exit_code = kQualityGateFailed;
    if (result.failed_trials > 0) context.exit_code = kSomeTrialsFailed;
  });
}

}  // namespace myoid::cli
