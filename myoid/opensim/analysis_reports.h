#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/forces/muscle_analysis.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/opensim/tool_stages.h"

namespace myoid::opensim {

/// The inputs and results that all analyses of one AnalyzeTool share.
struct AnalysisRun : ToolRun {
  body::BodyModel model{};
  body::JointMotion motion{};        ///< At the rows that the analysis records; its rates are OpenSim's speeds.
  body::JointMotion moved{};         ///< The motion of the bodies by these speeds (body/kinematics/angular_speeds.h).
  std::vector<Eigen::Index> rows{};  ///< Their numbers in the file.
  std::optional<body::ExternalLoads> loads{};
  int decimals = 8;
  bool equilibrium = false;
  /// From a states file, all rows x muscles; empty where it has none.
  Eigen::MatrixXd activation{}, fiber_length_m{};
  /// Kept for further analyses of the same rows (forces_of_states, accelerations_of).
  std::optional<TimeSeries> state_forces{};
  std::optional<Eigen::MatrixXd> accelerations{};

  [[nodiscard]] const body::ExternalLoads* loads_if_any() const { return loads ? &*loads : nullptr; }
};

/// Returns the analysis's name in the set-up, else its class.
[[nodiscard]] std::string analysis_name(pugi::xml_node node);

/// Returns true if an analysis of this class can be run.
[[nodiscard]] bool is_known_analysis(std::string_view class_name);
/// Each reports one analysis: it writes its files, <results>/<tool>_<analysis>_<quantity>.sto.
void report_kinematics(AnalysisRun& run, pugi::xml_node node);
void report_muscles(AnalysisRun& run, pugi::xml_node node);
void report_outputs(AnalysisRun& run, pugi::xml_node node);
void run_static_optimization(AnalysisRun& run, pugi::xml_node node);
/// Returns the model without muscles. Every independent coordinate has an actuator of unit strength
/// with the coordinate's name.
[[nodiscard]] body::BodyModel with_coordinate_actuators(body::BodyModel model);
/// Reports Actuation: forces, speeds and powers of muscles (by their states) and actuators.
void report_actuation(AnalysisRun& run, pugi::xml_node node);
/// Reports InverseDynamics: the forces that cause the motion's accelerations, with the least sum of squares of force by
/// strength. The forces are unbounded and act in muscles and actuators or in an actuator on every coordinate.
void report_inverse_dynamics(AnalysisRun& run, pugi::xml_node node);
/// Reports ForceReporter: muscles by their states, passive forces and external loads.
void report_forces(AnalysisRun& run, pugi::xml_node node);
/// Reports JointReaction: forces and moments that the joints carry.
void report_reactions(AnalysisRun& run, pugi::xml_node node);
/// Reports BodyKinematics: centers of mass, orientations, their velocities and accelerations.
void report_bodies(AnalysisRun& run, pugi::xml_node node);
/// Reports PointKinematics: place, velocity and acceleration of a point of a body, in the axes of another body.
void report_point(AnalysisRun& run, pugi::xml_node node);

/// Returns options to analyze muscles with their states at the motion's rows.
[[nodiscard]] body::MuscleAnalysisOptions muscle_options(const AnalysisRun& run);
/// Returns the forces of all actuators at the motion's rows: tendon forces of muscles by their
/// states, forces of other actuators by the set-up's controls, else 0. Computed once for the rows.
[[nodiscard]] const TimeSeries& forces_of_states(AnalysisRun& run);
/// Accelerations that these forces, passive forces, gravity and external loads make at the motion's
/// rows, as OpenSim's analyses report them: rows x coordinates [rad/s^2, m/s^2]. Null, with a note,
/// where a body without mass leaves them undetermined.
[[nodiscard]] const Eigen::MatrixXd* accelerations_of(AnalysisRun& run);
/// Writes the file of OpenSim's force reporter: the forces of `actuators` and the passive forces in
/// the order of the force set, then the external loads.
void write_forces(AnalysisRun& run,
                  const body::BodyModel& model,
                  const std::filesystem::path& path,
                  const TimeSeries& actuators);

/// Returns <results>/<tool>_<name>, announced as a file of the run.
[[nodiscard]] std::filesystem::path claim_result(AnalysisRun& run, const std::string& name);
/// Claims <results>/<tool>_<name> and writes the table there with the run's decimals.
void write_result(AnalysisRun& run, const std::string& name, const TimeSeries& table, OpensimFormat format);

/// Speeds of a file in the model's order, zero for a coordinate without a column; empty for a file without any speed.
/// Columns are named "<path>/speed" or "<coordinate>_u", in a file of speeds only also by the coordinate alone.
[[nodiscard]] std::optional<TimeSeries> read_speeds(const body::BodyModel& model,
                                                    const std::filesystem::path& path,
                                                    bool only_speeds,
                                                    std::vector<Remark>& remarks);
/// Fills `activation` and `fiber_length_m` from a states file that has them.
void read_muscle_states(AnalysisRun& run, const std::filesystem::path& path);

}  // namespace myoid::opensim
