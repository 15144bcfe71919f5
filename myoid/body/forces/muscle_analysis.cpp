#include "myoid/body/forces/muscle_analysis.h"

#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "myoid/body/forces/opensim_muscle.h"
#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::body {
namespace {

struct Quantity {
  const char* name;
  Unit unit;
};

constexpr std::array<Quantity, 18> kQuantities{{
    {"PennationAngle", Unit::radian},
    {"Length", Unit::meter},
    {"FiberLength", Unit::meter},
    {"NormalizedFiberLength", Unit::dimensionless},
    {"TendonLength", Unit::meter},
    {"FiberVelocity", Unit::meter_per_second},
    {"NormFiberVelocity", Unit::dimensionless},
    {"PennationAngularVelocity", Unit::radian_per_second},
    {"TendonForce", Unit::newton},
    {"FiberForce", Unit::newton},
    {"ActiveFiberForce", Unit::newton},
    {"PassiveFiberForce", Unit::newton},
    {"ActiveFiberForceAlongTendon", Unit::newton},
    {"PassiveFiberForceAlongTendon", Unit::newton},
    {"FiberActivePower", Unit::dimensionless},
    {"FiberPassivePower", Unit::dimensionless},
    {"TendonPower", Unit::dimensionless},
    {"MuscleActuatorPower", Unit::dimensionless},
}};

std::array<double, kQuantities.size()> quantities(const OpensimMuscle& muscle,
                                                  const OpensimMuscle::State& s,
                                                  const body::PathResult& path) {
  const body::MuscleProperties& p = muscle.properties();
  const double cosine = std::cos(s.pennation_rad);
  const double damping_n = s.passive_force_n - s.elastic_force_n;
  return {s.pennation_rad,
          path.length_m,
          s.fiber_length_m,
          s.fiber_length_m / p.optimal_fiber_length_m,
          s.tendon_length_m,
          s.fiber_velocity_mps,
          s.fiber_velocity_mps / (p.optimal_fiber_length_m * p.max_contraction_velocity),
          s.pennation_rate_radps,
          s.tendon_force_n,
          s.fiber_force_n,
          s.active_force_n,
          s.passive_force_n,
          s.active_force_n * cosine,
          s.passive_force_n * cosine,
          -(s.active_force_n + damping_n) * s.fiber_velocity_mps,
          -s.elastic_force_n * s.fiber_velocity_mps,
          -s.tendon_force_n * s.tendon_velocity_mps,
          -s.tendon_force_n * path.speed_mps};
}

void check_states(const MuscleAnalysisOptions& options, Eigen::Index frames, const body::BodyModel& model) {
  for (const Eigen::MatrixXd* table : {&options.activation, &options.fiber_length_m}) {
    if (table->size() > 0 &&
        (table->rows() != frames || table->cols() != static_cast<Eigen::Index>(model.muscles.size()))) {
      throw InvalidInput(fmt::format("muscle analysis: states of {} frames and {} muscles, expected {} and {}",
                                     table->rows(), table->cols(), frames, model.muscles.size()));
    }
  }
}

/// Adds a sentence for each muscle whose path or balance fails in some frames.
void note_failures(
    const std::string& muscle, int pathless, int unbalanced, Eigen::Index frames, std::vector<Remark>& notes) {
  if (pathless > 0) {
    notes.push_back({.severity = Severity::note,
                     .says = fmt::format("muscle '{}': its path has no length in {} of {} frames (NaN stands there)",
                                         muscle, pathless, frames)});
  }
  if (unbalanced > 0) {
    notes.push_back({.severity = Severity::note,
                     .says = fmt::format("muscle '{}': fiber and tendon could not be balanced in {} of {} frames",
                                         muscle, unbalanced, frames)});
  }
}

}  // namespace

MuscleAnalysis muscle_analysis(const body::BodyModel& model,
                               const body::JointMotion& asked,
                               const MuscleAnalysisOptions& options) {
  const body::JointMotion motion = body::moved_by_speeds(model, asked);
  MuscleAnalysis result;
  std::vector<int> chosen = options.muscles;
  if (chosen.empty()) {
    chosen.resize(model.muscles.size());
    std::iota(chosen.begin(), chosen.end(), 0);
  }
  std::vector<OpensimMuscle> muscles;
  muscles.reserve(chosen.size());
  for (const int m : chosen) {
    const body::Muscle& muscle = model.muscles.at(static_cast<std::size_t>(m));
    muscles.emplace_back(muscle, model.compat);
    if (!muscles.back().has_own_curves()) {
      result.notes.push_back(
          {.severity = Severity::note,
           .says = fmt::format("muscle '{}' of class {}: its fiber and tendon follow Thelen's curves", muscle.name,
                               muscle.class_name)});
    }
  }
  const Eigen::Index frames = motion.sample_count();
  check_states(options, frames, model);
  const auto count = static_cast<Eigen::Index>(chosen.size());
  const std::size_t arms = options.coordinates.size();
  std::vector<Eigen::MatrixXd> tables(2 * arms + kQuantities.size(), Eigen::MatrixXd(frames, count));
  std::vector<std::atomic<int>> unbalanced(chosen.size()), pathless(chosen.size());
  const bool by_speeds = body::takes_rates_for_speeds(model);
  const bool is_coupled = !model.couplers.empty() || !model.constraints.empty();
  parallel_ranges<Eigen::Index>(frames, 16, [&](const auto& range) {
    options.progress.check();
    body::BodyState state = body::make_state(model);
    body::PathWorkspace workspace;
    body::PathResult path;
    Eigen::MatrixXd coupling;
    for (Eigen::Index frame = range.begin(); frame != range.end(); ++frame) {
      Eigen::VectorXd q = motion.q.values().row(frame).transpose();
      if (is_coupled) q = body::assemble(model, q).q;
      body::compute_poses(model, q, state);
      body::compute_velocities(model, motion.qdot.values().row(frame).transpose(), state);
      if (is_coupled && arms > 0) coupling = body::coupling_matrix(model, state);
      if (by_speeds && arms > 0) {
        const Eigen::MatrixXd N = body::rates_of_speeds(model, q);
        coupling = is_coupled ? Eigen::MatrixXd(coupling * N) : N;
      }
      for (Eigen::Index k = 0; k < count; ++k) {
        const OpensimMuscle& muscle = muscles[at(k)];
        body::compute_path(model, model.muscles[at(chosen[at(k)])].path, state, workspace, path);
        if (!std::isfinite(path.length_m)) {
          ++pathless[at(k)];
          for (Eigen::MatrixXd& table : tables) table(frame, k) = std::nan("");
          continue;
        }
        const body::MuscleProperties& p = muscle.properties();
        const double activation =
            options.activation.size() > 0 ? options.activation(frame, chosen[at(k)]) : p.default_activation;
        const double length_m =
            options.fiber_length_m.size() > 0 ? options.fiber_length_m(frame, chosen[at(k)]) : p.default_fiber_length_m;
        const OpensimMuscle::State s =
            options.equilibrium ? muscle.equilibrium(activation, path.length_m, path.speed_mps)
                                : muscle.at_fiber_length(activation, length_m, path.length_m, path.speed_mps);
        if (!s.converged) ++unbalanced[at(k)];
        if (coupling.size() > 0) path.moment_arm_m = (coupling.transpose() * path.moment_arm_m).eval();
        for (std::size_t c = 0; c < arms; ++c) {
          const double arm = path.moment_arm_m[options.coordinates[c]];
          tables[c](frame, k) = arm;
          tables[arms + c](frame, k) = arm * s.tendon_force_n;
        }
        const auto values = quantities(muscle, s, path);
        for (std::size_t i = 0; i < values.size(); ++i) tables[2 * arms + i](frame, k) = values[i];
      }
    }
  });
  for (std::size_t k = 0; k < chosen.size(); ++k)
    note_failures(model.muscles[at(chosen[k])].name, pathless[k], unbalanced[k], frames, result.notes);
  const auto add = [&](const std::string& name, Unit unit, Eigen::MatrixXd& values) {
    std::vector<Channel> channels;
    for (const int m : chosen) channels.push_back({model.muscles[at(m)].name, unit});
    result.tables.emplace_back(name, TimeSeries(motion.q.time_s(), std::move(channels), std::move(values)));
  };
  for (const bool moments : {false, true}) {
    for (std::size_t c = 0; c < arms; ++c) {
      add((moments ? "Moment_" : "MomentArm_") + model.coordinates[at(options.coordinates[c])].name,
          moments ? Unit::newton_meter : Unit::meter, tables[c + (moments ? arms : 0)]);
    }
  }
  for (std::size_t i = 0; i < kQuantities.size(); ++i)
    add(kQuantities[i].name, kQuantities[i].unit, tables[2 * arms + i]);
  return result;
}

}  // namespace myoid::body
