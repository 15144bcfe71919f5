#include "myoid/commands/identify_options.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/commands/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/identification/estimator_settings.h"
#include "myoid/identification/parameter_fields.h"
#include "myoid/identification/parameters.h"

namespace myoid::commands {
namespace {

using identification::ParameterRule;
using identification::StudyData;

bool is_free(const StudyData& data, bool (*about)(const ParameterRule&)) {
  return std::any_of(data.rules.begin(), data.rules.end(), [&](const ParameterRule& rule) {
    return rule.free.value_or(false) && about(rule);
  });
}

/// A parameter of the joint that acts by its motion.
bool is_about_motion(const ParameterRule& rule) {
  const identification::ParameterField& field = identification::parameter_field(rule.parameter);
  return field.scope == identification::Scope::joint && field.field != identification::kOffset;
}

bool is_about_lags(const ParameterRule& rule) { return identification::is_lag(rule.parameter); }

/// Names the options that the published method does not have.
std::vector<std::string> beyond_the_paper(const IdentifyOptions& o, const MuscleTable& table) {
  std::vector<std::string> asked;
  if (o.delay_s) asked.emplace_back("--delay");
  if (o.loss != "square") asked.emplace_back("--loss");
  if (o.bootstrap > 0) asked.emplace_back("--bootstrap");
  if (o.profile) asked.emplace_back("--profile");
  if (o.folds == "block") asked.emplace_back("--folds block");
  if (!o.lag.empty()) asked.push_back("--lag " + o.lag);
  for (const std::string& name : o.free_more) asked.push_back("--free " + name);
  for (const ParameterRule& rule : table.rules)
    asked.push_back(fmt::format("{}_fixed = false in {}", rule.parameter, o.muscles));
  return asked;
}

/// Parameters of the joint need its torque, and most of them its motion.
void refuse_free_without_motion(const IdentifyOptions& o) {
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

identification::EstimatorSettings settings_of(const IdentifyOptions& o) {
  identification::EstimatorSettings settings;
  settings.priors = !o.no_priors;
  if (!o.lag.empty()) settings.lag = *choice_named<identification::LagChoice>(o.lag);
  settings.max_rate_hz = o.max_rate_hz;
  settings.delay_s = o.delay_s;
  settings.residual_cutoff_hz.reset();
  if (o.residual_hz > 0.0) settings.residual_cutoff_hz = o.residual_hz;
  settings.loss = *choice_named<identification::Loss>(o.loss);
  settings.starts = o.starts;
  settings.intervals = {.bootstrap = o.bootstrap, .profile = o.profile, .seed = o.call.seed};
  return settings;
}

}  // namespace

void check_words(const IdentifyOptions& o) {
  check_word("--method", o.method, {"paper", "force", "torque"});
  check_word("--loss", o.loss, {"square", "huber", "cauchy"});
  check_word("--folds", o.folds, {"trial", "block", "none"});
  if (!o.lag.empty()) check_word("--lag", o.lag, {"automatic", "delay", "shared"});
}

void refuse_impossible(const IdentifyOptions& o, const MuscleTable& table) {
  if (const auto asked = beyond_the_paper(o, table); o.method == "paper" && !asked.empty()) {
    throw InvalidInput(
        fmt::format("{}: the published method has none of it; leave it out, or use --method force, "
                    "which fits the same forces",
                    fmt::join(asked, ", ")));
  }
  if (o.method == "force" && o.lag == "automatic") {
    throw InvalidInput(
        "--lag automatic: method force fits each muscle alone, and all follow their EMG alike; "
        "give --lag delay or shared, or use --method torque");
  }
  // Samples hold what lies well below half of their rate.
  if (o.method != "paper" && o.residual_hz >= 0.45 * o.max_rate_hz)
    throw InvalidInput(fmt::format(
        "--residual-cutoff {0}: samples are thinned to {1} Hz, which holds less than {2:.3g} Hz; "
        "give --max-rate {3:.0f}, or --residual-cutoff 0 for no low-pass",
        o.residual_hz, o.max_rate_hz, 0.45 * o.max_rate_hz, std::ceil(o.residual_hz / 0.4)));
  if (o.motion_cutoff_hz > 0.0 && o.files.motions.empty())
    throw InvalidInput("--lowpass smooths the angles of --motion, which is not given");
  refuse_free_without_motion(o);
}

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

identification::EstimatorOptions estimator_options(const IdentifyOptions& o,
                                                   const StudyData& data,
                                                   Remarks& remarks) {
  identification::EstimatorSettings settings = settings_of(o);
  if (!o.files.motions.empty() && !is_free(data, is_about_motion))
    remarks.warn(
        "--motion has no effect: no joint_viscosity, joint_inertia or joint_stiffness is to be "
        "identified (--free)");
  if (is_free(data, is_about_lags)) {
    if (!o.lag.empty()) {
      throw InvalidInput(
          fmt::format("--lag {}: the lags of equation (1) are to be identified, which is a third "
                      "way to follow the EMG; leave one of both out",
                      o.lag));
    }
    settings.lag = identification::LagChoice::equation_1;
    remarks.warn(
        "the lags of equation (1) are to be identified: the activations given are taken for "
        "excitations that pass them, and the delay is what is left beside them");
  }
  return identification::estimator_options(settings, {}, o.call.progress);
}

}  // namespace myoid::commands
