#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/dynamics/passive_forces.h"
#include "myoid/forces/static_optimization.h"
#include "myoid/model/constraints.h"
#include "myoid/model/kinematic_tree.h"
#include "myoid/pipeline/analysis_reports.h"
#include "myoid/pipeline/opensim_files.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/text_file.h"

namespace myoid::pipeline {
namespace {

std::size_t at(Eigen::Index index) { return static_cast<std::size_t>(index); }

/// Instead of the muscles an actuator of unit strength on every free coordinate, named like it.
model::BodyModel with_coordinate_actuators(model::BodyModel model) {
  model.muscles.clear();
  std::vector<model::CoordinateActuator> own;
  std::vector<std::string> order;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    if (model.is_constrained(static_cast<int>(c))) continue;
    model::CoordinateActuator actuator;
    actuator.name = model.coordinates[c].name;
    actuator.coordinate = static_cast<int>(c);
    order.push_back(actuator.name);
    own.push_back(std::move(actuator));
  }
  model.actuators.insert(model.actuators.begin(), own.begin(), own.end());
  model.force_order.insert(model.force_order.begin(), order.begin(), order.end());
  return model;
}

struct Table {
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
                       const TimeSeries& forces,
                       std::vector<std::string>& notes) {
  Table table;
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

/// The controls as piecewise linear functions of time, as forward simulations read them.
std::string controls_text(const TimeSeries& controls) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40500\">\n"
      "\t<ControlSet name=\"Static Optimization\">\n\t\t<objects>\n";
  std::vector<std::string> times;
  for (const double t : controls.time_s()) times.push_back(recording::format_number(t));
  for (Eigen::Index c = 0; c < controls.channel_count(); ++c) {
    text += fmt::format(
        "\t\t\t<ControlLinear name=\"{}\">\n\t\t\t\t<is_model_control>true</is_model_control>\n"
        "\t\t\t\t<extrapolate>true</extrapolate>\n\t\t\t\t<default_min>0.02</default_min>\n"
        "\t\t\t\t<default_max>1</default_max>\n\t\t\t\t<filter_on>false</filter_on>\n"
        "\t\t\t\t<use_steps>false</use_steps>\n\t\t\t\t<x_nodes>\n",
        controls.channels()[at(c)].name);
    for (Eigen::Index i = 0; i < controls.sample_count(); ++i) {
      text += "\t\t\t\t\t<ControlLinearNode>\n\t\t\t\t\t\t<t>";
      text += times[at(i)];
      text += "</t>\n\t\t\t\t\t\t<value>";
      text += recording::format_number(controls.values()(i, c));
      text += "</value>\n\t\t\t\t\t</ControlLinearNode>\n";
    }
    text +=
        "\t\t\t\t</x_nodes>\n\t\t\t\t<min_nodes />\n\t\t\t\t<max_nodes />\n"
        "\t\t\t\t<kp>100</kp>\n\t\t\t\t<kv>20</kv>\n\t\t\t</ControlLinear>\n";
  }
  return text + "\t\t</objects>\n\t\t<groups />\n\t</ControlSet>\n</OpenSimDocument>\n";
}

}  // namespace

void run_static_optimization(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  auto& notes = run.result.notes;
  std::string name = model::OsimXml::name_of(node);
  if (name.empty()) name = node.name();
  const auto activation_file = claim_result(run, name + "_activation.sto");
  const auto force_file = claim_result(run, name + "_force.sto");
  const auto controls_file = claim_result(run, name + "_controls.xml");
  const bool use_forces =
      xml.flag(node, "use_model_force_set", xml.flag(node, "use_model_actuator_set", true));
  const model::BodyModel model = use_forces ? run.model : with_coordinate_actuators(run.model);
  const forces::StaticOptimizationOptions options{
      .exponent = xml.number(node, "activation_exponent", 2.0),
      .muscle_physiology = xml.flag(node, "use_muscle_physiology", true),
      .loads = run.loads ? &*run.loads : nullptr,
      .progress = run.options.progress,
      .inspect = run.options.inspect};
  if (!(options.exponent > 1.0)) {
    xml.fail(
        xml.property(node, "activation_exponent"),
        fmt::format("<activation_exponent> {}, expected above 1: only then are the activations "
                    "determined",
                    options.exponent));
  }
  const forces::StaticOptimizationResult solved =
      forces::static_optimization(model, run.motion, options);
  notes.insert(notes.end(), solved.notes.begin(), solved.notes.end());
  const TimeSeries forces = force_table(run, model, solved.force, notes);
  write_opensim_storage(activation_file, solved.control,
                        {.title = "Static Optimization",
                         .description = "This file contains static optimization results.\n\n",
                         .decimals = run.decimals});
  write_opensim_storage(
      force_file, forces,
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
  recording::write_file(controls_file, controls_text(solved.control), recording::Flush::later);
  const auto infeasible = std::count(solved.is_feasible.begin(), solved.is_feasible.end(), false);
  if (infeasible > 0) {
    notes.push_back(fmt::format(
        "in {} frames, from {} s, muscles and actuators cannot make the accelerations; the "
        "controls "
        "that come nearest are written. Append stronger reserve actuators (<force_set_files>)",
        infeasible,
        run.motion.q
            .time_s()[std::find(solved.is_feasible.begin(), solved.is_feasible.end(), false) -
                      solved.is_feasible.begin()]));
  }
  run.result.frames = static_cast<int>(run.motion.sample_count());
  run.result.frames_failed = solved.frames_failed;
  run.result.summary = fmt::format(
      "{} frames, {} without certificate; largest KKT residual {:.1e}", run.result.frames,
      solved.frames_failed, solved.kkt_residual.size() > 0 ? solved.kkt_residual.maxCoeff() : 0.0);
}

}  // namespace myoid::pipeline
