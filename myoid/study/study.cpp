#include "myoid/study/study.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::study {

std::vector<std::string> study_coordinates(const ModelSpec& model) {
  std::vector<std::string> names{model.coordinate};
  names.insert(names.end(), model.more_coordinates.begin(), model.more_coordinates.end());
  return names;
}

std::optional<double> motion_cutoff_hz(const Study& study) {
  switch (study.motion.smoothing) {
    case Smoothing::none:
      return std::nullopt;
    case Smoothing::cutoff:
      return study.motion.cutoff_hz;
    case Smoothing::automatic:
      break;
  }
  return study.emg.chain.lowpass_hz;
}

void restrict_trials(Study& study, std::optional<double> start_s, std::optional<double> end_s) {
  for (TrialSpec& trial : study.trials) {
    if (start_s) trial.start_s = std::max(*start_s, trial.start_s.value_or(*start_s));
    if (end_s) trial.end_s = std::min(*end_s, trial.end_s.value_or(*end_s));
    if (trial.start_s && trial.end_s && *trial.start_s >= *trial.end_s) {
      throw InvalidInput(
          fmt::format("trial '{}': it would begin at {} s and end at {} s; --start must be before --end, and both "
                      "within the trial's own times",
                      trial.name, *trial.start_s, *trial.end_s));
    }
  }
}

}  // namespace myoid::study
