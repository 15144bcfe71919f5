#include "myoid/run/fit_input.h"

#include "myoid/run/estimator_input.h"
#include "myoid/run/study_phases.h"

namespace myoid {

FitSource fit_source(const StudySource& source,
                     const std::vector<TrialResult>& trials,
                     const std::vector<identification::RestingJoint>& resting,
                     const EmgScale& scale) {
  FitSource found{source.study, *source.model, trials, resting, {}, scale};
  for (const TrialResult& trial : trials) found.activation.push_back(&trial.emg.activation);
  return found;
}

FitInput fit_input(const FitSource& source, const Progress& progress) {
  const Study& study = source.study;
  FitInput input{.data = estimator_data(source),
                 .options = torque_options(study, source.scale.normalisation, progress),
                 .phases = {}};
  if (study.phases.search && !input.data.trials.empty()) {
    input.phases = study_phases(source, input.data, input.options);
    exclude_phases(study.phases.exclude, input.phases, input.data);
  }
  return input;
}

}  // namespace myoid
