#include "myoid/body/scene/model_meshes.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/osim/osim_frames.h"
#include "myoid/body/osim/osim_updater.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

namespace fs = std::filesystem;
using body::FixedFrame;
using body::OsimReading;
using body::OsimXml;

/// Adds <attached_geometry> of a body or a frame.
void add_attached(const OsimReading& r, pugi::xml_node owner, const FixedFrame& frame, std::vector<MeshUse>& uses) {
  for (const auto mesh : owner.child("attached_geometry").children("Mesh")) {
    const std::string file = r.xml.word(mesh, "mesh_file");
    if (!file.empty() && r.xml.flag(mesh.child("Appearance"), "visible", true))
      uses.push_back({file, frame.body, frame.X_BF, r.xml.vec3(mesh, "scale_factors", Vec3::Ones())});
  }
}

std::optional<fs::path> find_file(const std::string& file, const fs::path& model_folder, const MeshOptions& options) {
  std::vector<fs::path> places{model_folder, model_folder / "Geometry"};
  places.insert(places.end(), options.folders.begin(), options.folders.end());
  std::error_code ignored;
  for (const fs::path& place : places)
    if (fs::is_regular_file(place / file, ignored)) return place / file;
  return std::nullopt;
}

recording::TriangleMesh in_body(recording::TriangleMesh mesh, const MeshUse& use) {
  for (Vec3& p : mesh.vertices) p = use.X_BM * Vec3(p.cwiseProduct(use.scale));
  // A mirrored mesh would show its inside: its triangles are turned over.
  if (use.scale.prod() < 0.0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

std::size_t triangles_of(const std::vector<BodyMesh>& meshes) {
  std::size_t count = 0;
  for (const BodyMesh& m : meshes) count += m.mesh.triangles.size();
  return count;
}

/// Simplifies the meshes until they have few enough triangles.
void simplify(const MeshOptions& options, LoadedMeshes& loaded) {
  const std::size_t before = triangles_of(loaded.meshes);
  const auto most = static_cast<std::size_t>(options.most_triangles);
  if (before <= most) return;
  for (double cell_m = 0.001; cell_m < 1.0; cell_m *= 1.4) {
    std::vector<BodyMesh> coarse;
    for (const BodyMesh& m : loaded.meshes) coarse.push_back({m.body, recording::simplified(m.mesh, cell_m)});
    if (triangles_of(coarse) > most) continue;
    loaded.notes.push_back(
        {.code = RemarkCode::reading,
         .severity = Severity::note,
         .says = fmt::format("The meshes are shown with {} of {} triangles, details of {:.1f} mm left out.",
                             triangles_of(coarse), before, 1e3 * cell_m)});
    loaded.meshes = std::move(coarse);
    return;
  }
}

}  // namespace

std::vector<MeshUse> list_meshes(std::string_view osim, const fs::path& path) {
  OsimXml xml(std::string(osim), path);
  const auto node = xml.root().child("Model");
  if (!node) xml.fail(xml.root(), "the document has no <Model>");
  (void)bring_to_newest_form(xml);
  OsimReading r{xml, {}, {}, {}};
  body::read_bodies(r, node);
  std::vector<MeshUse> uses;
  add_attached(r, node.child("Ground"), {}, uses);
  for (const auto& [body, place] : body::components_of(node, "BodySet", "Body"))
    if (const auto index = r.model.find_body(OsimXml::name_of(body))) add_attached(r, body, {*index, {}}, uses);
  for (const auto& [name, frame] : r.frames) {
    if (!frame.node.child("attached_geometry")) continue;
    try {
      add_attached(r, frame.node, body::resolve_frame(r, frame.node, name, ""), uses);
    } catch (const ReadError&) {
      // A frame that leads nowhere has no geometry; the reader reports errors that matter.
    }
  }
  return uses;
}

void add_meshes(const LoadedMeshes& loaded, page::ScenePage& page) {
  for (const BodyMesh& m : loaded.meshes) {
    const auto number = static_cast<int>(page.meshes.size());
    page.meshes.push_back({m.mesh.vertices, m.mesh.triangles});
    for (page::Scene& scene : page.scenes) scene.bodies[at(m.body)].meshes.push_back(number);
  }
  for (page::Scene& scene : page.scenes)
    scene.notes.insert(scene.notes.end(), loaded.notes.begin(), loaded.notes.end());
}

LoadedMeshes load_meshes(std::string_view osim, const fs::path& path, const MeshOptions& options) {
  LoadedMeshes loaded;
  std::vector<std::string> missing;
  for (const MeshUse& use : list_meshes(osim, path)) {
    const auto file = find_file(use.file, path.parent_path(), options);
    if (!file) {
      missing.push_back(use.file);
      continue;
    }
    try {
      loaded.meshes.push_back({use.body, in_body(recording::read_mesh(*file), use)});
    } catch (const ReadError& error) {
      loaded.notes.push_back({.code = RemarkCode::reading, .severity = Severity::note, .says = error.what()});
    }
  }
  if (!missing.empty() && (!loaded.meshes.empty() || !options.folders.empty())) {
    loaded.notes.push_back(
        {.code = RemarkCode::reading,
         .severity = Severity::note,
         .says = fmt::format("{} mesh files are not there: {}.", missing.size(), fmt::join(missing, ", "))});
  }
  simplify(options, loaded);
  return loaded;
}

}  // namespace myoid::body
