#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/report/scene_page.h"

namespace myoid::commands {

/// A page that shows a model in the browser, moving.
struct ModelPageOptions {
  Call call;
  std::string model;                ///< A file (.osim), or "arm4".
  std::string compat = "exact";     ///< Paths: exact, or opensim.
  std::string motion;               ///< Joint angles (.mot, .sto); empty: the default posture.
  std::string forces, activations;  ///< To color the muscles by, along the motion (.sto).
  std::string markers;              ///< Measured ones to show beside the model's (.trc, .c3d).
  std::string up = "y";             ///< Vertical axis of the markers: x, y or z.
  std::vector<std::string> mesh_folders;  ///< Beside the model's folder and its Geometry.
};

struct ModelPageResult {
  report::ScenePage page;  ///< With one scene.
  std::string html;
  std::vector<Remark> remarks;
};

/// Throws InvalidInput where forces, activations or markers come without a motion.
[[nodiscard]] ModelPageResult model_page(const ModelPageOptions& options);

/// Writes the page: one file, which works offline.
void write_model_page(const ModelPageResult& result, const std::filesystem::path& path);

}  // namespace myoid::commands
