#include "myoid/program/commands/identify_options.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/ground/core/error.h"
#include "myoid/program/commands/run.h"

namespace myoid::program {
namespace {

using fit::ParameterRule;

/// Names the options that the published method does not have.
std::vector<std::string> beyond_the_paper(const IdentifyOptions& o, const run::MuscleTable& table) {
  std::vector<std::string> asked;
  if (o.delay_s) asked.emplace_back("--delay");
  if (o.folds == fit::FoldKind::block) asked.emplace_back("--folds block");
  if (o.lag) asked.push_back(fmt::format("--lag {}", choice_name(*o.lag)));
  for (const std::string& name : o.free_more) asked.push_back("--free " + name);
  for (const ParameterRule& rule : table.rules)
    asked.push_back(fmt::format("{}_fixed = false in {}", rule.parameter, o.muscles.string()));
  return asked;
}

/// Refuses free parameters of the joint without its torque or, for most of them, its motion.
void refuse_free_without_motion(const IdentifyOptions& o) {
  for (const std::string& name : o.free_more) {
    const fit::ParameterField& field = fit::parameter_field(name);
    if (field.scope != fit::Scope::joint) continue;
    if (o.method != fit::Method::torque)
      throw InvalidInput(fmt::format("--free {}: it is the joint's; use --method torque", name));
    if (field.field != fit::kOffset && o.files.motions.empty())
      throw InvalidInput(fmt::format(
          "--free {}: it acts by the joint's motion; give its angles with --motion, one file per trial", name));
  }
}

void visit_files(IdentifyOptions& o, study::SettingVisitor& v) {
  v.text("from", o.from,
         {.says = "[Project of CEINMS, CEINMS-RT or NMSM](review.md#going-on) in place of muscles.csv and all files; "
                  "`--coordinate` names its joints.",
          .otherwise = "none",
          .option = {.keyword = "from_"}});
  v.path("muscles", o.muscles,
         {.says = "[muscles.csv](#musclescsv): the muscles and their starting values, SI.", .required = "muscles.csv"});
  v.texts("activations", o.files.activations,
          {.says = "Activations, 0 to 1, in columns named by muscle, or by the column `emg` of muscles.csv; one file "
                   "per trial. They may have a clock of their own.",
           .required = "a file per trial"});
  v.texts("lengths", o.files.lengths,
          {.says = "Musculotendon lengths [m], or fiber lengths where `tendon_slack_length` is 0 or absent; one file "
                   "per trial.",
           .required = "a file per trial"});
  v.texts("velocities", o.files.velocities,
          {.says = "Rates of these lengths [m/s], lengthening positive.",
           .otherwise = "by the quintic spline through the lengths: for lengths without noise"});
  v.texts(
      "forces", o.files.forces,
      {.says = "Muscle forces [N], in columns named by muscle.", .otherwise = "none; `paper` and `force` need them"});
  v.texts("moment-arms", o.files.moment_arms,
          {.says = "Moment arms r = −dl/dq [m], in columns named by muscle; a file for each coordinate of each trial.",
           .otherwise = "none; `torque` needs them"});
  v.texts(
      "torques", o.files.torques,
      {.says = "The joint torque that the muscles provide together [N m].", .otherwise = "none; `torque` needs them"});
  v.texts(
      "fascicles", o.files.fascicles,
      {.says = "[Measured lengths of fascicles](study.md#fascicles), in columns named by muscle: `TA [mm]`; one file "
               "per trial, `none` for a trial without.",
       .otherwise = "none"});
  v.texts("coordinate", o.files.coordinates,
          {.says = "Columns of the torque file, with or without `_moment`. Several joints are fitted at once; "
                   "`--moment-arms` follows their order within each trial.",
           .otherwise = "the only column"});
  v.texts("motion", o.files.motions,
          {.says = "Joint angles (`.mot`, `.sto`; columns as `--coordinate`, or the only one), differentiated, for the "
                   "stiffness and viscosity of the joint itself.",
           .otherwise = "none: the joint's own torque is a constant"});
  v.number("lowpass", o.files.motion_cutoff_hz,
           {.says = "The angles of `--motion` are smoothed, −3 dB at this frequency.",
            .limits = study::above_zero("Hz"),
            .otherwise = "not smoothed"});
}

/// Visits the method and the law that the method fits.
void visit_law(IdentifyOptions& o, study::SettingVisitor& v) {
  static constexpr std::string_view kMethods[] = {"torque", "force", "paper"};
  static constexpr std::string_view kLags[] = {"automatic", "delay", "shared"};
  v.choice("method", o.method,
           {.says = "`torque`: all muscles against the joint's torque; `force`: each muscle against its own force; "
                    "`paper`: each branch alone, as published.",
            .words = kMethods});
  v.number("delay", o.delay_s,
           {.says = "The EMG delay is held at this (`force`, `torque`).",
            .limits = study::within(0.0, 0.3, "s"),
            .otherwise = "estimated"});
  v.choice(
      "lag", o.lag,
      {.says = "How muscles follow their EMG (`force`, `torque`): `delay`: by `emg_delay`; `shared`: by a delay and "
               "lags; `automatic`: both, by their evidence ([how](../theory/identification.md)).",
       .otherwise = "`automatic` for `torque`, else `delay`",
       .words = kLags});
  v.texts("free", o.free_more,
          {.says = "Further parameters to identify, of all muscles, channels or the joint, by comma: "
                   "`emg_shape,joint_inertia`, beside [those of every fit](#what-is-identified).",
           .otherwise = "none",
           .option = {.by_comma = true}});
  v.texts("hold", o.hold,
          {.says = "Parameters that are known, by comma: `emg_exponent,emg_gain` for activations without error.",
           .otherwise = "none",
           .option = {.by_comma = true}});
}

/// Visits the fit and the certainty of its result.
void visit_fit(IdentifyOptions& o, study::SettingVisitor& v) {
  static constexpr std::string_view kFolds[] = {"trial", "block", "none"};
  static constexpr std::string_view kScales[] = {"electrode", "muscle"};
  v.path("beliefs", o.beliefs,
         {.says = "File with a table [`[beliefs]`](study.md#beliefs), such as a study.toml: "
                  "what is believed about errors that residuals hardly show.",
          .otherwise = "the [usual beliefs](../theory/priors.md)"});
  v.count("posterior-draws", o.posterior_draws,
          {.says = "So many draws by Hamiltonian Monte Carlo make the intervals, in place of "
                   "an approximation; 1000 take some ten times as long. 0: none.",
           .limits = study::within(0, 100000)});
  v.flag("compare-solvers", o.compare_solvers,
         {.says = "Method `paper`: Gauss–Newton, Levenberg–Marquardt, simplex and simulated annealing from the same "
                  "starts: [which solver](#which-solver). Also writes `solvers.csv`."});
  v.count("starts", o.starts,
          {.says = "Method `paper`: [starts of the search](#starts-of-the-search), the given one and points about it.",
           .limits = study::within(1, 1000),
           .otherwise = "1; of `--compare-solvers` 3"});
  v.choice(
      "folds", o.folds,
      {.says = "What is left out of the fit and predicted: a `trial`; a `block`, a fifth of every trial of 3.3 s or "
               "more; or `none`.",
       .words = kFolds});
  v.either("scales", o.own_scales,
           {.says = "Of method `torque`: muscles that share an electrode share one scale of every parameter of the law "
                    "(`electrode`), or have their own (`muscle`).",
            .words = kScales});
  v.texts("validate", o.files.held_back,
          {.says = "Trials that are predicted (`torque`), not fitted: by number, file of lengths, or its name without "
                   "ending. Written as by [`predict`](predict.md).",
           .otherwise = "none"});
}

}  // namespace

void visit(IdentifyOptions& o, study::SettingVisitor& v) {
  visit_files(o, v);
  visit_law(o, v);
  visit_fit(o, v);
  v.folder("out", o.folder, {.says = "Folder of the results.", .required = "a folder"});
  visit_exports(o.exports, v);
  visit_mat(o.mat, v);
}

void refuse_impossible(const IdentifyOptions& o, const run::MuscleTable& table) {
  if (const auto asked = beyond_the_paper(o, table); o.method == fit::Method::paper && !asked.empty()) {
    throw InvalidInput(fmt::format(
        "{}: the published method has none of it; leave it out, or use --method force, which fits the same forces",
        fmt::join(asked, ", ")));
  }
  if (o.method == fit::Method::force && o.lag == fit::LagChoice::automatic) {
    throw InvalidInput(
        "--lag automatic: method force fits each muscle alone, and all follow their EMG alike; give --lag delay or "
        "shared, or use --method torque");
  }
  if (o.files.motion_cutoff_hz && o.files.motions.empty())
    throw InvalidInput("--lowpass smooths the angles of --motion, which is not given");
  refuse_free_without_motion(o);
}

std::vector<std::string> without_effect(const IdentifyOptions& o) {
  std::vector<std::string> found;
  const auto tell = [&](bool given, std::string_view option, std::string_view why) {
    if (given) found.push_back(fmt::format("{} has no effect: {}", option, why));
  };
  const bool paper = o.method == fit::Method::paper, torque = o.method == fit::Method::torque;
  constexpr std::string_view kNoBelief = "the published method rests on no belief";
  tell(paper && o.posterior_draws > 0, "--posterior-draws", kNoBelief);
  tell(paper && o.beliefs.has_value(), "--beliefs", kNoBelief);
  constexpr std::string_view kOfPaper = "it is of method paper (--method paper)";
  tell(!paper && o.compare_solvers, "--compare-solvers", kOfPaper);
  tell(!paper && o.starts.has_value(), "--starts", kOfPaper);
  constexpr std::string_view kForces = "methods paper and force fit muscle forces (--forces)";
  tell(!torque && !o.files.torques.empty(), "--torques", kForces);
  tell(!torque && !o.files.moment_arms.empty(), "--moment-arms", kForces);
  tell(!torque && !o.files.fascicles.empty(), "--fascicles", "they are fitted beside torques, of method torque");
  tell(!torque && !o.files.held_back.empty(), "--validate",
       "trials are predicted by the joint torque, of method torque");
  tell(torque && !o.files.forces.empty(), "--forces", "method torque fits joint torques (--torques)");
  return found;
}

}  // namespace myoid::program
