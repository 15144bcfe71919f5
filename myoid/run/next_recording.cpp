#include "myoid/run/next_recording.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::run {

std::optional<DesignStudyResult> next_recording(const StudySource& source,
                                                const StudyFit& fit,
                                                const Progress& progress,
                                                std::vector<Remark>& remarks) {
  const study::Study& study = source.study;
  if (study.model.is_none()) return std::nullopt;
  DesignStudyOptions options;
  options.choice.movements = study.identify.next_movements;
  options.catalogue.dynamometer = false;
  std::vector<double> masses{0.0};
  for (const study::TrialSpec& trial : study.trials) {
    const double held_kg = trial.held_mass_kg.value_or(0.0);
    if (std::ranges::find(masses, held_kg) == masses.end()) masses.push_back(held_kg);
  }
  if (masses.size() > 1) options.catalogue.held_masses_kg = masses;
  options.progress.stop = progress.stop;
  if (const fit::IdentificationResult* torque = torque_of(fit)) {
    if (torque->termination != math::Termination::converged || !torque->covariance.allFinite()) return std::nullopt;
    options.earlier = earlier_run(*torque);
  }
  try {
    return design_study(study, *source.model, options);
  } catch (const InvalidInput& error) {
    remarks.push_back({.says = fmt::format("no next recording is planned: {}", error.what())});
    return std::nullopt;
  }
}

}  // namespace myoid::run
