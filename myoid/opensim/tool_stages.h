#pragma once

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/opensim/opensim_setup.h"
#include "myoid/opensim/tool_folders.h"
#include "myoid/opensim/tool_result.h"

namespace myoid::opensim {

/// One run of a tool: its set-up, the wishes of the caller, and the result that the run fills.
struct ToolRun {
  const OpensimSetup& setup;
  const ToolOptions& options;
  ToolResult& result;
  ToolFolders& folders;

  template <typename... T>
  void note(fmt::format_string<T...> text, T&&... values) const {
    result.remarks.push_back({.says = fmt::format(text, std::forward<T>(values)...)});
  }
  /// Adds what a reader chose, left out or repaired, as warnings.
  void add_notes(const std::vector<std::string>& texts) const;
  void add_notes(std::vector<Remark> notes) const;
  /// Adds the findings of a check on a file or a result; its name goes before each.
  void add_remarks(std::vector<Remark> found, const std::string& where) const;
  /// Remembers the file of a result. Throws InvalidInput if it is an input or stands outside the folder of the set-up,
  /// if another set-up writes it, if it would replace anything but a result of such a tool, or if `options.claim`
  /// throws.
  void claim(const std::filesystem::path& path) const;
};

/// Each runs one tool. run_tool chooses the function.
void run_inverse_kinematics(const ToolRun& run);
void run_inverse_dynamics(const ToolRun& run);
void run_analyses(const ToolRun& run);
void run_scale(const ToolRun& run);
/// Integrates the model from a row of its <states_file> (or its default state) under the controls of a
/// ControlSetController, and writes <name>_states.sto, _states_degrees.mot and _controls.sto. Throws ReadError for
/// loads on bodies, other controllers and controls of actuators that act on bodies.
void run_forward(const ToolRun& run);
/// Writes the model with the frames of inertial sensors, which follow from their first orientations on the model's
/// default posture. A sensor "<body>_imu" belongs to that body.
void run_imu_placer(const ToolRun& run);
/// Finds the motion that fits the sensors' orientations best, and the remaining angles.
void run_imu_inverse_kinematics(const ToolRun& run);

/// Returns the marker and coordinate tasks of an element with an <IKTaskSet> (inside, or in a file that it names) and,
/// for tasks from a file, a <coordinate_file>. Without any marker task every marker has equal weight.
[[nodiscard]] body::IkOptions read_ik_tasks(const OpensimSetup& setup,
                                            pugi::xml_node owner,
                                            const body::BodyModel& model,
                                            const MarkerSeries& markers,
                                            std::vector<Remark>& remarks);

/// Adds a note if the loads of `file` do not cover all of these times.
void note_missing_loads(const ToolRun& run,
                        const body::ExternalLoads& loads,
                        const std::filesystem::path& file,
                        const Eigen::VectorXd& times_s);

/// Returns every path of the model with the name of its owner: of muscles, path actuators, path springs and ligaments.
[[nodiscard]] std::vector<std::pair<std::string, const body::MusclePath*>> paths_of(const body::BodyModel& model);

/// Returns the bodies of a model in its default posture, which obeys the constraints.
[[nodiscard]] body::BodyState default_state(const body::BodyModel& model);

}  // namespace myoid::opensim
