#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/cli/context.h"
#include "myoid/cli/solver_contests.h"
#include "myoid/core/error.h"
#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"
#include "myoid/identification/estimator_settings.h"
#include "myoid/identification/parameters.h"
#include "myoid/identify_files/identify_data.h"
#include "myoid/identify_files/muscles_csv.h"
#include "myoid/intervals/estimate_remarks.h"
#include "myoid/intervals/score.h"
#include "myoid/methods/basins.h"
#include "myoid/methods/cross_validation.h"
#include "myoid/methods/force.h"
#include "myoid/methods/noise_free.h"
#include "myoid/methods/paper.h"
#include "myoid/methods/torque.h"
#include "myoid/report/report.h"
#include "myoid/results/parameter_files.h"

namespace myoid::cli {
namespace {

using identification::StudyData;
using identification::TrialData;

struct IdentifyOptions {
  std::string muscles, out, method = "torque";
  IdentifySources files;
  std::optional<double> delay_s;
  bool no_priors = false;
  bool compare = false;
  int bootstrap = 0;
  bool profile = false;
  std::string loss = "square";
  std::string folds = "trial";
  std::string lag;  ///< Empty: not given.
  int starts = 0;   ///< 0: not given.
  double residual_hz = identification::EstimatorOptions{}.residual_cutoff_hz.value_or(0.0);
  double max_rate_hz = identification::EstimatorOptions{}.max_rate_hz;
  std::vector<std::string> free_more;
  double motion_cutoff_hz = 0.0;
};

constexpr int kStartsToCompare = 3;

bool is_free(const StudyData& data, bool (*about)(const identification::ParameterRule&)) {
  return std::any_of(data.rules.begin(), data.rules.end(),
                     [&](const auto& rule) { return rule.free.value_or(false) && about(rule); });
}

/// Of the joint, acting by its motion.
bool is_about_motion(const identification::ParameterRule& rule) {
  const identification::ParameterField& field = identification::parameter_field(rule.parameter);
  return field.scope == identification::Scope::joint && field.field != identification::kOffset;
}

bool is_about_lags(const identification::ParameterRule& rule) {
  return identification::is_lag(rule.parameter);
}

/// What is asked for and the method or the files cannot give.
void refuse_what_cannot_be(const IdentifyOptions& o, const MuscleTable& table) {
  std::vector<std::string> asked;
  if (o.delay_s) asked.emplace_back("--delay");
  if (o.loss != "square") asked.emplace_back("--loss");
  if (o.bootstrap > 0) asked.emplace_back("--bootstrap");
  if (o.profile) asked.emplace_back("--profile");
  if (o.folds == "block") asked.emplace_back("--folds block");
  if (!o.lag.empty()) asked.push_back("--lag " + o.lag);
  for (const std::string& name : o.free_more) asked.push_back("--free " + name);
  for (const identification::ParameterRule& rule : table.rules)
    asked.push_back(fmt::format("{}_fixed = false in {}", rule.parameter, o.muscles));
  if (o.method == "paper" && !asked.empty()) {
    throw InvalidInput(
        fmt::format("{}: the published method has none of it; leave it out, or use --method force, "
                    "which fits the same forces",
                    fmt::join(asked, ", ")));
  }
  if (o.method == "force" && o.lag == "automatic") {
    throw InvalidInput(
        "--lag automatic: method force fits each muscle alone, and all follow their EMG alike; "
        "give "
        "--lag delay or shared, or use --method torque");
  }
  // Samples hold what lies well below half of their rate.
  if (o.method != "paper" && o.residual_hz >= 0.45 * o.max_rate_hz)
    throw InvalidInput(fmt::format(
        "--residual-cutoff {0}: samples are thinned to {1} Hz, which holds less than {2:.3g} Hz; "
        "give --max-rate {3:.0f}, or --residual-cutoff 0 for no low-pass",
        o.residual_hz, o.max_rate_hz, 0.45 * o.max_rate_hz, std::ceil(o.residual_hz / 0.4)));
  if (o.motion_cutoff_hz > 0.0 && o.files.motions.empty())
    throw InvalidInput("--lowpass smooths the angles of --motion, which is not given");
  for (const std::string& name : o.free_more) {
    const identification::ParameterField& field = identification::parameter_field(name);
    if (field.scope != identification::Scope::joint) continue;
    if (o.method != "torque")
      throw InvalidInput(fmt::format("--free {}: it is the joint's; use --method torque", name));
    if (field.field != identification::kOffset && o.files.motions.empty())
      throw InvalidInput(fmt::format(
          "--free {}: it acts by the joint's motion; give its angles with --motion, one "
          "file per trial",
          name));
  }
}

/// What was given and changes nothing.
std::vector<std::string> without_effect(const IdentifyOptions& o) {
  std::vector<std::string> found;
  const auto tell = [&](bool given, std::string_view option, std::string_view why) {
    if (given) found.push_back(fmt::format("{} has no effect: {}", option, why));
  };
  const bool paper = o.method == "paper", torque = o.method == "torque";
  tell(paper && o.no_priors, "--no-priors", "the published method has no priors");
  tell(paper && o.residual_hz != IdentifyOptions{}.residual_hz, "--residual-cutoff",
       "the published method fits the forces as they are");
  tell(paper && o.max_rate_hz != IdentifyOptions{}.max_rate_hz, "--max-rate",
       "the published method fits every sample");
  constexpr std::string_view kForces = "methods paper and force fit muscle forces (--forces)";
  tell(!torque && !o.files.torques.empty(), "--torques", kForces);
  tell(!torque && !o.files.moment_arms.empty(), "--moment-arms", kForces);
  tell(torque && !o.files.forces.empty(), "--forces",
       "method torque fits joint torques (--torques)");
  return found;
}

identification::EstimatorSettings estimator_settings(const IdentifyOptions& o, std::uint64_t seed) {
  identification::EstimatorSettings settings;
  settings.priors = !o.no_priors;
  if (!o.lag.empty()) settings.lag = identification::parse_lag(o.lag);
  settings.max_rate_hz = o.max_rate_hz;
  settings.delay_s = o.delay_s;
  settings.residual_cutoff_hz.reset();
  if (o.residual_hz > 0.0) settings.residual_cutoff_hz = o.residual_hz;
  settings.loss = identification::parse_loss(o.loss);
  settings.starts = o.starts;
  settings.intervals = {.bootstrap = o.bootstrap, .profile = o.profile, .seed = seed};
  return settings;
}

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
                   const IdentifyOptions& o) {
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
                 const IdentifyOptions& o) {
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

/// The data for all that follows the fit, with the v_max free that the fit had free.
void free_what_is_free(const identification::IdentificationResult& result,
                       const MuscleTable& table,
                       StudyData& data) {
  const bool found =
      std::any_of(result.estimates.begin(), result.estimates.end(),
                  [](const auto& e) { return e.parameter == "max_shortening_speed"; });
  if (found) identification::free_speeds(data, table.speed_may_be_free);
}

/// Trials or blocks predicted by the reported fit of the others, `data` being as it was read.
std::vector<identification::Fold> held_out(const IdentifyOptions& o,
                                           const StudyData& data,
                                           const identification::EstimatorOptions& options,
                                           const std::vector<std::string>& speed_may_be_free,
                                           std::string& why_not) {
  const identification::CrossValidationOptions how{.kind = o.folds == "block"
                                                               ? identification::FoldKind::block
                                                               : identification::FoldKind::trial};
  const identification::EstimatorOptions once = identification::of_a_fold(options);
  (void)identification::splits(data, how, &why_not);
  if (o.method == "torque") {
    return identification::cross_validate(
        data,
        [&](StudyData& of_fold) {
          return identification::identify_torque_or_exact(of_fold, once, speed_may_be_free);
        },
        options, how);
  }
  const identification::ForceOptions of_force{
      .estimator = once, .detect_exact = true, .speed_may_be_free = speed_may_be_free};
  std::vector<identification::Fold> folds;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const auto more = identification::cross_validate(
        identification::force_study(data, k),
        [&](StudyData& of_fold) {
          return identification::identify_muscle_force(of_fold, of_force);
        },
        options, how);
    folds.insert(folds.end(), more.begin(), more.end());
  }
  return folds;
}

}  // namespace

void add_identify(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "identify",
      "Muscle parameters straight from files, where the earlier stages are done elsewhere.\n"
      "Example: myoid identify --muscles muscles.csv --activations a.sto --lengths l.sto "
      "--velocities v.sto\n"
      "                        --moment-arms r.sto --torques id.sto --method torque --out results");
  const auto o = std::make_shared<IdentifyOptions>();
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
  command
      .add_option("--delay", o->delay_s,
                  "EMG delay held at this [s] (default: estimated, methods force and torque)")
      ->check(CLI::Range(0.0, 0.3));
  command
      .add_option(
          "--lag", o->lag,
          "How muscles follow their EMG: delay, the activation is the envelope of that time "
          "ago; shared, the delay is the mean of a pure one and the lags of excitation and "
          "activation; automatic, what the data prefer (default automatic for torque, else "
          "delay)")
      ->check(CLI::IsMember({"automatic", "delay", "shared"}));
  command.add_flag("--no-priors", o->no_priors,
                   "Methods force and torque: the data alone, plain least squares");
  command
      .add_option("--free", o->free_more,
                  "Further parameters to identify, of all muscles, channels or the joint: "
                  "emg_shape, length_activation, ...")
      ->delimiter(',');
  command
      .add_option("--residual-cutoff", o->residual_hz,
                  "Both sides of the residual are low-passed here [Hz], methods force and torque; "
                  "0: not at all")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command
      .add_option("--max-rate", o->max_rate_hz,
                  "Samples are thinned to at most this [Hz], methods force and torque, as by "
                  "max_rate_hz of a study; data without noise to 200 Hz")
      ->check(CLI::Range(5.0, 2000.0))
      ->capture_default_str();
  command.add_option("--loss", o->loss, "square, huber or cauchy (default square)")
      ->check(CLI::IsMember({"square", "huber", "cauchy"}));
  command.add_option("--bootstrap", o->bootstrap, "Bootstrap replicates (default 0: none)")
      ->check(CLI::Range(0, 100000));
  command.add_flag("--profile", o->profile, "Profile likelihood of every parameter");
  command.add_flag("--compare-solvers", o->compare,
                   "Gauss-Newton, Levenberg-Marquardt, simplex and annealing from the same starts");
  command
      .add_option("--starts", o->starts,
                  "Starts of the search: the given one and points spread about it, with a table of "
                  "where they end (default 1; of --compare-solvers 3)")
      ->check(CLI::Range(1, 1000));
  command
      .add_option("--folds", o->folds,
                  "Methods force and torque, what is left out and predicted: trial, block (a fifth "
                  "of every trial) or none")
      ->check(CLI::IsMember({"trial", "block", "none"}))
      ->capture_default_str();
  command.add_option("--out", o->out, "Folder for parameters.csv, parameters.json")->required();
  command.add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
  add_common_options(command, context);
  command.callback([&context, o] {
    const MuscleTable table = read_muscles_csv(o->muscles, o->method != "paper");
    refuse_what_cannot_be(*o, table);
    for (const std::string& text : without_effect(*o)) context.warn(text);
    o->files.torque = o->method == "torque";
    if (o->motion_cutoff_hz > 0.0) o->files.motion_cutoff_hz = o->motion_cutoff_hz;
    o->files.start_s = context.start_s;
    o->files.end_s = context.end_s;
    StudyData data =
        read_identify_data(o->files, table, [&](const std::string& text) { context.warn(text); });
    for (const std::string& name : o->free_more) {
      (void)identification::parameter_field(name);
      identification::ParameterRule rule;
      rule.parameter = name;
      rule.free = true;
      data.rules.push_back(rule);
    }
    context.prepare_folder(o->out);
    context.protect_inputs(o->out, {"parameters.", "fold_parameters.", "solvers."}, {o->muscles});
    identification::EstimatorSettings settings = estimator_settings(*o, context.seed);
    if (!o->files.motions.empty() && !is_free(data, is_about_motion))
      context.warn(
          "--motion has no effect: no joint_viscosity, joint_inertia or joint_stiffness is to be "
          "identified (--free)");
    if (is_free(data, is_about_lags)) {
      if (!o->lag.empty()) {
        throw InvalidInput(
            fmt::format("--lag {}: the lags of equation (1) are to be identified, which is a third "
                        "way to follow the EMG; leave one of both out",
                        o->lag));
      }
      settings.lag = identification::LagChoice::equation_1;
      context.warn(
          "the lags of equation (1) are to be identified: the activations given are taken for "
          "excitations that pass them, and the delay is what is left beside them");
    }
    identification::EstimatorOptions options =
        identification::estimator_options(settings, {}, context.progress());
    identification::IdentificationResult result;
    std::vector<identification::Fold> folds;
    std::string why_not;
    const StudyData as_read = data;
    const identification::EstimatorOptions as_asked = options;
    if (o->method == "paper") {
      result = identification::identify_paper(data, {.multistart = o->starts});
    } else if (o->method == "force") {
      result = identification::identify_force(data, {.estimator = options,
                                                     .detect_exact = true,
                                                     .speed_may_be_free = table.speed_may_be_free});
      free_what_is_free(result, table, data);
    } else {
      result = identification::identify_torque_or_exact(data, options, table.speed_may_be_free);
      free_what_is_free(result, table, data);
      identification::look_around(data, options, result);
    }
    options.lag = result.lag;
    options.choose_lag = false;
    if (o->method != "paper" && o->folds != "none" && !result.exact)
      folds = held_out(*o, as_read, as_asked, table.speed_may_be_free, why_not);
    if (const std::string text = identification::generalises_badly(folds); !text.empty())
      result.warnings.push_back(text);
    std::vector<NamedContest> contests;
    if (o->compare) {
      contests = solver_contests(data, o->method, options,
                                 {.starts = o->starts > 0 ? o->starts : kStartsToCompare,
                                  .seed = context.seed,
                                  .progress = context.progress()});
    }
    context.end_progress();
    for (const std::string& text : result.warnings) context.warn(text);
    Provenance provenance;
    provenance.command = context.command_line;
    provenance.inputs.push_back({o->muscles, sha256(recording::read_text_file(o->muscles))});
    for (const auto* list :
         {&o->files.activations, &o->files.lengths, &o->files.velocities, &o->files.forces,
          &o->files.moment_arms, &o->files.torques, &o->files.motions}) {
      for (const std::string& path : *list)
        provenance.inputs.push_back({path, sha256(recording::read_text_file(path))});
    }
    const std::vector<identification::IdentificationResult> results{result};
    ParameterContext told;
    if (o->method != "paper") told.max_rate_hz = o->max_rate_hz;
    told.left_out = folds.empty() ? "none" : o->folds;
    told.starting_values = table.assumed;
    const std::filesystem::path folder(o->out);
    recording::write_file(folder / "parameters.json",
                          parameters_json(results, folds, provenance, told));
    recording::write_file(folder / "parameters.csv", parameters_csv(results));
    std::error_code ignored;
    std::filesystem::remove(folder / "fold_parameters.csv", ignored);  // of an earlier run
    if (!folds.empty())
      recording::write_file(folder / "fold_parameters.csv", fold_parameters_csv(folds));
    if (!contests.empty()) recording::write_file(folder / "solvers.csv", solvers_csv(contests));
    if (context.json) {
      fmt::print("{}", parameters_json(results, folds, provenance, told));
    } else {
      print_result(result,
                   o->method != "paper" && !result.exact && !table.speed_may_be_free.empty());
      print_samples(result, data, *o);
      print_fit(result, data, o->method == "torque");
      print_folds(folds, why_not, *o);
      for (const identification::BasinTable& searches : result.basins) {
        fmt::print("\nSearches, {}:\n", searches.fit);
        print_basins(searches);
      }
      for (const NamedContest& contest : contests) print_contest(contest);
      fmt::print("{}/parameters.csv\n", o->out);
    }
    bool gate = o->method != "paper" && result.termination != math::Termination::converged;
    for (const auto& e : result.estimates)
      gate = gate || (context.strict && e.verdict == identification::Verdict::not_identifiable);
    if (gate) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
