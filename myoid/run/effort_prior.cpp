#include "myoid/run/effort_prior.h"

#include <cmath>

#include "myoid/beliefs/beliefs.h"

namespace myoid {

bool from_maximal_effort(const EmgSpec& emg) {
  return emg.has_mvc || emg.kind == EmgKind::activation;
}

bool effort_is_unknown(const Study& study) {
  return !from_maximal_effort(study.emg) && study.identify.priors && study.identify.gain &&
         study.identify.estimator == identification::EstimatorKind::posterior;
}

Prior any_effort() {
  // Mean and spread of a logarithm that is uniform from ln(least) to 0.
  const double least = identification::beliefs::kLeastEffort.value;
  return {.mean = std::sqrt(least), .sd = -std::log(least) / std::sqrt(12.0), .logarithmic = true};
}

identification::ParameterRule effort_bounds() {
  identification::ParameterRule rule;
  rule.parameter = identification::beliefs::kEmgGain.name;
  rule.lower = identification::beliefs::kLeastEffort.value;
  rule.upper = 1.0;
  rule.usual = true;
  return rule;
}

void expect_any_effort(std::vector<identification::MuscleSetup>& muscles) {
  const Prior share = any_effort();
  for (identification::MuscleSetup& muscle : muscles) {
    const auto found = muscle.priors.find("max_isometric_force");
    if (found == muscle.priors.end()) continue;
    Prior& prior = found->second;
    const double relative = prior.logarithmic ? prior.sd : prior.sd / prior.mean;
    prior = {
        .mean = prior.mean * share.mean, .sd = std::hypot(relative, share.sd), .logarithmic = true};
  }
}

}  // namespace myoid
