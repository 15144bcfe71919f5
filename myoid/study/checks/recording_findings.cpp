#include "myoid/study/checks/recording_findings.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "myoid/ground/core/parallel.h"
#include "myoid/recording/signals/emg_levels.h"
#include "myoid/study/checks/dynamometer_sign.h"
#include "myoid/study/checks/unlike_trials.h"
#include "myoid/study/intake/trial_quality.h"

namespace myoid::study {

EmgOfTrials emg_of(const std::vector<TrialInput>& inputs) {
  EmgOfTrials emg;
  for (const TrialInput& input : inputs) emg.push_back(input.emg ? &*input.emg : nullptr);
  return emg;
}

RecordingFindings recording_findings(const Study& study,
                                     const body::BodyModel& model,
                                     const std::vector<TrialInput>& inputs,
                                     const StudyActivation& activation) {
  RecordingFindings found;
  found.of_trials.resize(inputs.size());
  parallel_ranges<std::size_t>(inputs.size(), 1, [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      found.of_trials[i] = trial_faults(study, inputs[i], activation.trials[i].activation);
      for (Remark& fault : found.of_trials[i]) fault.where = study.trials[i].name;
    }
  });
  if (study.emg.kind != EmgKind::activation)
    found.levels = recording::check_emg_levels(envelopes_of(study, emg_of(inputs), activation, false).trials);
  std::vector<EffortTrial> efforts;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& torque = inputs[i].external_torque;
    const auto& motion = inputs[i].motion;
    efforts.push_back(
        {&study.trials[i], torque ? &*torque : nullptr, activation.trials[i].activation, motion ? &*motion : nullptr});
  }
  std::vector<Remark> torques = dynamometer_signs(study, model, efforts);
  std::ranges::move(unlike_torques(study, model, efforts), std::back_inserter(torques));
  found.dynamometers = grouped(torques);
  return found;
}

std::vector<std::string> fault_summary(std::vector<Remark> faults, std::size_t most) {
  std::erase_if(faults, [](const Remark& f) { return f.severity != Severity::warning; });
  std::vector<std::string> lines;
  for (const Remark& f : named_together(grouped(faults, Times::merged)))
    lines.push_back((f.where.empty() ? "" : fmt::format("trial {}: ", f.where)) + sentence(f));
  if (lines.size() <= most) return lines;
  const std::size_t more = lines.size() - most;
  lines.resize(most);
  lines.push_back(fmt::format("{} more faults: see `myoid check`", more));
  return lines;
}

}  // namespace myoid::study
