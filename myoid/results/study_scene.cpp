#include "myoid/results/study_scene.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/scene/model_meshes.h"
#include "myoid/scene/model_scene.h"
#include "myoid/study/study_model.h"

namespace myoid {
namespace {

/// Returns the EMG's activation of every muscle of the model that a [[muscle]] table lumps.
TimeSeries muscle_activation(const Study& study, const TrialResult& trial) {
  const TimeSeries& emg = trial.emg.activation;
  const std::vector<kinematics::MuscleGroup> groups = muscle_groups(study, *trial.motion.model);
  std::vector<Channel> channels;
  std::vector<Eigen::Index> columns;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto column = emg.find(study.muscles[g].emg);
    if (!column) continue;
    for (const int m : groups[g].members) {
      channels.push_back(
          {trial.motion.model->muscles[static_cast<std::size_t>(m)].name, Unit::dimensionless});
      columns.push_back(*column);
    }
  }
  return {emg.time_s(), std::move(channels), emg.values()(Eigen::all, columns)};
}

report::Scene trial_scene(const Study& study, const TrialResult& trial, int most_frames) {
  SceneInput input;
  input.name = trial.spec.name;
  input.q = trial.motion.joints.q;
  if (trial.input.markers) input.markers = &*trial.input.markers;
  if (!trial.forces.shared.force.empty())
    input.colorings.push_back({"force", "N", trial.forces.shared.force});
  if (!trial.emg.activation.empty()) {
    TimeSeries activation = muscle_activation(study, trial);
    if (activation.channel_count() > 0)
      input.colorings.push_back({"EMG activation", "", std::move(activation)});
  }
  return model_scene(*trial.motion.model, input, {.most_frames = most_frames});
}

}  // namespace

report::ScenePage study_scenes(const StudyResult& result, int most_frames) {
  const auto moving = [](const TrialResult& trial) { return trial.has_motion(); };
  const auto count = std::count_if(result.trials.begin(), result.trials.end(), moving);
  report::ScenePage page{
      .title = result.source.study.subject.name,
      .subtitle = fmt::format("model {}, {} trials", result.source.model->name, count)};
  const int each =
      std::max(100, most_frames / static_cast<int>(std::max<std::ptrdiff_t>(1, count)));
  for (const TrialResult& trial : result.trials)
    if (moving(trial))
      page.scenes.push_back(trial_scene(result.source.study, trial, std::min(1500, each)));
  if (result.source.study.model.file && !page.scenes.empty())
    add_meshes(load_meshes(result.source.model_text, *result.source.study.model.file), page);
  return page;
}

}  // namespace myoid
