#include "myoid/commands/identify.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/cli/command_help.h"
#include "myoid/cli/context.h"
#include "myoid/cli/options.h"
#include "myoid/cli/say.h"
#include "myoid/files/output_file.h"
#include "myoid/intervals/score.h"
#include "myoid/methods/plain_fit.h"
#include "myoid/report/report.h"
#include "myoid/results/answer.h"
#include "myoid/results/paper_tables.h"
#include "myoid/results/voluntary_report.h"

namespace myoid::cli {
namespace {

using identification::StudyData;
using identification::TrialData;

void print_result(const identification::IdentificationResult& result, bool freed_speeds) {
  for (const std::string& text : voluntary_sentences(result)) say("greatest voluntary torque of {}\n", text);
  say("{:<10} {:<36} {:<12} {:>14} {:>26}  {}\n", "muscle", "parameter", "branch", "estimate", "95 % interval",
      "verdict");
  for (const auto& e : result.estimates) {
    if (identification::is_voluntary(e.parameter)) continue;
    const std::string parameter = fmt::format("{} [{}]", e.parameter, symbol(e.unit));
    say("{:<10} {:<36} {:<12} {:>14} {:>26}  {}: {}\n", e.muscle, parameter, e.fit_case,
        std::isfinite(e.estimate) ? report::format_value(e.estimate, 6) : "-",
        e.ci_low && e.ci_high
            ? fmt::format("[{}, {}]", report::format_value(*e.ci_low, 4), report::format_value(*e.ci_high, 4))
            : "-",
        identification::name(e.verdict), e.reason);
  }
  if (result.method == identification::Method::paper)
    say("Method paper holds F_max and v_max at muscles.csv: an error in them goes into every other number.\n");
  for (const identification::PublishedSearch& search : result.published) say("{}\n", published_sentence(search));
  if (freed_speeds)
    say("max_shortening_speed is not stated as known: it is free, and its uncertainty widens the interval of "
        "concentric_curvature. Where it is known: max_shortening_speed_fixed = true.\n");
  if (result.exact) say("The data are free of noise: fitted by plain least squares, without priors.\n");
  for (const std::string& text : result.diagnoses) say("signature: {}\n", text);
  for (const std::string& text : result.undetermined) say("left open by the data: {}\n", text);
  for (const identification::BranchTest& test : result.branch_tests) {
    say("{}: l0 and l_sh of the two branches differ by {:+.4f} and {:+.4f} m (Wald {:.1f}, p = {:.3f})\n", test.muscle,
        test.length_difference_m, test.width_difference_m, test.wald, test.p_value);
  }
}

/// Prints the number of fitted samples.
void print_samples(const identification::IdentificationResult& result,
                   const StudyData& data,
                   const commands::IdentifyOptions& o) {
  if (o.method == "paper") return;
  Eigen::Index all = 0;
  for (const TrialData& trial : data.trials) all += trial.time_s.size();
  all *= static_cast<Eigen::Index>(o.method == "force" ? data.muscles.size() : joint_count(data.trials.front()));
  if (!result.exact) {
    say("{} rows of the low-passed {}, one per 0.22 s, stand for {} samples and count as {:.0f} independent ones.\n",
        result.samples_used, o.method, all, result.effective_samples);
    return;
  }
  say("{} of {} samples are fitted: at most {:g} a second, without the ends of trials.\n", result.samples_used, all,
      identification::kNoiseFreeRate_hz);
}

bool any_held_back(const StudyData& data) {
  return std::any_of(data.trials.begin(), data.trials.end(), [](const TrialData& trial) { return !trial.calibration; });
}

/// Prints the errors of the torque by trial and joint, or of the force by trial and muscle, of the trials that are
/// fitted or of those that are held back.
void print_errors(const identification::IdentificationResult& result,
                  const StudyData& data,
                  bool torque,
                  bool fitted,
                  const char* heading) {
  say("\n{:<34}{:>12}{:>10}\n", heading, torque ? "RMSE [N m]" : "RMSE [N]", "R2");
  const auto row = [](const std::string& name, double rmse, double r2) {
    say("{:<34}{:>12.4g}{:>10}\n", name, rmse, identification::r2_text(r2));
  };
  for (const identification::TrialFit& t : result.trials) {
    if (t.calibration != fitted) continue;
    if (torque) {
      row(t.joint == "joint" ? t.trial : t.trial + ", " + t.joint, t.score.rmse_nm(), t.score.r2());
      continue;
    }
    const auto trial = std::ranges::find_if(data.trials, [&](const TrialData& d) { return d.name == t.trial; });
    for (std::size_t k = 0; trial != data.trials.end() && k < data.muscles.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const std::vector<Eigen::Index> rows = identification::included_rows(*trial);
      const identification::Score s =
          identification::score(trial->force_n.col(column)(rows), t.force_fit_n.col(column)(rows));
      row(t.trial + ", " + data.muscles[k].name, s.rmse_nm(), s.r2());
    }
  }
}

void print_fit(const identification::IdentificationResult& result, const StudyData& data, bool torque) {
  print_errors(result, data, torque, true, "fitted");
  say("{:<34}{:>12}{:>10}\n",
      result.method == identification::Method::paper ? "all, the least" : "all, below the fit's cut-off, least", "",
      identification::r2_text(result.r2));
  if (any_held_back(data)) print_errors(result, data, torque, false, "held back, then predicted");
}

void print_folds(const std::vector<identification::Fold>& folds,
                 const std::string& why_not,
                 bool held_back,
                 const commands::IdentifyOptions& o) {
  if (!why_not.empty())
    say("\n{} was left out of the fit to be predicted: {}.\n", held_back ? "No other trial" : "Nothing", why_not);
  if (folds.empty()) return;
  const bool several = o.method == "force" || o.files.coordinates.size() > 1;
  say("\n{:<34}{:>12}{:>14}{:>10}   {}\n", "left out of the fit, then predicted",
      o.method == "force" ? "RMSE [N]" : "RMSE [N m]", "of range [%]", "R2", "starting values, one gain: R2");
  for (const identification::Fold& fold : folds) {
    say("{:<34}{:>12.4g}{:>14.1f}{:>10}   {}\n", several ? fmt::format("{}, {}", fold.trial, fold.joint) : fold.trial,
        fold.identified.rmse_nm(), 100.0 * fold.identified.nrmse_range(), identification::r2_text(fold.identified.r2()),
        identification::r2_text(fold.literature.r2()));
  }
  if (const std::string beyond = identification::beyond_what_was_fitted(folds); !beyond.empty())
    say("EMG beyond all that was fitted ({}): that prediction extrapolates.\n", beyond);
}

/// Prints the minima that the searches of several starts reached.
void print_basins(const identification::BasinTable& table) {
  constexpr std::size_t kMost = 8;
  say("{:<22}{:>12}{:>16}{:>12}\n", fmt::format("  basin of {} starts", table.starts), "starts", "cost", "distance");
  for (std::size_t i = 0; i < table.basins.size() && i < kMost; ++i) {
    const identification::BasinRow& basin = table.basins[i];
    say("  {:<20}{:>12}{:>16.6g}{:>12.2g}{}{}\n", i + 1, basin.starts, basin.cost, basin.distance,
        basin.converged < basin.starts ? fmt::format("  {} did not converge", basin.starts - basin.converged) : "",
        basin.rival && i > 0 ? "  as good as the best: both are answers" : "");
  }
  if (table.basins.size() > kMost) say("  and {} more\n", table.basins.size() - kMost);
  if (table.failed > 0) say("  {:<20}{:>12}\n", "no minimum", table.failed);
}

void print_contest(const identification::NamedContest& named) {
  const identification::SolverContest& c = named.contest;
  if (c.runs.empty()) {
    say("\nSolvers, {}: nothing to fit\n", named.fit);
    return;
  }
  say("\nSolvers, {}:\n{:<22}{:>6}{:>16}{:>12}{:>13}{:>10}  {}\n", named.fit, "solver", "start", "cost", "distance",
      "evaluations", "seconds", "ended");
  for (const identification::SolverRun& run : c.runs) {
    say("{:<22}{:>6}{:>16.6g}{:>12.2g}{:>13}{:>10.3f}  {}\n", run.solver, run.start, run.cost, run.distance,
        run.evaluations, run.seconds, math::name(run.termination));
  }
  say("Levenberg-Marquardt:\n");
  print_basins(c.basins);
}

/// Prints the answer; with `all`, and for the numbers of method `paper`, which have no intervals, everything.
void print_identify(const commands::IdentifyResult& result, const commands::IdentifyOptions& o, bool all) {
  const bool torque = o.method == "torque";
  if (o.method != "paper")
    say("{}", fit_answer_text(result.fit, torque ? result.folds : std::vector<identification::Fold>(), o.folds,
                              result.data.muscles.size(), std::min(help_width(), kAnswerColumns)));
  if (!all && o.method != "paper") return;
  print_result(result.fit, o.method != "paper" && !result.fit.exact && result.speed_may_be_free);
  print_samples(result.fit, result.data, o);
  print_fit(result.fit, result.data, o.method == "torque");
  print_folds(result.folds, result.why_no_folds, any_held_back(result.data), o);
  for (const identification::BasinTable& searches : result.fit.basins) {
    say("\nSearches, {}:\n", searches.fit);
    print_basins(searches);
  }
  for (const identification::NamedContest& contest : result.contests) print_contest(contest);
}

/// Returns true if the fit did not converge or, with --strict, a parameter is not identifiable.
bool failed(const identification::IdentificationResult& fit, const std::string& method, bool strict) {
  if (method != "paper" && fit.termination != math::Termination::converged) return true;
  return strict && std::ranges::any_of(fit.estimates, [](const auto& e) {
           return e.verdict == identification::Verdict::not_identifiable;
         });
}

}  // namespace

void add_identify(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "identify",
      "Muscle parameters straight from files, where the earlier stages are done elsewhere.\n"
      "Example: myoid identify --muscles muscles.csv --activations a.sto --lengths l.sto --velocities v.sto\n"
      "                        --moment-arms r.sto --torques id.sto --method torque --out results");
  commands::IdentifyOptions defaults;
  OptionDeclarer declarer(command);
  visit(defaults, declarer);
  for (const char* option : {"--free", "--hold"}) command.get_option(option)->delimiter(',');
  const auto out = std::make_shared<std::string>();
  command.add_option("--out", *out, "Folder for parameters.csv, parameters.json")->required();
  const MatOption mat(command);
  command.add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
  add_common_options(command, context);
  command.callback([&context, &command, out, mat] {
    commands::IdentifyOptions o;
    OptionReader reader(command);
    visit(o, reader);
    mat.prepare(context, {o.muscles.string()});
    context.prepare_folder(*out);
    recording::protect_files(*out, commands::kIdentifyFiles, {o.muscles.string()});
    o.call = context.call();
    const commands::IdentifyResult result = commands::identify(o);
    context.end_progress();
    commands::write_identify(result, *out);
    mat.write(*out);
    if (context.json) {
      say_whole(identify_json(result));
    } else {
      print_identify(result, o, context.verbose);
      say("{0}/parameters.csv{1}\nreport: myoid run {0}/study.toml --out FOLDER\n", *out,
          context.verbose || o.method == "paper" ? "" : "; all numbers and errors: --verbose");
    }
    if (failed(result.fit, o.method, context.strict)) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
