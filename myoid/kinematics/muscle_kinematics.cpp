#include "myoid/kinematics/muscle_kinematics.h"

#include <atomic>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/parallel.h"
#include "myoid/model/constraints.h"
#include "myoid/model/kinematic_tree.h"
#include "myoid/model/muscle_path.h"

namespace myoid::kinematics {

MuscleKinematics muscle_kinematics(const model::BodyModel& model,
                                   const JointMotion& motion,
                                   const MuscleKinematicsOptions& options) {
  if (options.surrogates && options.surrogates->size() != model.muscles.size()) {
    throw InvalidInput(fmt::format("expected a path surrogate for each of {} muscles, found {}",
                                   model.muscles.size(), options.surrogates->size()));
  }
  const Eigen::Index frames = motion.sample_count();
  const auto muscles = static_cast<Eigen::Index>(model.muscles.size());
  const auto coordinates = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd length(frames, muscles);
  Eigen::MatrixXd velocity(frames, muscles);
  std::vector<Eigen::MatrixXd> arms(static_cast<std::size_t>(coordinates),
                                    Eigen::MatrixXd(frames, muscles));
  std::atomic<long> from_surrogates = 0;
  std::atomic<Eigen::Index> done = 0;
  parallel_ranges<Eigen::Index>(frames, 64, [&](const auto& range) {
    model::BodyState state = model::make_state(model);
    model::PathWorkspace workspace;
    model::PathResult path;
    SurrogateWorkspace surrogate_workspace;
    long replaced = 0;
    options.progress.check();
    const bool is_coupled = !model.couplers.empty() || !model.constraints.empty();
    Eigen::MatrixXd coupling;
    for (Eigen::Index frame = range.begin(); frame != range.end(); ++frame) {
      model::compute_poses(model, motion.q.values().row(frame).transpose(), state);
      model::compute_velocities(model, motion.qdot.values().row(frame).transpose(), state);
      if (is_coupled) coupling = model::coupling_matrix(model, state);
      for (Eigen::Index m = 0; m < muscles; ++m) {
        const auto number = static_cast<std::size_t>(m);
        const PathSurrogate* surrogate =
            options.surrogates ? &(*options.surrogates)[number] : nullptr;
        if (surrogate && surrogate->within_tolerance && covers(model, *surrogate, state.q)) {
          evaluate(*surrogate, state.q, state.qdot, surrogate_workspace, path);
          ++replaced;
        } else {
          model::compute_path(model, model.muscles[number].path, state, workspace, path);
        }
        if (is_coupled) path.moment_arm_m = (coupling.transpose() * path.moment_arm_m).eval();
        length(frame, m) = path.length_m;
        velocity(frame, m) = path.speed_mps;
        for (Eigen::Index c = 0; c < coordinates; ++c)
          arms[static_cast<std::size_t>(c)](frame, m) = path.moment_arm_m[c];
      }
    }
    from_surrogates += replaced;
    done += static_cast<Eigen::Index>(range.size());
    options.progress.tell(static_cast<double>(done) / static_cast<double>(frames), "muscle paths");
  });
  const auto channels = [&](Unit unit) {
    std::vector<Channel> result;
    for (const model::Muscle& muscle : model.muscles) result.push_back({muscle.name, unit});
    return result;
  };
  const Eigen::VectorXd& time = motion.q.time_s();
  MuscleKinematics result{TimeSeries(time, channels(Unit::meter), std::move(length)),
                          TimeSeries(time, channels(Unit::meter_per_second), std::move(velocity)),
                          {},
                          from_surrogates};
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    if (model.coordinates[c].locked) continue;
    result.moment_arm.emplace(model.coordinates[c].name,
                              TimeSeries(time, channels(Unit::meter), std::move(arms[c])));
  }
  return result;
}

}  // namespace myoid::kinematics
