#include <array>
#include <utility>

#include "myoid/body/dynamics/passive_forces.h"
#include "myoid/body/forces/actuator_columns.h"
#include "myoid/body/forces/driven_frame.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/opensim/analysis_reports.h"
#include "myoid/opensim/model_controls.h"
#include "myoid/opensim/moving_bodies.h"

namespace myoid::opensim {
namespace {

/// Returns the force of a coordinate's limits at every time.
Eigen::VectorXd limit_forces(const AnalysisRun& run, const body::CoordinateLimitForce& limit) {
  Eigen::VectorXd values(run.motion.sample_count());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = body::limit_force(limit, run.motion.q.values()(i, limit.coordinate),
                                  run.motion.qdot.values()(i, limit.coordinate));
  }
  return values;
}

/// Adds the columns of the passive forces of a name. Only limit forces have one.
void add_passive(const AnalysisRun& run, const body::BodyModel& model, const std::string& name, ColumnTable& table) {
  for (const body::PassiveForce& force : model.passive_forces) {
    if (force.name != name) continue;
    if (const auto* limit = std::get_if<body::CoordinateLimitForce>(&force.law)) {
      table.add(name, Unit::dimensionless, limit_forces(run, *limit));
    } else {
      run.note("force '{}' of class {} acts, but has no column among the forces", name, force.class_name);
    }
  }
}

/// Returns the force, point and torque of an external force: force and torque in ground, the point
/// in the body that the force acts on, as OpenSim reports them. Zero where the force has none.
Eigen::Matrix<double, 1, 9> load_row(const body::ExternalForce& load, const MovingBodies& moving, double time_s) {
  const Mat3& R = moving.pose(at(load.force_frame)).R;
  const Vec3 zero = Vec3::Zero();
  const Vec3 f = load.force ? Vec3(R * load.force->at(time_s)) : zero;
  const Vec3 t = load.torque ? Vec3(R * load.torque->at(time_s)) : zero;
  const Pose X_BG = moving.pose(at(load.body)).inverse();
  const Vec3 p = load.point ? Vec3(X_BG * (moving.pose(at(load.point_frame)) * load.point->at(time_s))) : zero;
  Eigen::Matrix<double, 1, 9> row;
  row << f.transpose(), p.transpose(), t.transpose();
  return row;
}

/// Adds the columns of the external forces.
void add_loads(const std::vector<body::ExternalForce>& loads,
               const body::BodyModel& model,
               const body::JointMotion& motion,
               ColumnTable& table) {
  const Eigen::VectorXd& times = motion.q.time_s();
  std::vector<Eigen::MatrixXd> values(loads.size(), Eigen::MatrixXd(times.size(), 9));
  MovingBodies moving(model, motion);
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    moving.set(i);
    for (std::size_t k = 0; k < loads.size(); ++k) values[k].row(i) = load_row(loads[k], moving, times[i]);
  }
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const body::ExternalForce& load = loads[k];
    const std::string stem = model.bodies[at(load.body)].name + "_" + load.name + "_";
    const auto add = [&](bool known, Eigen::Index column, std::array<const char*, 3> names) {
      if (!known) return;
      for (const char* name : names) table.add(stem + name, Unit::dimensionless, values[k].col(column++));
    };
    add(load.force.has_value(), 0, {"Fx", "Fy", "Fz"});
    add(load.force && load.point, 3, {"px", "py", "pz"});
    add(load.torque.has_value(), 6, {"Tx", "Ty", "Tz"});
  }
}

/// Returns the table of OpenSim's force reporter.
TimeSeries force_table(const AnalysisRun& run, const body::BodyModel& model, const TimeSeries& forces) {
  ColumnTable table;
  for (const std::string& name : model.force_order) {
    if (const auto column = forces.find(name)) {
      table.add(name, Unit::dimensionless, forces.values().col(*column));
    } else {
      add_passive(run, model, name, table);
    }
  }
  if (run.loads) add_loads(run.loads->forces, model, run.moved, table);
  return table.at_times(run.motion.q.time_s());
}

}  // namespace

body::MuscleAnalysisOptions muscle_options(const AnalysisRun& run) {
  body::MuscleAnalysisOptions options{.equilibrium = run.equilibrium, .progress = run.options.progress};
  if (run.activation.size() > 0) options.activation = run.activation(run.rows, Eigen::all);
  if (run.fiber_length_m.size() > 0) options.fiber_length_m = run.fiber_length_m(run.rows, Eigen::all);
  return options;
}

const TimeSeries& forces_of_states(AnalysisRun& run) {
  if (run.state_forces) return *run.state_forces;
  const std::vector<body::Actuator> actuators = body::actuators_of(run.model);
  Eigen::MatrixXd values =
      Eigen::MatrixXd::Zero(run.motion.sample_count(), static_cast<Eigen::Index>(actuators.size()));
  std::vector<Channel> channels;
  for (const body::Actuator& a : actuators) channels.push_back({a.name, Unit::newton});
  body::MuscleAnalysisOptions options = muscle_options(run);
  for (const body::Actuator& a : actuators)
    if (a.kind == body::Actuator::Kind::muscle) options.muscles.push_back(static_cast<int>(a.index));
  if (!options.muscles.empty()) {
    const body::MuscleAnalysis analysis = body::muscle_analysis(run.model, run.motion, options);
    run.add_notes(analysis.notes);
    for (const auto& [name, table] : analysis.tables) {
      if (name != "TendonForce") continue;
      for (std::size_t k = 0; k < actuators.size(); ++k) {
        if (const auto column = table.find(actuators[k].name))
          values.col(static_cast<Eigen::Index>(k)) = table.values().col(*column);
      }
    }
  }
  const ModelControls controls = read_model_controls(run.setup, &run.result.remarks);
  for (std::size_t k = 0; k < actuators.size(); ++k) {
    const auto control = controls.find(actuators[k].name);
    if (actuators[k].kind == body::Actuator::Kind::muscle || control == controls.end()) continue;
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      values(i, static_cast<Eigen::Index>(k)) =
          actuators[k].strength * body::value_at(control->second, run.motion.q.time_s()[i]);
    }
  }
  run.state_forces.emplace(run.motion.q.time_s(), std::move(channels), std::move(values));
  return *run.state_forces;
}

const Eigen::MatrixXd* accelerations_of(AnalysisRun& run) {
  if (!run.accelerations) {
    try {
      run.accelerations = body::driven_accelerations(run.model, run.moved, forces_of_states(run),
                                                     {.loads = run.loads_if_any(), .progress = run.options.progress});
      run.note(
          "accelerations follow from the forces, as in OpenSim, and differ from the motion's second derivatives: "
          "muscles pull by their states, other actuators by their controls");
    } catch (const ModelError& error) {
      run.accelerations.emplace();
      run.note("accelerations are not written: {}", error.what());
    }
  }
  return run.accelerations->size() > 0 ? &*run.accelerations : nullptr;
}

void write_forces(AnalysisRun& run,
                  const body::BodyModel& model,
                  const std::filesystem::path& path,
                  const TimeSeries& actuators) {
  write_opensim_storage(
      path, force_table(run, model, actuators),
      {.title = "ModelForces",
       .description = std::string("\nThis file contains the forces exerted on a model during a simulation.\n\nA force "
                                  "is a generalized force, meaning that it can be either a force (N) or a torque "
                                  "(Nm).\n\n") +
                      kUnitsNote,
       .decimals = run.decimals});
}

void report_forces(AnalysisRun& run, pugi::xml_node node) {
  const std::string name = analysis_name(node);
  if (run.setup.xml().flag(node, "include_constraint_forces", false)) {
    run.note("{}: forces of constraints are not computed and not written", name);
  }
  write_forces(run, run.model, claim_result(run, name + "_forces.sto"), forces_of_states(run));
}

}  // namespace myoid::opensim
