#pragma once

#include <string>
#include <vector>

#include "myoid/page/scene.h"

namespace myoid::page {

/// Returns scenes of one or several models as one HTML file that works offline: the viewer with a choice of the scene,
/// and the scenes as JSON with their arrays in base64 (packing.h). Calls `validate`. Throws InvalidInput without a
/// scene, for a mesh that is not there or has corners without vertices, or if the program was built without three.js.
struct ScenePage {
  std::string title;
  std::string subtitle;
  std::vector<Scene> scenes = {};
  std::vector<SceneMesh> meshes = {};  ///< Meshes of the scenes' bodies, each once.
};
[[nodiscard]] std::string scene_page(const ScenePage& page);

/// Returns the scenes of a page as JSON that may stand inside a <script> element. Calls `validate`.
/// Throws InvalidInput as `scene_page` for meshes.
[[nodiscard]] std::string scenes_json(const ScenePage& page);

/// Returns true if this build includes the viewer that `scene_page` needs.
[[nodiscard]] bool has_viewer();

}  // namespace myoid::page
