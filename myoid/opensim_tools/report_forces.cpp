#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/index.h"
#include "myoid/dynamics/passive_forces.h"
#include "myoid/forces/actuator_columns.h"
#include "myoid/forces/driven_frame.h"
#include "myoid/forces/muscle_analysis.h"
#include "myoid/model/constraints.h"
#include "myoid/model/kinematic_tree.h"
#include "myoid/opensim_tools/analysis_reports.h"
#include "myoid/opensim_tools/model_controls.h"
#include "myoid/opensim_tools/opensim_files.h"

namespace myoid {
namespace {

struct ForceColumns {
  std::vector<Channel> channels;
  std::vector<Eigen::VectorXd> columns;
  void add(std::string name, Eigen::VectorXd values) {
    channels.push_back({std::move(name), Unit::dimensionless});
    columns.push_back(std::move(values));
  }
};

/// What OpenSim's force reporter records: actuators and passive forces in the order of the force
/// set, then nine columns for each external force: force and torque in ground, the point in its
/// body.
TimeSeries force_table(const AnalysisRun& run,
                       const model::BodyModel& model,
                       const TimeSeries& forces) {
  std::vector<std::string>& notes = run.result.notes;
  ForceColumns table;
  const Eigen::VectorXd& times = run.motion.q.time_s();
  for (const std::string& name : model.force_order) {
    if (const auto column = forces.find(name)) {
      table.add(name, forces.values().col(*column));
      continue;
    }
    for (const model::PassiveForce& force : model.passive_forces) {
      if (force.name != name) continue;
      if (const auto* limit = std::get_if<model::CoordinateLimitForce>(&force.law)) {
        Eigen::VectorXd values(times.size());
        for (Eigen::Index i = 0; i < values.size(); ++i) {
          values[i] = dynamics::limit_force(*limit, run.motion.q.values()(i, limit->coordinate),
                                            run.motion.qdot.values()(i, limit->coordinate));
        }
        table.add(name, std::move(values));
      } else {
        notes.push_back(
            fmt::format("force '{}' of class {} acts, but has no column among the forces", name,
                        force.class_name));
      }
    }
  }
  if (run.loads) {
    model::BodyState state = model::make_state(model);
    std::vector<Eigen::MatrixXd> all(run.loads->forces.size(), Eigen::MatrixXd(times.size(), 9));
    for (Eigen::Index i = 0; i < times.size(); ++i) {
      Eigen::VectorXd q = run.motion.q.values().row(i).transpose();
      if (!model.couplers.empty() || !model.constraints.empty()) q = model::assemble(model, q).q;
      model::compute_poses(model, q, state);
      for (std::size_t k = 0; k < all.size(); ++k) {
        const dynamics::ExternalForce& load = run.loads->forces[k];
        const Mat3& R = state.X_GB[at(load.force_frame)].R;
        const Vec3 zero = Vec3::Zero();
        const Vec3 f = load.force ? Vec3(R * load.force->at(times[i])) : zero;
        const Vec3 t = load.torque ? Vec3(R * load.torque->at(times[i])) : zero;
        // OpenSim reports the point in the frame of the body it acts on.
        const Pose X_BG = state.X_GB[at(load.body)].inverse();
        const Vec3 p =
            load.point ? Vec3(X_BG * (state.X_GB[at(load.point_frame)] * load.point->at(times[i])))
                       : zero;
        all[k].row(i) << f.transpose(), p.transpose(), t.transpose();
      }
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
      const dynamics::ExternalForce& load = run.loads->forces[k];
      const std::string stem = model.bodies[at(load.body)].name + "_" + load.name + "_";
      const char* names[] = {"Fx", "Fy", "Fz", "px", "py", "pz", "Tx", "Ty", "Tz"};
      for (Eigen::Index c = 0; c < 9; ++c) {
        const bool force = c < 6;
        if ((force && !load.force) || (!force && !load.torque)) continue;
        if (c >= 3 && c < 6 && !load.point) continue;
        table.add(stem + names[c], all[k].col(c));
      }
    }
  }
  Eigen::MatrixXd values(times.size(), static_cast<Eigen::Index>(table.columns.size()));
  for (Eigen::Index c = 0; c < values.cols(); ++c) values.col(c) = table.columns[at(c)];
  return {times, std::move(table.channels), std::move(values)};
}

}  // namespace

const TimeSeries& forces_of_states(AnalysisRun& run) {
  if (run.state_forces) return *run.state_forces;
  const std::vector<forces::Actuator> actuators = forces::actuators_of(run.model);
  Eigen::MatrixXd values =
      Eigen::MatrixXd::Zero(run.motion.sample_count(), static_cast<Eigen::Index>(actuators.size()));
  std::vector<Channel> channels;
  for (const forces::Actuator& a : actuators) channels.push_back({a.name, Unit::newton});
  forces::MuscleAnalysisOptions options{.equilibrium = run.equilibrium,
                                        .progress = run.options.progress};
  for (const forces::Actuator& a : actuators)
    if (a.kind == forces::Actuator::Kind::muscle)
      options.muscles.push_back(static_cast<int>(a.index));
  if (!options.muscles.empty()) {
    if (run.activation.size() > 0) options.activation = run.activation(run.rows, Eigen::all);
    if (run.fiber_length_m.size() > 0)
      options.fiber_length_m = run.fiber_length_m(run.rows, Eigen::all);
    const forces::MuscleAnalysis analysis = forces::muscle_analysis(run.model, run.motion, options);
    run.result.notes.insert(run.result.notes.end(), analysis.notes.begin(), analysis.notes.end());
    for (const auto& [name, table] : analysis.tables) {
      if (name != "TendonForce") continue;
      for (std::size_t k = 0; k < actuators.size(); ++k) {
        if (const auto column = table.find(actuators[k].name))
          values.col(static_cast<Eigen::Index>(k)) = table.values().col(*column);
      }
    }
  }
  const ModelControls controls = read_model_controls(run.setup, &run.result.notes);
  for (std::size_t k = 0; k < actuators.size(); ++k) {
    const auto control = controls.find(actuators[k].name);
    if (actuators[k].kind == forces::Actuator::Kind::muscle || control == controls.end()) continue;
    const double strength = forces::actuator_strength(run.model, actuators[k]);
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      values(i, static_cast<Eigen::Index>(k)) =
          strength * simulation::value_at(control->second, run.motion.q.time_s()[i]);
    }
  }
  run.state_forces.emplace(run.motion.q.time_s(), std::move(channels), std::move(values));
  return *run.state_forces;
}

const Eigen::MatrixXd* accelerations_of(AnalysisRun& run) {
  if (!run.accelerations) {
    std::vector<std::string>& notes = run.result.notes;
    try {
      run.accelerations = forces::driven_accelerations(
          run.model, run.motion, forces_of_states(run),
          {.loads = run.loads ? &*run.loads : nullptr, .progress = run.options.progress});
      notes.emplace_back(
          "accelerations are those that the forces make, as in OpenSim: muscles pull by their "
          "states, other actuators by their controls; they are not the motion's second "
          "derivatives");
    } catch (const ModelError& error) {
      run.accelerations.emplace();
      notes.push_back(fmt::format("accelerations are not written: {}", error.what()));
    }
  }
  return run.accelerations->size() > 0 ? &*run.accelerations : nullptr;
}

void write_forces(AnalysisRun& run,
                  const model::BodyModel& model,
                  const std::filesystem::path& path,
                  const TimeSeries& actuators) {
  write_opensim_storage(
      path, force_table(run, model, actuators),
      {.title = "ModelForces",
       .description =
           "\nThis file contains the forces exerted on a model during a simulation.\n\nA force is "
           "a "
           "generalized force, meaning that it can be either a force (N) or a torque "
           "(Nm).\n\nUnits "
           "are S.I. units (second, meters, Newtons, ...)\nIf the header above contains a line "
           "with "
           "'inDegrees', this indicates whether rotational values are in degrees (yes) or radians "
           "(no).\n\n",
       .decimals = run.decimals});
}

void report_forces(AnalysisRun& run, pugi::xml_node node) {
  const std::string name = analysis_name(node);
  if (run.setup.xml().flag(node, "include_constraint_forces", false)) {
    run.result.notes.push_back(
        fmt::format("{}: forces of constraints are not known here and not written", name));
  }
  write_forces(run, run.model, claim_result(run, name + "_forces.sto"), forces_of_states(run));
  run.result.frames = static_cast<int>(run.motion.sample_count());
}

}  // namespace myoid
