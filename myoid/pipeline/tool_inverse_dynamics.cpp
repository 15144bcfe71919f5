#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/forces/muscle_analysis.h"
#include "myoid/pipeline/opensim_files.h"
#include "myoid/pipeline/tool_stages.h"
#include "myoid/signals/opensim_lowpass.h"

namespace myoid::pipeline {
namespace {

/// Generalized forces less the moments of the muscles whose fibers have their default lengths at
/// their default activations. Every coordinate is on its own, as everywhere in inverse dynamics.
TimeSeries without_muscles(const model::BodyModel& model,
                           const kinematics::JointMotion& motion,
                           const TimeSeries& tau,
                           const Progress& progress) {
  model::BodyModel uncoupled = model;
  uncoupled.couplers.clear();
  uncoupled.constraints.clear();
  forces::MuscleAnalysisOptions options{.equilibrium = false, .progress = progress};
  for (std::size_t m = 0; m < model.muscles.size(); ++m)
    if (model.muscles[m].applies_force) options.muscles.push_back(static_cast<int>(m));
  for (std::size_t c = 0; c < model.coordinates.size(); ++c)
    options.coordinates.push_back(static_cast<int>(c));
  if (options.muscles.empty()) return tau;
  Eigen::MatrixXd values = tau.values();
  const forces::MuscleAnalysis analysis = forces::muscle_analysis(uncoupled, motion, options);
  for (const auto& [name, table] : analysis.tables) {
    if (!name.starts_with("Moment_")) continue;
    values.col(model.coordinate_index(name.substr(7))) -= table.values().rowwise().sum();
  }
  return {tau.time_s(), tau.channels(), std::move(values)};
}

}  // namespace

void run_inverse_dynamics(const OpensimSetup& setup,
                          const ToolOptions& options,
                          ToolResult& result) {
  const auto& xml = setup.xml();
  const auto tool = setup.tool();
  const std::string file_name = xml.word(tool, "output_gen_force_file");
  const auto out =
      setup.results_folder() / (file_name.empty() ? "inverse_dynamics.sto" : file_name);
  claim_file(options, out, result);
  const auto excluded = xml.words(tool, "forces_to_exclude");
  const model::BodyModel model = setup_model(setup, options.compat, excluded, result.notes);
  if (!model.muscles.empty()) {
    result.notes.push_back(
        "forces_to_exclude does not name the muscles: as in OpenSim they pull with their default "
        "activations and fiber lengths");
  }
  if (!xml.words(tool, "joints_to_report_body_forces").empty())
    result.notes.push_back("joints_to_report_body_forces: body forces at joints are not written");
  const auto motion_file = setup.required_file(tool, "coordinates_file");
  TimeSeries q =
      read_coordinates(model, motion_file, MissingCoordinate::default_value, result.notes);
  const auto [start_s, end_s] = setup.time_range(tool, "time_range");
  setup.check_range({start_s, end_s}, q.time_s(), motion_file, result.notes);
  const double cutoff_hz = xml.number(tool, "lowpass_cutoff_frequency_for_coordinates", -1.0);
  if (cutoff_hz > 0.0) q = signals::opensim_lowpass(q, cutoff_hz);
  kinematics::JointMotion motion = kinematics::joint_motion(model, q).motion;
  const Eigen::Index first = row_at(motion.q.time_s(), start_s);
  const Eigen::Index last = row_at(motion.q.time_s(), end_s);
  motion = {rows_of(motion.q, first, last), rows_of(motion.qdot, first, last),
            rows_of(motion.qddot, first, last)};
  dynamics::InverseDynamicsOptions dynamics_options{.passive_forces = true};
  dynamics::ExternalLoads loads;
  if (const auto file = setup.file(tool, "external_loads_file")) {
    loads = dynamics::read_external_loads(model, *file);
    dynamics_options.loads = &loads;
    result.notes.insert(result.notes.end(), loads.notes.begin(), loads.notes.end());
    note_missing_loads(loads, *file, motion.q.time_s(), result.notes);
  }
  TimeSeries tau = dynamics::inverse_dynamics(model, motion, dynamics_options);
  if (!model.muscles.empty()) tau = without_muscles(model, motion, tau, options.progress);
  // OpenSim's columns are in the order of the tree.
  std::vector<std::string> columns;
  for (const model::Joint& joint : model.joints) {
    for (const int c : joint.coordinates)
      columns.push_back(
          dynamics::generalized_force_name(model.coordinates[static_cast<std::size_t>(c)]));
  }
  write_opensim_storage(out, tau.select(columns), {.title = "Inverse Dynamics Generalized Forces"});
  result.frames = static_cast<int>(tau.sample_count());
  result.summary = fmt::format("{} frames, {} generalized forces", result.frames, columns.size());
}

}  // namespace myoid::pipeline
