#include "myoid/body/kinematics/muscle_kinematics.h"

#include <atomic>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::body {
namespace {

/// Lengths, velocities and moment arms of all muscles, frames x muscles.
struct MuscleTables {
  MuscleTables(Eigen::Index frames, const body::BodyModel& model)
      : length(frames, std::ssize(model.muscles)),
        velocity(frames, std::ssize(model.muscles)),
        arms(model.coordinates.size(), Eigen::MatrixXd(frames, std::ssize(model.muscles))) {}

  Eigen::MatrixXd length, velocity;
  std::vector<Eigen::MatrixXd> arms;  ///< Per coordinate.
};

/// The muscles of one thread, frame by frame.
class MuscleFrames {
 public:
  MuscleFrames(const body::BodyModel& model, const std::vector<PathSurrogate>* surrogates, MuscleTables& tables)
      : model_(model),
        surrogates_(surrogates),
        tables_(tables),
        state_(body::make_state(model)),
        is_coupled_(!model.couplers.empty() || !model.constraints.empty()),
        by_speeds_(takes_rates_for_speeds(model)),
        surrogate_workspaces_(surrogates != nullptr ? surrogates->size() : 0) {}

  void compute(const JointMotion& motion, Eigen::Index frame) {
    body::compute_poses(model_, motion.q.values().row(frame).transpose(), state_);
    body::compute_velocities(model_, motion.qdot.values().row(frame).transpose(), state_);
    if (is_coupled_) coupling_ = body::coupling_matrix(model_, state_);
    if (by_speeds_) {
      const Eigen::MatrixXd N = rates_of_speeds(model_, state_.q);
      coupling_ = is_coupled_ ? Eigen::MatrixXd(coupling_ * N) : N;
    }
    for (std::size_t m = 0; m < model_.muscles.size(); ++m) {
      compute_path(m);
      if (is_coupled_ || by_speeds_) path_.moment_arm_m = (coupling_.transpose() * path_.moment_arm_m).eval();
      const auto column = static_cast<Eigen::Index>(m);
      tables_.length(frame, column) = path_.length_m;
      tables_.velocity(frame, column) = path_.speed_mps;
      for (std::size_t c = 0; c < tables_.arms.size(); ++c)
        tables_.arms[c](frame, column) = path_.moment_arm_m[static_cast<Eigen::Index>(c)];
    }
  }

  /// Returns the number of paths computed by polynomials.
  [[nodiscard]] long from_surrogates() const { return from_surrogates_; }

 private:
  void compute_path(std::size_t muscle) {
    const PathSurrogate* surrogate = surrogates_ ? &(*surrogates_)[muscle] : nullptr;
    if (surrogate && surrogate->within_tolerance && covers(model_, *surrogate, state_.q)) {
      evaluate(*surrogate, state_.q, state_.qdot, surrogate_workspaces_[muscle], path_);
      ++from_surrogates_;
    } else {
      body::compute_path(model_, model_.muscles[muscle].path, state_, workspace_, path_);
    }
  }

  const body::BodyModel& model_;
  const std::vector<PathSurrogate>* surrogates_;
  MuscleTables& tables_;
  body::BodyState state_;
  bool is_coupled_, by_speeds_;
  Eigen::MatrixXd coupling_;
  body::PathWorkspace workspace_;
  body::PathResult path_;
  std::vector<SurrogateWorkspace> surrogate_workspaces_;  ///< By muscle: degrees differ.
  long from_surrogates_ = 0;
};

std::vector<Channel> muscle_channels(const body::BodyModel& model, Unit unit) {
  std::vector<Channel> channels;
  for (const body::Muscle& muscle : model.muscles) channels.push_back({muscle.name, unit});
  return channels;
}

}  // namespace

MuscleKinematics muscle_kinematics(const body::BodyModel& model,
                                   const JointMotion& asked,
                                   const MuscleKinematicsOptions& options) {
  const JointMotion motion = moved_by_speeds(model, asked);
  if (options.surrogates && options.surrogates->size() != model.muscles.size()) {
    throw InvalidInput(fmt::format("expected a path surrogate for each of {} muscles, found {}", model.muscles.size(),
                                   options.surrogates->size()));
  }
  const Eigen::Index frames = motion.sample_count();
  MuscleTables tables(frames, model);
  std::atomic<long> from_surrogates = 0;
  std::atomic<Eigen::Index> done = 0;
  parallel_ranges<Eigen::Index>(frames, 64, [&](const auto& range) {
    MuscleFrames muscles(model, options.surrogates, tables);
    options.progress.check();
    for (Eigen::Index frame = range.begin(); frame != range.end(); ++frame) muscles.compute(motion, frame);
    from_surrogates += muscles.from_surrogates();
    done += static_cast<Eigen::Index>(range.size());
    options.progress.tell(static_cast<double>(done) / static_cast<double>(frames), "muscle paths");
  });
  const Eigen::VectorXd& time = motion.q.time_s();
  const std::vector<Channel> meters = muscle_channels(model, Unit::meter);
  MuscleKinematics result{TimeSeries(time, meters, std::move(tables.length)),
                          TimeSeries(time, muscle_channels(model, Unit::meter_per_second), std::move(tables.velocity)),
                          {},
                          from_surrogates};
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    if (model.coordinates[c].locked) continue;
    result.moment_arm.emplace(model.coordinates[c].name, TimeSeries(time, meters, std::move(tables.arms[c])));
  }
  return result;
}

}  // namespace myoid::body
