#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/dynamics/torque_plausibility.h"
#include "myoid/body/forces/muscle_analysis.h"
#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/named_file.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/opensim/tool_stages.h"
#include "myoid/recording/signals/opensim_lowpass.h"

namespace myoid::opensim {
namespace {

/// Subtracts the moments of the muscles at their default fiber lengths and activations from the
/// generalized forces. Every coordinate counts alone, as everywhere in inverse dynamics.
TimeSeries without_muscles(const body::BodyModel& model,
                           const body::JointMotion& motion,
                           const TimeSeries& tau,
                           const Progress& progress) {
  body::BodyModel uncoupled = model;
  uncoupled.couplers.clear();
  uncoupled.constraints.clear();
  body::MuscleAnalysisOptions options{.equilibrium = false, .progress = progress};
  for (std::size_t m = 0; m < model.muscles.size(); ++m)
    if (model.muscles[m].applies_force) options.muscles.push_back(static_cast<int>(m));
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) options.coordinates.push_back(static_cast<int>(c));
  if (options.muscles.empty()) return tau;
  Eigen::MatrixXd values = tau.values();
  const body::MuscleAnalysis analysis = body::muscle_analysis(uncoupled, motion, options);
  for (const auto& [name, table] : analysis.tables) {
    if (!name.starts_with("Moment_")) continue;
    values.col(model.coordinate_index(name.substr(7))) -= table.values().rowwise().sum();
  }
  return {tau.time_s(), tau.channels(), std::move(values)};
}

/// Notes the difference between OpenSim's moments, computed with rates of angles as angular
/// velocities, and the exact ones.
void note_angular_speeds(const ToolRun& run,
                         const body::BodyModel& model,
                         const body::JointMotion& motion,
                         const body::InverseDynamicsOptions& options,
                         const TimeSeries& tau) {
  const std::vector<int> joints = body::angular_speed_joints(model);
  if (joints.empty()) return;
  const bool as_opensim = body::takes_rates_for_speeds(model);
  body::BodyModel other = model;
  other.compat = as_opensim ? body::Compat{} : body::kOpenSim452;
  const TimeSeries others = body::inverse_dynamics(other, motion, options);
  const Eigen::MatrixXd difference = (tau.values() - others.values()).cwiseAbs();
  Eigen::Index row = 0, column = 0;
  const double largest = difference.maxCoeff(&row, &column);
  std::string names;
  for (const int j : joints) {
    const body::Joint& joint = model.joints[at(j)];
    names += fmt::format("{}'{}' ({})", names.empty() ? "" : ", ", joint.name, joint.class_name);
  }
  run.note(
      "joints {}: OpenSim takes the rates of their angles for angular velocities; {}; the largest "
      "difference is {:.3g} {}, {} at {:.4g} s",
      names, as_opensim ? "so does this result, --compat exact does not" : "this result does not", largest,
      tau.channels()[at(column)].unit == Unit::newton ? "N" : "N m", tau.channels()[at(column)].name,
      tau.time_s()[row]);
}

/// Returns the file of the result. As in OpenSim a folder in its name does not count, and the
/// default extension is .sto.
std::filesystem::path force_file(const ToolRun& run) {
  const std::string text = run.setup.xml().word(run.setup.tool(), "output_gen_force_file");
  std::filesystem::path name = last_part(text.empty() ? "inverse_dynamics" : text);
  if (name.extension().empty()) name += ".sto";
  const auto path = run.setup.results_folder() / name;
  if (text.find_first_of("/\\") != std::string::npos) {
    run.note("<output_gen_force_file> '{}': only the name of the file counts, as in OpenSim; it is {}", text,
             path.string());
  }
  return path;
}

}  // namespace

void run_inverse_dynamics(const ToolRun& run) {
  const OpensimSetup& setup = run.setup;
  const ToolOptions& options = run.options;
  ToolResult& result = run.result;
  const auto& xml = setup.xml();
  const auto tool = setup.tool();
  const auto out = force_file(run);
  run.claim(out);
  const auto excluded = xml.words(tool, "forces_to_exclude");
  const body::BodyModel model = setup_model(setup, options.compat, excluded, result.remarks);
  if (!model.muscles.empty()) {
    result.remarks.push_back({.says = options.compat.class_fiber_length
                                          ? "forces_to_exclude does not name the muscles: as in OpenSim they pull with "
                                            "their default activations and "
                                            "fiber lengths (0.1 m where the model gives none)"
                                          : "forces_to_exclude does not name the muscles: they pull with their default "
                                            "activations and fiber lengths "
                                            "(optimal ones where the model gives none; OpenSim takes 0.1 m)"});
  }
  if (!xml.words(tool, "joints_to_report_body_forces").empty())
    run.note("joints_to_report_body_forces: body forces at joints are not written");
  const auto motion_file = setup.required_file(tool, "coordinates_file");
  TimeSeries q = read_coordinates(model, motion_file, MissingCoordinate::default_value, result.remarks);
  run.add_remarks(body::implausible(model), setup.required_file(tool, "model_file").string());
  run.add_remarks(body::implausible_motion(q), motion_file.string());
  const auto [start_s, end_s] = setup.time_range(tool, "time_range");
  setup.check_range({start_s, end_s}, q.time_s(), motion_file, result.remarks);
  const double cutoff_hz = xml.number(tool, "lowpass_cutoff_frequency_for_coordinates", -1.0);
  if (cutoff_hz > 0.0) q = recording::opensim_lowpass(q, cutoff_hz);
  body::JointMotion motion = body::joint_motion(model, q).motion;
  run.add_notes(body::held_notes(model, q, body::HeldValues::of_motion));
  const Eigen::VectorXd& times = motion.q.time_s();
  motion = rows_of(motion, Eigen::seq(row_at(times, start_s), row_at(times, end_s)));
  body::InverseDynamicsOptions dynamics_options{.passive_forces = true};
  body::ExternalLoads loads;
  if (const auto file = setup.file(tool, "external_loads_file")) {
    loads = body::read_external_loads(model, *file);
    dynamics_options.loads = &loads;
    run.add_notes(loads.notes);
    note_missing_loads(run, loads, *file, motion.q.time_s());
  }
  TimeSeries tau = body::inverse_dynamics(model, motion, dynamics_options);
  run.add_remarks(body::implausible_torques(model, tau), motion_file.string());
  note_angular_speeds(run, model, motion, dynamics_options, tau);
  if (!model.muscles.empty()) tau = without_muscles(model, motion, tau, options.progress);
  // OpenSim's columns are in the order of the tree.
  std::vector<std::string> columns;
  for (const body::Joint& joint : model.joints) {
    for (const int c : joint.coordinates) columns.push_back(body::generalized_force_name(model.coordinates[at(c)]));
  }
  write_opensim_storage(out, tau.select(columns), {.title = "Inverse Dynamics Generalized Forces"});
  result.frames = static_cast<int>(tau.sample_count());
  result.summary = fmt::format("{} frames, {} generalized forces", result.frames, columns.size());
}

}  // namespace myoid::opensim
