#include "myoid/program/cli/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "myoid/fit/intervals/score.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/result_names.h"
#include "myoid/page/report.h"
#include "myoid/program/cli/command_help.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/results/answer.h"
#include "myoid/results/paper_tables.h"
#include "myoid/results/parameter_files.h"
#include "myoid/results/parameter_tables.h"
#include "myoid/results/voluntary_report.h"

namespace myoid::program {
namespace {

using fit::ParameterEstimate;

void print_method(const fit::IdentificationResult& method, std::size_t muscle_count) {
  const std::vector<results::EstimateLine> lines = results::estimate_lines(method, muscle_count);
  std::size_t owner = 6;
  std::size_t parameter = 9;
  const auto labelled = [](const ParameterEstimate& e) {
    return e.unit == Unit::dimensionless ? e.parameter : fmt::format("{} [{}]", e.parameter, symbol(e.unit));
  };
  for (const results::EstimateLine& line : lines) {
    owner = std::max(owner, in_column(line.owners).size());
    parameter = std::max(parameter, labelled(*line.estimate).size());
  }
  const bool readings = std::ranges::any_of(method.estimates, [](const auto& e) { return e.given_ci_low.has_value(); });
  const auto given = [&](const std::string& text) { return readings ? fmt::format(" {:>24}", text) : std::string(); };
  say("\nmethod {}: {}\n", name(method.method), method.message);
  for (const std::string& text : results::voluntary_sentences(method)) say("greatest voluntary torque of {}\n", text);
  if (readings)
    say("95 % interval: of the person. Given: if geometry and sensors were exact, to compare sessions of the "
        "person.\n");
  say("{:<{}}  {:<{}}  {:<11} {:>10} {:>10} {:>24}{}  {}\n", "muscle", owner, "parameter", parameter, "case", "initial",
      "estimate", "95 % interval", given("given"), "verdict");
  bool nuisances = false;
  for (const results::EstimateLine& line : lines) {
    const ParameterEstimate& e = *line.estimate;
    if (fit::is_nuisance(e) && !nuisances) {
      nuisances = true;
      say("of the electrodes and the joint, free so that the intervals hold their uncertainty:\n");
    }
    const bool interval = e.ci_low && e.ci_high && !results::is_undetermined(e);
    const std::string estimate = !std::isfinite(e.estimate) ? "-"
                                 : interval                 ? page::format_rounded(e.estimate, *e.ci_high - *e.ci_low)
                                                            : page::format_value(e.estimate);
    const std::string ends = interval ? fmt::format("[{}]", page::format_interval(*e.ci_low, *e.ci_high, ", "))
                             : results::is_undetermined(e) ? "not determined"
                                                           : "-";
    const std::string second = interval && e.given_ci_low && e.given_ci_high
                                   ? fmt::format("[{}]", page::format_interval(*e.given_ci_low, *e.given_ci_high, ", "))
                                   : "-";
    say("{:<{}}  {:<{}}  {:<11} {:>10} {:>10} {:>24}{}  {}\n", in_column(line.owners), owner, labelled(e), parameter,
        fit::name(e.fit_case), page::format_value(e.initial), estimate, ends, given(second), fit::name(e.verdict));
  }
}

/// Prints the errors of predicted fiber lengths, a line for each muscle of each trial.
template <typename Scored>
void print_fibers(std::string_view of, const std::vector<Scored>& scored) {
  bool first = true;
  for (const Scored& one : scored) {
    for (const fit::FiberScore& fiber : one.fibers) {
      if (first)
        say("\nfiber lengths predicted for {} beside the measured fascicles\n{:<20} {:<20} {:>10}\n", of, "trial",
            "muscle", "RMS [mm]");
      first = false;
      say("{:<20} {:<20} {:>10.2f}\n", in_column(one.trial), in_column(fiber.muscle), 1e3 * fiber.rms_m());
    }
  }
}

void print_predictions(const run::StudyResult& result) {
  if (!result.folds.empty()) {
    const std::string_view left_out = choice_name(result.source.study.identify.folds);
    const run::PredictedByFolds of = run::predicted_by_folds(result);
    const bool several =
        std::ranges::any_of(result.folds, [&](const fit::Fold& f) { return f.joint != result.folds.front().joint; });
    say("\nleave one {0} out: {1} predicted for a {0} that took no part in the fit (R2 about that {0}'s own mean)\n",
        left_out, of.name);
    say("{:<20} {:>10} {:>8} {:>26} {:>8}\n", left_out, fmt::format("RMSE [{}]", of.unit), "R2",
        "literature x gain: RMSE", "R2");
    for (const fit::Fold& f : result.folds) {
      say("{:<20} {:>10.2f} {:>8} {:>26.2f} {:>8}\n",
          in_column(several ? fmt::format("{}, {}", f.trial, f.joint) : f.trial), f.identified.rmse_nm(),
          fit::r2_text(f.identified.r2()), f.literature.rmse_nm(), fit::r2_text(f.literature.r2()));
    }
    print_fibers("what was left out", result.folds);
  }
  for (const fit::IdentificationResult& method : result.fit.methods) {
    if (method.method != fit::Method::torque) continue;
    print_fibers("all trials by the whole fit", method.trials);
    bool first = true;
    for (const fit::TrialFit& t : method.trials) {
      if (t.calibration) continue;
      if (first) say("\nvalidation trials\n{:<20} {:>10} {:>8}\n", "trial", "RMSE [N m]", "R2");
      first = false;
      say("{:<20} {:>10.2f} {:>8}\n", in_column(t.trial), t.score.rmse_nm(), fit::r2_text(t.score.r2()));
    }
  }
}

void print_next(const run::StudyResult& result) {
  if (!result.next || result.next->plan.empty()) return;
  say("\nnext recording: {} of the {} parameters that it is planned for are identified now, median 95 % interval "
      "+-{:.0f} %\n",
      run::identified_count(result.next->beforehand), result.next->beforehand.size(),
      run::median_half_width(result.next->beforehand));
  for (std::size_t i = 0; i < result.next->plan.size(); ++i) {
    const run::PlannedMovement& m = result.next->plan[i];
    say("{}. {:<58} {:>3} identified, +-{:.0f} %\n", i + 1, m.movement.description(), run::identified_count(m.expected),
        run::median_half_width(m.expected));
  }
}

void print_gates(const std::vector<page::Gate>& gates) {
  say("\nquality gates\n");
  for (const page::Gate& gate : gates) {
    const char* status = gate.status == page::GateStatus::pass   ? "ok"
                         : gate.status == page::GateStatus::warn ? "caution"
                         : gate.status == page::GateStatus::fail ? "FAILED"
                                                                 : "-";
    say("{:<8} {}: {}\n", status, gate.name, gate.value);
    if (gate.status == page::GateStatus::fail) say("{:<8} expected: {}. {}\n", "", gate.threshold, gate.why);
  }
}

void print_table(const page::Table& table) {
  std::vector<std::size_t> width;
  for (const std::string& column : table.columns) width.push_back(std::max<std::size_t>(12, column.size()));
  for (const std::vector<page::Cell>& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], in_column(row[c].text).size());
  }
  say("{}\n", table.title);
  for (std::size_t c = 0; c < table.columns.size(); ++c) say("{:<{}} ", table.columns[c], width[c]);
  say("\n");
  for (const std::vector<page::Cell>& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) say("{:<{}} ", in_column(row[c].text), width[c]);
    say("\n");
  }
}

/// Prints the source paper's tables, without their verdicts' reasons, and the searches.
void print_paper(const run::StudyResult& result, const fit::IdentificationResult& paper) {
  say("\nmethod paper: minima of the published criterion{}\n",
      run::shares_forces(result.source.study) ? ", on forces that nobody measured: no intervals" : "");
  for (const page::Table& table : results::paper_tables(paper)) {
    if (table.id != "published_searches") print_table(table);  // below, as sentences
  }
  for (const fit::PublishedSearch& search : paper.published) say("{}\n", results::published_sentence(search));
  if (!result.fit.contests.empty()) print_table(results::solver_table(result.fit.contests));
  for (const page::Table& table : results::basin_tables(paper)) print_table(table);
}

/// Prints all numbers of the methods with intervals, their predictions, the next movements and the quality gates.
void print_everything(const run::StudyResult& result, const std::vector<page::Gate>& gates) {
  for (const fit::IdentificationResult& method : result.fit.methods) {
    if (method.method != fit::Method::paper) print_method(method, result.fit_input.data.muscles.size());
  }
  print_predictions(result);
  print_next(result);
  print_gates(gates);
}

/// Prints the answer, then method `paper` where it was asked for, by the command or as the study's only one.
void print_answer(const run::StudyResult& result, const std::vector<page::Gate>& gates, bool with_paper) {
  say("{}", results::answer_text(result, gates, std::min(help_width(), results::kAnswerColumns)));
  const fit::IdentificationResult* paper = run::method_of(result.fit, fit::Method::paper);
  if (paper != nullptr && (with_paper || result.fit.methods.size() == 1)) print_paper(result, *paper);
}

/// Warns of failed gates with --json and --quiet, which do not print the gates.
void tell_gates(const std::vector<page::Gate>& gates, const Context& context) {
  if (!context.json && !context.quiet) return;
  for (const page::Gate& g : gates) {
    if (g.status == page::GateStatus::fail) context.warn(fmt::format("quality gate failed: {}: {}", g.name, g.value));
  }
}

}  // namespace

program::RunResult compute_run(Context& context, program::RunOptions options) {
  const auto begin = std::chrono::steady_clock::now();
  context.prepare_folder(options.out, program::kStageFolder);
  protect_files(options.out, run_result_names(), {options.study});
  options.store = std::filesystem::path(options.out) / program::kStageFolder;
  program::RunResult result = program::run(options);
  const auto computed = std::chrono::steady_clock::now();
  program::write_run(result, options.out);
  context.end_progress();
  if (const auto ended = context.stage_ended())
    ended("writes files and page", std::chrono::duration<double>(std::chrono::steady_clock::now() - computed).count());
  context.log(fmt::format("{:.1f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()));
  return result;
}

void say_run(Context& context, const program::RunResult& result, const std::string& out, bool with_paper) {
  tell_gates(result.gates, context);
  if (result.reading_remarks > 0 && !context.verbose)
    context.log(
        fmt::format("{} remarks on how files were read and repaired: run.json, or --verbose", result.reading_remarks));
  const run::StudyResult& study = result.study;
  if (context.json) {
    say_whole(
        results::parameters_json(study.fit.methods, study.folds, result.provenance, results::parameter_context(study)));
  } else {
    print_answer(study, result.gates, with_paper);
    if (context.verbose) print_everything(study, result.gates);
    say("{}report: {}/report.html; with an earlier session: myoid compare EARLIER {}\n", context.verbose ? "\n" : "",
        out, shell_word(out));
  }
  if (result.failed(context.strict)) context.exit_code = kQualityGateFailed;
  if (run::failed_trials(study.trials) > 0) context.exit_code = kSomeTrialsFailed;
}

namespace {

void carry_out(Context& context, const RunOptions& o, const CLI::App& /*command*/) {
  prepare_mat(context, o.mat, {o.study});
  const program::RunResult result = compute_run(context, o);
  write_mat(o.mat, o.out);
  say_run(context, result, o.out, std::ranges::find(o.methods, fit::Method::paper) != o.methods.end());
}

}  // namespace

void add_run(CLI::App& app, Context& context) {
  CLI::App* const command = add_command<RunOptions>(
      app, context, "run",
      "The whole pipeline, from a study's recordings to muscle parameters with their uncertainty.\n"
      "Example: myoid run study.toml --out results",
      {}, carry_out);
  command->add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
}

}  // namespace myoid::program
