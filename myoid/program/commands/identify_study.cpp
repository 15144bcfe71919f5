#include "myoid/program/commands/identify_study.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/ground/core/error.h"
#include "myoid/run/identify_files/electrode_ties.h"
#include "myoid/run/identify_files/muscle_specs.h"
#include "myoid/study/read_study.h"

namespace myoid::program {
namespace {

using fit::ParameterRule;

ParameterRule free_or_held(const std::string& name, bool free) {
  (void)fit::parameter_field(name);
  ParameterRule rule;
  rule.parameter = name;
  rule.free = free;
  return rule;
}

std::vector<study::TrialSpec> trials_of(const IdentifyOptions& o) {
  const run::IdentifySources& files = o.files;
  const bool torque = o.method == fit::Method::torque;
  run::require_counts(files, torque);
  const auto one = [](const std::vector<std::string>& list, std::size_t i) -> std::optional<std::filesystem::path> {
    if (i < list.size()) return list[i];
    return std::nullopt;
  };
  std::vector<study::TrialSpec> trials;
  const std::size_t joints = std::max<std::size_t>(1, files.coordinates.size());
  for (std::size_t i = 0; i < files.lengths.size(); ++i) {
    study::TrialSpec trial;
    trial.name = run::trial_label(files.lengths, i);
    trial.emg = files.activations[i];
    trial.given.lengths = files.lengths[i];
    trial.given.velocities = one(files.velocities, i);
    if (!torque) trial.given.forces = one(files.forces, i);
    if (torque) {
      trial.motion = one(files.motions, i);
      trial.fascicles = one(files.fascicles, i);
      if (trial.fascicles == run::kNoFile) trial.fascicles.reset();
      trial.given.torques = one(files.torques, i);
      for (std::size_t j = 0; j < joints; ++j) trial.given.moment_arms.emplace_back(files.moment_arms[joints * i + j]);
    }
    trials.push_back(std::move(trial));
  }
  if (!torque) return trials;
  for (const std::string& name : files.held_back)
    trials[run::trial_named(name, files.lengths)].use = study::Use::validation;
  return trials;
}

/// Returns the rules in the order in which later ones win: shared scales, muscles.csv.
std::vector<ParameterRule> rules_of(const IdentifyOptions& o, const run::MuscleTable& table, Remarks& remarks) {
  std::vector<ParameterRule> rules;
  if (o.method == fit::Method::torque && !o.own_scales) {
    run::ElectrodeTies ties = run::electrode_ties(table.muscles);
    rules = std::move(ties.rules);
    if (!ties.says.empty()) remarks.note(ties.says);
  }
  const std::vector<ParameterRule> of_table = run::parameter_rules(table);
  rules.insert(rules.end(), of_table.begin(), of_table.end());
  return rules;
}

/// Returns true if the lags of equation (1) are to be identified. Throws InvalidInput if the options state how muscles
/// follow their EMG, too.
bool frees_lags(const IdentifyOptions& o, const std::vector<ParameterRule>& rules) {
  const bool frees = std::ranges::any_of(
      rules, [](const ParameterRule& rule) { return rule.free.value_or(false) && fit::is_lag(rule.parameter); });
  if (frees && o.lag)
    throw InvalidInput(
        fmt::format("--lag {}: the lags of equation (1) are to be identified, which is a third way to follow the "
                    "EMG; leave one of both out",
                    choice_name(*o.lag)));
  return frees;
}

/// Sets the choices of the fit that files and projects share.
void choose_fit(const IdentifyOptions& o, study::Study& study) {
  study::IdentifySpec& fit = study.identify;
  fit.methods = {o.method};
  fit.posterior_draws = o.posterior_draws;
  fit.cross_validate = o.folds.has_value();
  if (o.folds) fit.folds = *o.folds;
  fit.starts = o.starts;
  fit.compare_solvers = o.compare_solvers;
  if (o.lag) fit.lag = *o.lag;
  study.emg.delay_s = o.delay_s;
  if (o.beliefs && o.method != fit::Method::paper) study.beliefs = study::read_beliefs(*o.beliefs);
  for (const std::string& name : o.free_more) study.parameters.push_back(free_or_held(name, true));
  for (const std::string& name : o.hold) study.parameters.push_back(free_or_held(name, false));
}

}  // namespace

study::Study identify_study(const IdentifyOptions& o, const run::MuscleTable& table, Remarks& remarks) {
  study::Study study;
  study.file = o.muscles;
  study.model.builtin = "none";
  study.model.coordinate = "joint";
  if (!o.files.coordinates.empty()) {
    study.model.coordinate = o.files.coordinates.front();
    study.model.more_coordinates.assign(o.files.coordinates.begin() + 1, o.files.coordinates.end());
  }
  study.motion.smoothing = o.files.motion_cutoff_hz ? study::Smoothing::cutoff : study::Smoothing::none;
  study.motion.cutoff_hz = o.files.motion_cutoff_hz.value_or(study.motion.cutoff_hz);
  study.emg.kind = study::EmgKind::activation;
  study.emg.has_mvc = false;
  study.phases.search = false;
  study.identify.next_movements = 0;
  study.identify.elastic_tendon = false;
  study.muscles = run::muscle_specs(table);
  study.parameters = rules_of(o, table, remarks);
  study.trials = trials_of(o);
  choose_fit(o, study);
  study.identify.dynamics = frees_lags(o, study.parameters);
  if (study.identify.dynamics)
    remarks.warn(
        "the lags of equation (1) are to be identified: the activations given are taken for excitations that pass "
        "them, and the delay is the time that is left beside them");
  study::restrict_trials(study, o.call.start_s, o.call.end_s);
  return study;
}

study::Study with_choices(study::Study study, const IdentifyOptions& o) {
  choose_fit(o, study);
  study::restrict_trials(study, o.call.start_s, o.call.end_s);
  return study;
}

study::Study seen_from(const std::filesystem::path& folder, study::Study study) {
  const std::filesystem::path here = std::filesystem::absolute(folder).lexically_normal();
  const auto turn = [&](std::filesystem::path& path) {
    path = std::filesystem::absolute(path).lexically_normal().lexically_relative(here);
  };
  if (study.model.file) turn(*study.model.file);
  for (study::TrialSpec& trial : study.trials) {
    for (std::optional<std::filesystem::path>* path :
         {&trial.emg, &trial.motion, &trial.fascicles, &trial.given.lengths, &trial.given.velocities,
          &trial.given.torques, &trial.given.forces}) {
      if (*path) turn(**path);
    }
    for (std::filesystem::path& path : trial.given.moment_arms) turn(path);
  }
  study.file = "study.toml";
  return study;
}

}  // namespace myoid::program
