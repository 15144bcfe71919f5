#pragma once

#include "myoid/dynamics/external_loads.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/opensim_tools/opensim_setup.h"
#include "myoid/opensim_tools/tool_result.h"

namespace myoid {

/// Runs one tool and fills the result. run_tool chooses the function.
void run_inverse_kinematics(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result);
void run_inverse_dynamics(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result);
void run_analyses(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result);
void run_scale(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result);

/// Returns the marker and coordinate tasks of an element with an <IKTaskSet> (inside, or in a file that it names) and,
/// for tasks from a file, a <coordinate_file>. Without any marker task every marker has equal weight.
[[nodiscard]] kinematics::IkOptions read_ik_tasks(const OpensimSetup& setup,
                                                  pugi::xml_node owner,
                                                  const model::BodyModel& model,
                                                  const recording::MarkerSeries& markers,
                                                  std::vector<std::string>& notes);

/// Adds a note if the loads of `file` do not cover all of these times.
void note_missing_loads(const dynamics::ExternalLoads& loads,
                        const std::filesystem::path& file,
                        const Eigen::VectorXd& times_s,
                        std::vector<std::string>& notes);

/// Returns every path of the model with the name of its owner: of muscles, path actuators, path springs and ligaments.
[[nodiscard]] std::vector<std::pair<std::string, const model::MusclePath*>> paths_of(const model::BodyModel& model);

/// Asks `claim` and remembers the file.
void claim_file(const ToolOptions& options, const std::filesystem::path& path, ToolResult& result);

}  // namespace myoid
