#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/remark.h"
#include "myoid/page/scene_page.h"
#include "myoid/recording/mesh_reader.h"

namespace myoid::body {

/// A mesh file with which a model draws a body.
struct MeshUse {
  std::string file;  ///< As the model names it: "femur.vtp".
  body::BodyIndex body = 0;
  Pose X_BM;
  Vec3 scale = Vec3::Ones();
};

/// Returns the meshes that a model file attaches to its bodies and to frames fixed on them (Mesh of
/// documents since 30500, DisplayGeometry before). Throws ReadError if the text is no model.
[[nodiscard]] std::vector<MeshUse> list_meshes(std::string_view osim, const std::filesystem::path& path);

/// A body's surface, in the body [m].
struct BodyMesh {
  body::BodyIndex body = 0;
  recording::TriangleMesh mesh;
};

struct LoadedMeshes {
  std::vector<BodyMesh> meshes;
  std::vector<Remark> notes;  ///< Meshes not found, unreadable or simplified.
};

struct MeshOptions {
  /// Folders searched after the model's folder and its subfolder Geometry.
  std::vector<std::filesystem::path> folders = {};
  int most_triangles = 60000;  ///< Limit for all meshes together; beyond, they are simplified.
};

/// Gives the scenes of a page the model's meshes, and the notes.
void add_meshes(const LoadedMeshes& loaded, page::ScenePage& page);

/// Reads the meshes whose files exist, in the body. A model without any of its files gives no note,
/// because models usually come without them.
[[nodiscard]] LoadedMeshes load_meshes(std::string_view osim,
                                       const std::filesystem::path& path,
                                       const MeshOptions& options = {});

}  // namespace myoid::body
