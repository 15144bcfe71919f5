#include "myoid/run/fit_source.h"

namespace myoid {

FitSource fit_source(const StudySource& source,
                     const std::vector<TrialResult>& trials,
                     const std::vector<identification::RestingJoint>& resting,
                     const EmgScale& scale) {
  FitSource found{source.study, *source.model, trials, resting, {}, scale};
  for (const TrialResult& trial : trials) found.activation.push_back(&trial.emg.activation);
  return found;
}

}  // namespace myoid
