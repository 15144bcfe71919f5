#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "myoid/body/forces/static_optimization.h"
#include "myoid/body/model/opensim_defects/compat.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/remark.h"
#include "myoid/opensim/opensim_setup.h"

namespace myoid::opensim {

class ToolFolders;

struct ToolOptions {
  body::Compat compat = body::kOpenSim452;
  SetupFiles files{};     ///< Replacements of the files named in the set-up.
  bool anywhere = false;  ///< Writes outside the folder of the set-up too, where the set-up says so.
  Progress progress{};
  /// Called with each file before it is computed; throws to refuse it.
  std::function<void(const std::filesystem::path&)> claim{};
  body::InspectFrame inspect{};    ///< Static optimization, for checks.
  ToolFolders* folders = nullptr;  ///< Held by the caller for several runs, who finishes them; null: the run's own.
};

struct ToolResult {
  std::vector<std::filesystem::path> inputs;  ///< Read; never replaced.
  std::string tool;                           ///< "InverseKinematicsTool", ...
  std::vector<std::filesystem::path> files;   ///< Written, in order.
  int replaced = 0;                           ///< Number of files that replaced earlier results.
  /// Repairs and omissions, and what model, motion, torques and forces cannot be.
  std::vector<Remark> remarks;
  std::string summary;  ///< One line.
  int frames = 0;
  int frames_failed = 0;    ///< Without a converged or certified solution.
  bool wrong_unit = false;  ///< The markers are not in the unit that their file says.
};

}  // namespace myoid::opensim
