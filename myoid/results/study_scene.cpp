#include "myoid/results/study_scene.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/body/scene/model_meshes.h"
#include "myoid/body/scene/model_scene.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/study/study_model.h"

namespace myoid::results {
namespace {

/// Returns the activation by EMG of every muscle of the model that a [[muscle]] table lumps.
TimeSeries muscle_activation(const study::Study& study, const run::TrialResult& trial) {
  const TimeSeries& emg = trial.emg.activation;
  const std::vector<body::MuscleGroup> groups = study::muscle_groups(study, *trial.motion.model);
  std::vector<Channel> channels;
  std::vector<Eigen::Index> columns;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto column = emg.find(study.muscles[g].emg);
    if (!column) continue;
    for (const int m : groups[g].members) {
      channels.push_back({trial.motion.model->muscles[at(m)].name, Unit::dimensionless});
      columns.push_back(*column);
    }
  }
  return {emg.time_s(), std::move(channels), emg.values()(Eigen::all, columns)};
}

/// Adds the measured forces at the frames of the scene, turned into ground. A force below a newton
/// is left out, because its center of pressure is noise.
void add_loads(const run::TrialResult& trial, page::Scene& scene) {
  constexpr double kLeast_n = 1.0;
  if (!trial.input.loads) return;
  const auto& loads = *trial.input.loads;
  const bool of_file = loads.end_s > loads.start_s;  // another source has no limits
  for (const auto& load : loads.forces) {
    if (!load.force) continue;
    page::SceneLoad shown{load.name};
    shown.point_m.setConstant(scene.time_s.size(), 3, kNan);
    shown.force_n.setZero(scene.time_s.size(), 3);
    for (Eigen::Index f = 0; f < scene.time_s.size(); ++f) {
      const double t = scene.time_s[f];
      if (of_file && (t < loads.start_s || t > loads.end_s)) continue;
      const auto& poses = scene.poses[at(f)];
      const auto pose = [&](int body) { return poses[at(body)]; };
      const Vec3 force = pose(load.force_frame).R * load.force->at(loads.data_time_s(t));
      if (!force.allFinite() || force.norm() < kLeast_n) continue;
      const Pose frame = pose(load.point_frame);
      shown.force_n.row(f) = force.transpose();
      shown.point_m.row(f) =
          (load.point ? Vec3(frame.p + frame.R * load.point->at(loads.data_time_s(t))) : pose(load.body).p).transpose();
    }
    if (shown.point_m.array().isFinite().any()) scene.loads.push_back(std::move(shown));
  }
}

page::Scene trial_scene(const study::Study& study, const run::TrialResult& trial, int most_frames) {
  body::SceneInput input;
  input.name = trial.spec.name;
  input.q = trial.motion.joints.q;
  if (trial.input.markers) input.markers = &*trial.input.markers;
  if (!trial.forces.shared.force.empty()) input.colorings.push_back({"force", "N", trial.forces.shared.force});
  if (!trial.emg.activation.empty()) {
    TimeSeries activation = muscle_activation(study, trial);
    if (activation.channel_count() > 0) input.colorings.push_back({"EMG activation", "", std::move(activation)});
  }
  page::Scene scene = body::model_scene(*trial.motion.model, input, {.most_frames = most_frames});
  add_loads(trial, scene);
  return scene;
}

}  // namespace

page::ScenePage study_scenes(const run::StudyResult& result, int most_frames) {
  const bool none = result.source.study.model.is_none();
  const auto moving = [none](const run::TrialResult& trial) { return trial.has_motion() && !none; };
  const auto count = std::ranges::count_if(result.trials, moving);
  page::ScenePage page{.title = result.source.study.subject.name,
                       .subtitle = fmt::format("model {}, {} trials", result.source.model->name, count)};
  const int each = std::max(100, most_frames / static_cast<int>(std::max<std::ptrdiff_t>(1, count)));
  for (const run::TrialResult& trial : result.trials)
    if (moving(trial)) page.scenes.push_back(trial_scene(result.source.study, trial, std::min(1500, each)));
  if (result.source.study.model.file && !page.scenes.empty())
    body::add_meshes(body::load_meshes(result.source.model_text, *result.source.study.model.file), page);
  return page;
}

}  // namespace myoid::results
