#include "myoid/program/cli/run.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include <fmt/format.h>

#include "myoid/ground/files/output_file.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/result_names.h"
#include "myoid/page/report.h"
#include "myoid/page/tables.h"
#include "myoid/program/cli/command_help.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/results/answer.h"
#include "myoid/results/paper_tables.h"
#include "myoid/results/parameter_files.h"
#include "myoid/results/study_report.h"

namespace myoid::program {
namespace {

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

void print_tables(const page::Section& section) {
  say("\n{}\n", section.heading);
  for (const page::Table& table : section.tables) say("\n{}", page::table_text(table));
}

/// Prints how the searches ended, the tables of the report's page and the quality gates.
void print_everything(const run::StudyResult& result, const Provenance& provenance) {
  for (const fit::IdentificationResult& method : result.fit.methods)
    if (!method.message.empty() && method.method != fit::Method::paper)
      say("\nmethod {}: {}\n", name(method.method), method.message);
  const page::Report report = results::study_report(result, provenance);
  for (const page::Section& section : report.sections)
    if (!section.tables.empty() && section.id != "methods") print_tables(section);
  print_gates(report.gates);
}

/// Returns true if the study's only method is `paper`, or if it is one of them and was asked for.
bool shows_paper(const run::StudyFit& fit, bool asked_for) {
  return run::method_of(fit, fit::Method::paper) != nullptr && (asked_for || fit.methods.size() == 1);
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
    say("{}", results::answer_text(study, result.gates, std::min(help_width(), results::kAnswerColumns)));
    if (context.verbose)
      print_everything(study, result.provenance);
    else if (shows_paper(study.fit, with_paper))
      print_tables(results::paper_section(study.fit, run::shares_forces(study.source.study)));
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
