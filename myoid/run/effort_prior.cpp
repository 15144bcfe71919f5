#include "myoid/run/effort_prior.h"

#include <cmath>

#include "myoid/beliefs/beliefs.h"

namespace myoid {

bool from_maximal_effort(const EmgSpec& emg) {
  return emg.has_mvc || emg.kind == EmgKind::activation;
}

void expect_any_effort(std::vector<identification::MuscleSetup>& muscles) {
  // Mean and spread of a logarithm that is uniform from ln(least) to 0.
  const double least = identification::beliefs::kLeastEffort.value;
  const double mean = 0.5 * std::log(least);
  const double sd = -std::log(least) / std::sqrt(12.0);
  for (identification::MuscleSetup& muscle : muscles) {
    const auto found = muscle.priors.find("max_isometric_force");
    if (found == muscle.priors.end()) continue;
    Prior& prior = found->second;
    const double relative = prior.logarithmic ? prior.sd : prior.sd / prior.mean;
    prior = {
        .mean = prior.mean * std::exp(mean), .sd = std::hypot(relative, sd), .logarithmic = true};
  }
}

}  // namespace myoid
