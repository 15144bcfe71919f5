#include "myoid/commands/identify.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/cli/context.h"
#include "myoid/intervals/estimate_remarks.h"
#include "myoid/intervals/score.h"
#include "myoid/methods/noise_free.h"
#include "myoid/report/report.h"

namespace myoid::cli {
namespace {

using identification::StudyData;
using identification::TrialData;

void print_result(const identification::IdentificationResult& result, bool freed_speeds) {
  fmt::print("{:<10} {:<36} {:<12} {:>14} {:>26}  {}\n", "muscle", "parameter", "branch",
             "estimate", "95 % interval", "verdict");
  for (const auto& e : result.estimates) {
    const std::string parameter = fmt::format("{} [{}]", e.parameter, symbol(e.unit));
    fmt::print("{:<10} {:<36} {:<12} {:>14} {:>26}  {}: {}\n", e.muscle, parameter, e.fit_case,
               std::isfinite(e.estimate) ? report::format_value(e.estimate, 6) : "-",
               e.ci_low && e.ci_high ? fmt::format("[{}, {}]", report::format_value(*e.ci_low, 4),
                                                   report::format_value(*e.ci_high, 4))
                                     : "-",
               identification::name(e.verdict), e.reason);
  }
  if (result.method == "paper")
    fmt::print(
        "Method paper holds F_max and v_max at muscles.csv: an error in them goes into every other "
        "number.\n");
  if (freed_speeds)
    fmt::print(
        "max_shortening_speed is not stated as known: it is free, and concentric_curvature carries "
        "what is not known of it. Where it is known: max_shortening_speed_fixed = true.\n");
  const std::string lag = identification::lag_remark(result);
  if (!lag.empty()) fmt::print("{}\n", lag);
  if (result.exact) fmt::print("The data are free of noise: fitted as they are, without priors.\n");
  for (const std::string& text : result.diagnoses) fmt::print("signature: {}\n", text);
  for (const std::string& text : result.undetermined)
    fmt::print("left open by the data: {}\n", text);
  for (const identification::BranchTest& test : result.branch_tests) {
    fmt::print(
        "{}: l0 and l_sh of the two branches differ by {:+.4f} and {:+.4f} m (Wald {:.1f}, p = "
        "{:.3f})\n",
        test.muscle, test.length_difference_m, test.width_difference_m, test.wald, test.p_value);
  }
}

/// How many samples the fit took.
void print_samples(const identification::IdentificationResult& result,
                   const StudyData& data,
                   const commands::IdentifyOptions& o) {
  if (o.method == "paper") return;
  Eigen::Index all = 0;
  for (const TrialData& trial : data.trials) all += trial.time_s.size();
  all *= static_cast<Eigen::Index>(o.method == "force" ? data.muscles.size()
                                                       : joint_count(data.trials.front()));
  const double rate_hz =
      result.exact ? std::max(o.max_rate_hz, identification::kNoiseFreeRate_hz) : o.max_rate_hz;
  fmt::print("{} of {} samples are fitted: at most {:g} a second, without the ends of trials{}.\n",
             result.samples_used, all, rate_hz, result.exact ? "" : " (--max-rate)");
}

/// How the fit meets what it was fitted to: torque by trial and joint, or force by trial and
/// muscle.
void print_fit(const identification::IdentificationResult& result,
               const StudyData& data,
               bool torque) {
  fmt::print("\n{:<34}{:>12}{:>8}\n", "fitted", torque ? "RMSE [N m]" : "RMSE [N]", "R2");
  const auto row = [](const std::string& name, double rmse, double r2) {
    fmt::print("{:<34}{:>12.4g}{:>8.3f}\n", name, rmse, r2);
  };
  for (const identification::TrialFit& t : result.trials) {
    if (torque) {
      row(t.joint == "joint" ? t.trial : t.trial + ", " + t.joint, t.score.rmse_nm(), t.score.r2());
      continue;
    }
    const auto trial = std::find_if(data.trials.begin(), data.trials.end(),
                                    [&](const TrialData& d) { return d.name == t.trial; });
    for (std::size_t k = 0; trial != data.trials.end() && k < data.muscles.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const std::vector<Eigen::Index> rows = identification::included_rows(*trial);
      const identification::Score s =
          identification::score(trial->force_n.col(column)(rows), t.force_fit_n.col(column)(rows));
      row(t.trial + ", " + data.muscles[k].name, s.rmse_nm(), s.r2());
    }
  }
  fmt::print("{:<34}{:>12}{:>8.3f}\n",
             result.method == "paper" ? "all, the least" : "all, below the fit's cut-off, least",
             "", result.r2);
}

void print_folds(const std::vector<identification::Fold>& folds,
                 const std::string& why_not,
                 const commands::IdentifyOptions& o) {
  if (!why_not.empty())
    fmt::print("\nNothing was left out of the fit to be predicted: {}.\n", why_not);
  if (folds.empty()) return;
  const bool several = o.method == "force" || o.files.coordinates.size() > 1;
  fmt::print("\n{:<34}{:>12}{:>14}{:>8}{:>10}   {}\n", "left out of the fit, then predicted",
             o.method == "force" ? "RMSE [N]" : "RMSE [N m]", "of range [%]", "R2", "smoothed",
             "starting values, one gain: R2");
  for (const identification::Fold& fold : folds) {
    fmt::print("{:<34}{:>12.4g}{:>14.1f}{:>8.3f}{:>10.3f}   {:.3f}\n",
               several ? fmt::format("{}, {}", fold.trial, fold.joint) : fold.trial,
               fold.identified.rmse_nm(), 100.0 * fold.identified.nrmse_range(),
               fold.identified.r2(), fold.smooth.r2(), fold.literature.r2());
  }
  if (const std::string beyond = identification::beyond_what_was_fitted(folds); !beyond.empty())
    fmt::print("EMG beyond all that was fitted ({}): that prediction extrapolates.\n", beyond);
}

/// Prints the minima that the searches of several starts reached.
void print_basins(const identification::BasinTable& table) {
  constexpr std::size_t kMost = 8;
  fmt::print("{:<22}{:>12}{:>16}{:>12}\n", fmt::format("  basin of {} starts", table.starts),
             "starts", "cost", "distance");
  for (std::size_t i = 0; i < table.basins.size() && i < kMost; ++i) {
    const identification::BasinRow& basin = table.basins[i];
    fmt::print("  {:<20}{:>12}{:>16.6g}{:>12.2g}{}{}\n", i + 1, basin.starts, basin.cost,
               basin.distance,
               basin.converged < basin.starts
                   ? fmt::format("  {} did not converge", basin.starts - basin.converged)
                   : "",
               basin.rival && i > 0 ? "  as good as the best: both are answers" : "");
  }
  if (table.basins.size() > kMost) fmt::print("  and {} more\n", table.basins.size() - kMost);
  if (table.failed > 0) fmt::print("  {:<20}{:>12}\n", "no minimum", table.failed);
}

void print_contest(const commands::NamedContest& named) {
  const identification::SolverContest& c = named.contest;
  if (c.runs.empty()) {
    fmt::print("\nSolvers, {}: nothing to fit\n", named.fit);
    return;
  }
  fmt::print("\nSolvers, {}:\n{:<22}{:>6}{:>16}{:>12}{:>13}{:>10}  {}\n", named.fit, "solver",
             "start", "cost", "distance", "evaluations", "seconds", "ended");
  for (const identification::SolverRun& run : c.runs) {
    fmt::print("{:<22}{:>6}{:>16.6g}{:>12.2g}{:>13}{:>10.3f}  {}\n", run.solver, run.start,
               run.cost, run.distance, run.evaluations, run.seconds, math::name(run.termination));
  }
  fmt::print("Levenberg-Marquardt:\n");
  print_basins(c.basins);
}

void print_identify(const commands::IdentifyResult& result, const commands::IdentifyOptions& o) {
  print_result(result.fit, o.method != "paper" && !result.fit.exact && result.speed_may_be_free);
  print_samples(result.fit, result.data, o);
  print_fit(result.fit, result.data, o.method == "torque");
  print_folds(result.folds, result.why_no_folds, o);
  for (const identification::BasinTable& searches : result.fit.basins) {
    fmt::print("\nSearches, {}:\n", searches.fit);
    print_basins(searches);
  }
  for (const commands::NamedContest& contest : result.contests) print_contest(contest);
}

/// True if the fit did not converge or, with --strict, a parameter is not identifiable.
bool failed(const identification::IdentificationResult& fit,
            const std::string& method,
            bool strict) {
  if (method != "paper" && fit.termination != math::Termination::converged) return true;
  return strict && std::any_of(fit.estimates.begin(), fit.estimates.end(), [](const auto& e) {
           return e.verdict == identification::Verdict::not_identifiable;
         });
}

/// Options that say how the method fits and how sure it is.
void add_fit_options(CLI::App& command, commands::IdentifyOptions& o) {
  command
      .add_option("--delay", o.delay_s,
                  "EMG delay held at this [s] (default: estimated, methods force and torque)")
      ->check(CLI::Range(0.0, 0.3));
  command
      .add_option(
          "--lag", o.lag,
          "How muscles follow their EMG: delay, the activation is the envelope of that time "
          "ago; shared, the delay is the mean of a pure one and the lags of excitation and "
          "activation; automatic, what the data prefer (default automatic for torque, else "
          "delay)")
      ->check(CLI::IsMember({"automatic", "delay", "shared"}));
  command.add_flag("--no-priors", o.no_priors,
                   "Methods force and torque: the data alone, plain least squares");
  command
      .add_option("--free", o.free_more,
                  "Further parameters to identify, of all muscles, channels or the joint: "
                  "emg_shape, length_activation, ...")
      ->delimiter(',');
  command
      .add_option("--residual-cutoff", o.residual_hz,
                  "Both sides of the residual are low-passed here [Hz], methods force and torque; "
                  "0: not at all")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command
      .add_option("--max-rate", o.max_rate_hz,
                  "Samples are thinned to at most this [Hz], methods force and torque, as by "
                  "max_rate_hz of a study; data without noise to 200 Hz")
      ->check(CLI::Range(5.0, 2000.0))
      ->capture_default_str();
  command.add_option("--loss", o.loss, "square, huber or cauchy (default square)")
      ->check(CLI::IsMember({"square", "huber", "cauchy"}));
  command.add_option("--bootstrap", o.bootstrap, "Bootstrap replicates (default 0: none)")
      ->check(CLI::Range(0, 100000));
  command.add_flag("--profile", o.profile, "Profile likelihood of every parameter");
  command.add_flag("--compare-solvers", o.compare_solvers,
                   "Gauss-Newton, Levenberg-Marquardt, simplex and annealing from the same starts");
  command
      .add_option("--starts", o.starts,
                  "Starts of the search: the given one and points spread about it, with a table of "
                  "where they end (default 1; of --compare-solvers 3)")
      ->check(CLI::Range(1, 1000));
  command
      .add_option("--folds", o.folds,
                  "Methods force and torque, what is left out and predicted: trial, block (a fifth "
                  "of every trial) or none")
      ->check(CLI::IsMember({"trial", "block", "none"}))
      ->capture_default_str();
}

}  // namespace

void add_identify(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "identify",
      "Muscle parameters straight from files, where the earlier stages are done elsewhere.\n"
      "Example: myoid identify --muscles muscles.csv --activations a.sto --lengths l.sto "
      "--velocities v.sto\n"
      "                        --moment-arms r.sto --torques id.sto --method torque --out results");
  const auto out = std::make_shared<std::string>();
  const auto o = std::make_shared<commands::IdentifyOptions>();
  command.add_option("--muscles", o->muscles, "muscles.csv: starting values, SI")->required();
  command
      .add_option("--activations", o->files.activations,
                  "Activations 0..1 by muscle (.sto), one file per trial")
      ->required();
  command
      .add_option("--lengths", o->files.lengths,
                  "Musculotendon lengths [m] (fiber lengths where tendon_slack_length is 0), one "
                  "file per trial")
      ->required();
  command.add_option("--velocities", o->files.velocities,
                     "Their rates [m/s], lengthening positive (default: by a spline through the "
                     "lengths)");
  command.add_option("--forces", o->files.forces,
                     "Muscle forces [N], for --method paper and force");
  command.add_option("--moment-arms", o->files.moment_arms,
                     "Moment arms [m] by muscle, for --method torque");
  command.add_option("--torques", o->files.torques,
                     "Joint torque of the muscles [N m], for --method torque");
  command.add_option("--motion", o->files.motions,
                     "Joint angles (.mot, .sto), one file per trial, for --free joint_viscosity, "
                     "joint_inertia, joint_stiffness");
  command
      .add_option("--lowpass", o->motion_cutoff_hz,
                  "Smooth the angles of --motion, -3 dB at this frequency [Hz] (default: not "
                  "smoothed)")
      ->check(above_zero());
  command.add_option("--coordinate", o->files.coordinates,
                     "Columns of the torque file, where it has several; with more than one, "
                     "--moment-arms has a file for each, trial by trial");
  command.add_option("--method", o->method, "paper, force or torque (default torque)")
      ->check(CLI::IsMember({"paper", "force", "torque"}));
  add_fit_options(command, *o);
  command.add_option("--out", *out, "Folder for parameters.csv, parameters.json")->required();
  command.add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
  add_common_options(command, context);
  command.callback([&context, o, out] {
    context.prepare_folder(*out);
    context.protect_inputs(*out, {"parameters.", "fold_parameters.", "solvers."}, {o->muscles});
    o->call = context.call();
    const commands::IdentifyResult result = commands::identify(*o);
    context.end_progress();
    commands::write_identify(result, *out);
    if (context.json) {
      fmt::print("{}", identify_json(result));
    } else {
      print_identify(result, *o);
      fmt::print("{}/parameters.csv\n", *out);
    }
    if (failed(result.fit, o->method, context.strict)) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
