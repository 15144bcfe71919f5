#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "myoid/opensim/run_tool.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// Options for a set-up file of one of OpenSim's tools. The tools take their times from that file.
struct RunToolOptions {
  Call call;
  std::string setup;          ///< .xml
  opensim::SetupFiles files;  ///< Instead of the set-up's own.
  bool anywhere = false;      ///< Writes outside the folder of the set-up too, where the set-up says so.
  body::Compatibility compat =
      body::Compatibility::opensim;         ///< Paths of muscles: as OpenSim 4.5.2 has them, or "exact".
  opensim::ToolFolders* folders = nullptr;  ///< As in ToolOptions, for several set-ups (run_tools.h).
};
void visit(RunToolOptions& options, study::SettingVisitor& v);
/// Visits the options that hold for several set-ups as for one.
void visit_setup_run(RunToolOptions& options, study::SettingVisitor& v);

struct RunToolResult {
  opensim::ToolResult tool;  ///< Names its written files.
  std::vector<Remark> remarks;

  /// Returns true if every frame was solved and the markers are in their file's stated unit.
  [[nodiscard]] bool good() const;
};

/// Runs the tool and writes its files. (OpenSim's names and folders stand in the set-up, so
/// reading, computing and writing are one call.) Throws as `myoid::run_tool`.
RunToolResult run_tool(const RunToolOptions& options);

/// Returns tool, summary, counts of frames, notes and files.
[[nodiscard]] nlohmann::ordered_json run_tool_object(const RunToolResult& result);
/// The same as JSON's text.
[[nodiscard]] std::string run_tool_json(const RunToolResult& result);

}  // namespace myoid::program
