#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/program/commands/run_tool.h"

namespace myoid::program {

/// The end of a set-up among several.
enum class SetupStatus {
  done,
  gate_failed,  ///< Its files are written, but frames are not solved, or the unit of markers is wrong.
  failed,       ///< Bad input: `message` says which.
  not_run,      ///< It reads a result of an earlier call whose set-up failed in this call.
};

[[nodiscard]] std::string_view status_word(SetupStatus status);

struct SetupOutcome {
  std::string setup;  ///< Its name (NamedSetup).
  SetupStatus status = SetupStatus::failed;
  std::string message{};   ///< Why it failed or was not run.
  RunToolResult result{};  ///< If it ran.
};

/// Options for several set-up files of OpenSim's tools.
struct RunToolsOptions : RunToolOptions {
  std::vector<std::string> setups;                   ///< In place of `setup`: files (.xml) and folders of such files.
  std::function<void(const SetupOutcome&)> heard{};  ///< Called for each set-up that ended, one at a time.
};
void visit(RunToolsOptions& options, study::SettingVisitor& v);

/// Runs the set-ups in parallel: scaling first, then inverse kinematics, then the tools that read motions, then the
/// analyses that read forces, so that a set-up may read the result of another. A set-up that cannot run stops no other.
/// Every set-up has the numbers of `run_tool` on it alone. Throws InvalidInput for
/// files of one trial, as `list_setups`; Interrupted.
[[nodiscard]] std::vector<SetupOutcome> run_tools(const RunToolsOptions& options);

/// Returns the outcomes as JSON: a list of set-up, status, message and the fields of `run_tool_json`.
[[nodiscard]] std::string run_tools_json(const std::vector<SetupOutcome>& outcomes);

}  // namespace myoid::program
