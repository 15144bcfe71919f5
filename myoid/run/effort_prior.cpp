#include "myoid/run/effort_prior.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"

namespace myoid::run {

bool from_maximal_effort(const study::EmgSpec& emg) { return emg.has_mvc || emg.kind == study::EmgKind::activation; }

bool effort_is_unknown(const study::Study& study) { return !from_maximal_effort(study.emg) && study.identify.gain; }

bool effort_is_in_strength(const study::Study& study) {
  return !from_maximal_effort(study.emg) && !effort_is_unknown(study);
}

AnyEffort any_effort() {
  // Mean and spread of a logarithm that is uniform from ln(least) to 0.
  const double least = fit::beliefs::kLeastEffort.value;
  const double spread = -std::log(least) / std::sqrt(12.0), half = spread / std::numbers::sqrt2;
  return {.own = {.mean = std::sqrt(least), .sd = half, .logarithmic = true}, .common_sd = half};
}

double unseen_effort(const study::Study& study) {
  const bool by_gain = !from_maximal_effort(study.emg) || study.emg.mvc_effort_sd > 0.0;
  return by_gain ? 0.0 : study.beliefs.effort;
}

std::string meaning_of_strength(const study::Study& study, bool maximal) {
  const study::EmgSpec& emg = study.emg;
  if (!maximal && effort_is_unknown(study))
    return "F_max is the muscle's maximum and rests on the literature: the share of it at the largest EMG is an "
           "unknown. Record a maximal contraction.";
  if (!maximal)
    return "F_max means the force at the study's largest EMG, not the muscle's maximum; forces and torques do not "
           "depend on it.";
  if (emg.mvc_effort_sd > 0.0 || emg.mvc_effort < 1.0)
    return fmt::format(
        "F_max is the force of a completely active muscle: the maximal contractions are taken to reach {:.0f} +- "
        "{:.0f} % of it.",
        100.0 * emg.mvc_effort, 100.0 * emg.mvc_effort_sd);
  return fmt::format(
      "F_max is the force of a completely active muscle: that of the maximal contractions is taken to differ from it "
      "by {:.0f} % ([beliefs] effort_sd).",
      100.0 * unseen_effort(study));
}

fit::ParameterRule effort_bounds() {
  fit::ParameterRule rule;
  rule.parameter = fit::beliefs::kEmgGain.name;
  rule.lower = fit::beliefs::kLeastEffort.value;
  rule.upper = 1.0;
  rule.usual = true;
  return rule;
}

void expect_any_effort(std::vector<fit::MuscleSetup>& muscles) {
  const Prior share = any_effort().own;
  for (fit::MuscleSetup& muscle : muscles) {
    const auto found = muscle.priors.find("max_isometric_force");
    if (muscle.unseen || found == muscle.priors.end()) continue;
    Prior& prior = found->second;
    const double relative = prior.logarithmic ? prior.sd : prior.sd / prior.mean;
    prior = {.mean = prior.mean * share.mean, .sd = std::hypot(relative, share.sd), .logarithmic = true};
  }
}

}  // namespace myoid::run
