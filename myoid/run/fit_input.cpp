#include "myoid/run/fit_input.h"

#include <algorithm>

#include "myoid/fit/measurement/nuisances.h"
#include "myoid/fit/methods/plain_fit.h"
#include "myoid/run/estimator_input.h"
#include "myoid/run/study_phases.h"

namespace myoid::run {

FitInput fit_input(const FitSource& source, const Progress& progress, std::optional<bool> hold) {
  const study::Study& study = source.study;
  FitInput input{.data = estimator_data(source),
                 .options = torque_options(study, source.scale.normalisation, progress),
                 .phases = {}};
  // Method `force` decides that for each muscle.
  const std::vector<fit::Method>& methods = study.identify.methods;
  const bool given = study.emg.kind == study::EmgKind::activation && !input.data.trials.empty() &&
                     std::ranges::find(methods, fit::Method::torque) != methods.end();
  // Data without noise tell everything.
  input.nuisances_held = hold.value_or(given && !fit::tells_nuisances(input.data, input.options) &&
                                       !fit::exact_fit(input.data, input.options));
  if (input.nuisances_held) fit::hold_nuisances(input.data);
  if (study.phases.search && !input.data.trials.empty()) {
    input.phases = study_phases(source, input.data, input.options);
    exclude_phases(study.phases.exclude, input.phases, input.data);
  }
  return input;
}

}  // namespace myoid::run
