#include "myoid/run/given_trials.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/study/checks/given_check.h"
#include "myoid/study/checks/joint_of_arms.h"

namespace myoid::run {
namespace {

/// Returns true if the study frees the torque that the joint has without activity.
bool frees_resting_torque(const study::Study& study) {
  return std::ranges::any_of(study.parameters, [](const fit::ParameterRule& rule) {
    return rule.free.value_or(false) &&
           (rule.parameter == "joint_torque_offset" || rule.parameter == "joint_stiffness");
  });
}

study::TrialFiles files_of(const study::Study& study, const study::TrialSpec& spec) {
  const auto text = [](const std::optional<std::filesystem::path>& path) { return path ? path->string() : ""; };
  study::TrialFiles files{.activations = study.emg.kind == study::EmgKind::activation ? text(spec.emg) : "",
                          .lengths = text(spec.given.lengths),
                          .velocities = text(spec.given.velocities),
                          .moment_arms = {},
                          .torques = text(spec.given.torques),
                          .resting_torque_is_free = frees_resting_torque(study)};
  for (const std::filesystem::path& path : spec.given.moment_arms) files.moment_arms.push_back(path.string());
  return files;
}

/// Returns a sentence for each suspicious value of one trial.
std::vector<std::string> doubts(const study::Study& study,
                                const fit::StudyData& data,
                                const fit::TrialData& trial,
                                const TrialResult& result) {
  const study::TrialFiles files = files_of(study, result.spec);
  std::vector<std::string> found;
  const std::vector<std::string>& torques = result.input.given.torque_columns;
  for (std::size_t j = 0; j < files.moment_arms.size() && !torques.empty(); ++j)
    found.push_back(study::check_joint_by_name(files.moment_arms[j], torques[j], torques));
  for (std::string& text : study::check_given_trial(data, trial, files)) found.push_back(std::move(text));
  if (!files.lengths.empty())
    for (std::string& text : study::check_joint_of_arms(data, trial, files)) found.push_back(std::move(text));
  std::erase(found, "");
  return found;
}

/// Returns true if a condition holds in all trials of the data.
bool in_all(const fit::StudyData& data, const auto& holds) { return std::ranges::all_of(data.trials, holds); }

/// Refuses a joint whose given torques, and muscles whose given forces, are 0 in all trials.
void require_something_to_fit(const study::Study& study, const fit::StudyData& data, const study::GivenSpec& files) {
  const auto nothing = [](const auto& values) { return !(values.cwiseAbs().maxCoeff() > 0.0); };
  constexpr std::string_view kRemedy =
      "there is nothing to fit; is it the right file and column, or was the channel off?";
  const std::vector<std::string> joints = study::study_coordinates(study.model);
  for (std::size_t j = 0; files.torques && j < joints.size(); ++j) {
    if (in_all(data, [&](const auto& trial) { return nothing(fit::of_joint(trial, j).torque_nm); }))
      throw InvalidInput(
          fmt::format("{}: the torque '{}' is 0 in all trials: {}", files.torques->string(), joints[j], kRemedy));
  }
  if (files.forces && in_all(data, [&](const auto& trial) { return nothing(trial.force_n); }))
    throw InvalidInput(fmt::format("{}: every force is 0 in all trials: {}", files.forces->string(), kRemedy));
}

/// Warns of activations that never change or are equal: the fit would give the work of one muscle to the others.
std::vector<Remark> compare_activations(const fit::StudyData& data, const std::string& file) {
  std::vector<std::string> channels;
  for (const fit::MuscleSetup& muscle : data.muscles) {
    if (!muscle.unseen && std::ranges::find(channels, muscle.emg_channel) == channels.end())
      channels.push_back(muscle.emg_channel);
  }
  std::vector<Remark> found;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    // A table with a row for each maximal contraction has the activation 1 throughout.
    constexpr double kEffort = 0.5;
    const auto of = [&](const fit::TrialData& trial, std::size_t k) {
      return trial.activation.values().col(trial.activation.index(channels[k]));
    };
    if (in_all(data, [&](const auto& trial) { return !(of(trial, c).maxCoeff() > of(trial, c).minCoeff()); })) {
      if (in_all(data, [&](const auto& trial) { return of(trial, c).minCoeff() >= kEffort; })) continue;
      found.push_back(
          {.code = RemarkCode::channel_unusable,
           .says = fmt::format("{}: activation '{}' never changes in any trial: was the electrode connected? The work "
                               "of its muscles is given to the others; leave them out only if they were at rest",
                               file, channels[c])});
      continue;
    }
    for (std::size_t other = 0; other < c; ++other) {
      if (in_all(data, [&](const auto& trial) { return of(trial, c) == of(trial, other); }))
        found.push_back({.code = RemarkCode::shared_channel,
                         .says = fmt::format(
                             "{}: activations '{}' and '{}' are the same in all trials: was a column copied? If one "
                             "electrode stands for both, name it for both muscles",
                             file, channels[other], channels[c])});
    }
  }
  return found;
}

/// Looks at all trials together, where each gives its lengths; adds remarks to the first.
void check_together(const study::Study& study, const fit::StudyData& data, std::vector<TrialResult>& trials) {
  const bool given = !data.trials.empty() && std::ranges::all_of(trials, [](const TrialResult& trial) {
    return trial.spec.given.lengths.has_value();
  });
  if (!given) return;
  TrialResult& first = trials.front();
  require_something_to_fit(study, data, first.spec.given);
  if (study.emg.kind != study::EmgKind::activation || !first.spec.emg) return;
  for (Remark& remark : compare_activations(data, first.spec.emg->string())) first.remarks.push_back(std::move(remark));
}

}  // namespace

void check_given(const study::Study& study, const fit::StudyData& data, std::vector<TrialResult>& trials) {
  for (const fit::TrialData& trial : data.trials) {
    const auto result = std::ranges::find_if(trials, [&](const TrialResult& t) { return t.spec.name == trial.name; });
    if (result->spec.given == study::GivenSpec{}) continue;
    try {
      for (std::string& text : doubts(study, data, trial, *result))
        result->remarks.push_back({.code = RemarkCode::general, .says = std::move(text)});
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("{} (trial '{}')", error.what(), trial.name));
    }
  }
  check_together(study, data, trials);
}

}  // namespace myoid::run
