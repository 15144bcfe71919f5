#include "myoid/results/exports/identified_osim.h"

#include <utility>
#include <vector>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/run/effort_prior.h"
#include "myoid/run/quality_gates.h"
#include "myoid/study/study_ids.h"
#include "myoid/study/study_model.h"

namespace myoid::results {

using fit::IdentificationResult;
using fit::ParameterEstimate;

void write_identified_model(const run::StudyResult& result, const std::filesystem::path& folder) {
  if (result.source.study.model.is_none() || run::motion_is_unreliable(result.source.study, result.trials)) return;
  const IdentificationResult* torque = run::torque_of(result.fit);
  if (torque == nullptr) return;
  const study::Study& study = result.source.study;
  const bool from_mvc = run::from_maximal_effort(study.emg);
  bool any = false;
  std::vector<study::IdentifiedMuscle> muscles;
  for (std::size_t m = 0; m < result.fit_input.data.muscles.size(); ++m) {
    const fit::MuscleSetup& setup = result.fit_input.data.muscles[m];
    study::IdentifiedMuscle muscle{setup.name, setup.start, torque->muscles[m], {}};
    for (const ParameterEstimate& e : torque->estimates) {
      const bool sure = e.verdict == fit::Verdict::identified && (from_mvc || e.parameter != "max_isometric_force");
      if (e.muscle == muscle.group && sure) muscle.changed.push_back(e.parameter);
    }
    any = any || !muscle.changed.empty();
    muscles.push_back(std::move(muscle));
  }
  if (!any) return;
  write_file(folder / study::identified_model_name(study),
             study::identified_model(study, result.source.model_text, muscles));
}

}  // namespace myoid::results
