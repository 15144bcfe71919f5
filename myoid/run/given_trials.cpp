#include "myoid/run/given_trials.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/run/given_check.h"
#include "myoid/run/joint_of_arms.h"

namespace myoid {
namespace {

/// Returns true if the study frees the torque that the joint has without activity.
bool frees_resting_torque(const Study& study) {
  return std::ranges::any_of(study.parameters, [](const identification::ParameterRule& rule) {
    return rule.free.value_or(false) &&
           (rule.parameter == "joint_torque_offset" || rule.parameter == "joint_stiffness");
  });
}

TrialFiles files_of(const Study& study, const TrialSpec& spec) {
  const auto text = [](const std::optional<std::filesystem::path>& path) { return path ? path->string() : ""; };
  TrialFiles files{.activations = {},
                   .lengths = text(spec.given.lengths),
                   .velocities = text(spec.given.velocities),
                   .moment_arms = {},
                   .torques = text(spec.given.torques),
                   .resting_torque_is_free = frees_resting_torque(study)};
  for (const std::filesystem::path& path : spec.given.moment_arms) files.moment_arms.push_back(path.string());
  return files;
}

/// Returns a sentence for each suspicious value of one trial.
std::vector<std::string> doubts(const Study& study,
                                const identification::StudyData& data,
                                const identification::TrialData& trial,
                                const TrialResult& result) {
  const TrialFiles files = files_of(study, result.spec);
  std::vector<std::string> found;
  if (const auto& torques = result.input.given.torques) {
    for (std::size_t j = 0; j < files.moment_arms.size(); ++j)
      found.push_back(check_joint_by_name(files.moment_arms[j], torques->channels()[j].name, *torques));
  }
  for (std::string& text : check_given_trial(data, trial, files)) found.push_back(std::move(text));
  if (!files.lengths.empty())
    for (std::string& text : check_joint_of_arms(data, trial, files)) found.push_back(std::move(text));
  std::erase(found, "");
  return found;
}

}  // namespace

void check_given(const Study& study, const identification::StudyData& data, std::vector<TrialResult>& trials) {
  for (const identification::TrialData& trial : data.trials) {
    const auto result = std::ranges::find_if(trials, [&](const TrialResult& t) { return t.spec.name == trial.name; });
    if (result->spec.given == GivenSpec{}) continue;
    try {
      for (std::string& text : doubts(study, data, trial, *result))
        result->remarks.push_back({.code = RemarkCode::general, .says = std::move(text)});
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("{} (trial '{}')", error.what(), trial.name));
    }
  }
}

}  // namespace myoid
