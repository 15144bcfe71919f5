#include "myoid/page/scene_page.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/page/json_values.h"
#include "myoid/page/packing.h"
#include "myoid/page/svg_plot.h"
#include "myoid/page/viewer_bundle.h"

namespace myoid::page {
namespace {

using nlohmann::ordered_json;

/// Returns the vector in JSON with two decimals of a millimeter, enough for bodies at rest.
ordered_json vector_json(const Vec3& v) {
  const auto rounded = [](double x) { return std::round(x * 1e5) / 1e5; };
  return {rounded(v.x()), rounded(v.y()), rounded(v.z())};
}

ordered_json point_json(const ScenePoint& point) {
  ordered_json j = vector_json(point.position_m);
  j.insert(j.begin(), point.body);
  return j;
}

std::string_view name(SurfaceKind kind) {
  return kind == SurfaceKind::cylinder ? "cylinder" : kind == SurfaceKind::ellipsoid ? "ellipsoid" : "torus";
}

ordered_json body_json(const SceneBody& body) {
  return {{"name", body.name},
          {"mass", body.mass_kg},
          {"center", vector_json(body.mass_center_m)},
          {"sticks", array_of(body.sticks_m, [](const auto& ends) { return array_of(ends, vector_json); })},
          {"meshes", body.meshes}};
}

ordered_json surface_json(const SceneSurface& s) {
  const Eigen::Quaterniond q(s.pose.R);
  return {{"name", s.name},
          {"body", s.body},
          {"kind", name(s.kind)},
          {"size", vector_json(s.size_m)},
          {"position", vector_json(s.pose.p)},
          {"rotation", {q.x(), q.y(), q.z(), q.w()}}};
}

ordered_json line_of_json(const SceneMuscle& muscle) {
  return {{"name", muscle.name},
          {"strength", muscle.max_isometric_force_n},
          {"points", array_of(muscle.points, point_json)}};
}

ordered_json model_json(const Scene& scene) {
  const auto marker = [](const SceneMarker& m) {
    return ordered_json{{"name", m.name}, {"point", point_json(m.point)}};
  };
  const auto coordinate = [](const SceneCoordinate& c) { return ordered_json{{"name", c.name}, {"unit", c.unit}}; };
  return {{"up", vector_json(scene.up)},
          {"bodies", array_of(scene.bodies, body_json)},
          {"markers", array_of(scene.markers, marker)},
          {"surfaces", array_of(scene.surfaces, surface_json)},
          {"muscles", array_of(scene.muscles, line_of_json)},
          {"coordinates", array_of(scene.coordinates, coordinate)}};
}

std::vector<Vec3> measured_points(const Scene& scene) {
  std::vector<Vec3> points;
  for (Eigen::Index f = 0; f < scene.measured_m.rows(); ++f) {
    for (Eigen::Index m = 0; m + 2 < scene.measured_m.cols(); m += 3)
      points.emplace_back(scene.measured_m.block<1, 3>(f, m).transpose());
  }
  return points;
}

/// Returns every point that is given in ground.
std::vector<Vec3> points_of(const Scene& scene) {
  std::vector<Vec3> points;
  for (const auto& frame : scene.poses)
    for (const Pose& pose : frame) points.push_back(pose.p);
  for (const auto& frame : scene.lines_m)
    for (const auto& line : frame) points.insert(points.end(), line.begin(), line.end());
  const std::vector<Vec3> measured = measured_points(scene);
  points.insert(points.end(), measured.begin(), measured.end());
  for (const SceneLoad& load : scene.loads)
    for (Eigen::Index f = 0; f < load.point_m.rows(); ++f) points.emplace_back(load.point_m.row(f).transpose());
  return points;
}

/// `columns` codes are a row, of which the next row differs little.
std::string packed_points(const PackingBox& box, const std::vector<Vec3>& points, std::size_t columns = 3) {
  std::vector<std::uint16_t> numbers;
  for (const Vec3& p : points) pack(box, p, numbers);
  return packed_codes(numbers, columns);
}

ordered_json lines_json(const Scene& scene, const PackingBox& box) {
  std::vector<std::uint16_t> counts, points;
  std::size_t of_frame = 0;
  bool alike = true;  // every line has as many points in each frame
  for (const auto& frame : scene.lines_m) {
    for (std::size_t k = 0; k < frame.size(); ++k) {
      const auto& line = frame[k];
      if (&frame == scene.lines_m.data()) of_frame += line.size();
      alike = alike && line.size() == scene.lines_m.front()[k].size();
      counts.push_back(static_cast<std::uint16_t>(line.size()));
      for (const Vec3& p : line) pack(box, p, points);
    }
  }
  const std::size_t columns = alike && of_frame > 0 ? 3 * of_frame : 3;
  return {{"muscles", scene.moving_muscles},
          {"counts", packed_codes(counts, std::max<std::size_t>(1, scene.moving_muscles.size()))},
          {"columns", columns},
          {"points", packed_codes(points, columns)}};
}

ordered_json values_json(const SceneValues& values) {
  std::vector<std::uint16_t> numbers;
  numbers.reserve(static_cast<std::size_t>(values.value.size()));
  const auto scene_muscles = static_cast<std::size_t>(values.value.cols());
  for (Eigen::Index f = 0; f < values.value.rows(); ++f)
    for (Eigen::Index m = 0; m < values.value.cols(); ++m) numbers.push_back(pack(values.value(f, m), values.top));
  return {{"name", values.name},
          {"unit", values.unit},
          {"top", values.top},
          {"numbers", packed_codes(numbers, std::max<std::size_t>(1, scene_muscles))}};
}

ordered_json measured_json(const Scene& scene, const PackingBox& box) {
  const auto number_of = [&](const std::string& name) {
    const auto it = std::ranges::find(scene.markers, name, &SceneMarker::name);
    return it == scene.markers.end() ? -1 : it - scene.markers.begin();
  };
  return {{"names", scene.measured_markers},
          {"markers", array_of(scene.measured_markers, number_of)},
          {"points",
           packed_points(box, measured_points(scene), std::max<std::size_t>(3, 3 * scene.measured_markers.size()))}};
}

ordered_json load_json(const SceneLoad& load, const PackingBox& box) {
  std::vector<std::uint16_t> points;
  std::vector<float> forces;
  for (Eigen::Index f = 0; f < load.point_m.rows(); ++f) {
    pack(box, load.point_m.row(f).transpose(), points);
    for (Eigen::Index k = 0; k < 3; ++k) forces.push_back(static_cast<float>(load.force_n(f, k)));
  }
  return {{"name", load.name}, {"points", packed_codes(points, 3)}, {"forces", base64(forces)}};
}

/// `model`: number of its model on the page.
ordered_json scene_json(const Scene& scene, std::size_t model) {
  const std::vector<Vec3> points = points_of(scene);
  const PackingBox box = packing_box(points);
  std::vector<std::uint16_t> positions, rotations;
  for (const std::vector<Pose>& frame : scene.poses) {
    for (const Pose& pose : frame) {
      pack(box, pose.p, positions);
      pack(pose.R, rotations);
    }
  }
  const std::size_t bodies = scene.bodies.size();
  ordered_json j{{"name", scene.name}, {"notes", sentences(scene.notes)}, {"model", model}};
  j.update({{"frames", scene.time_s.size()},
            {"times", clock_json(scene.time_s)},
            {"origin", {box.origin.x(), box.origin.y(), box.origin.z()}},
            {"step", box.step},
            {"positions", packed_codes(positions, 3 * bodies)},
            {"rotations", packed_codes(rotations, 4 * bodies)},
            {"angles", array_of(scene.coordinate_values.colwise(), packed_json)},
            {"lines", lines_json(scene, box)},
            {"values", array_of(scene.values, values_json)}});
  if (!scene.loads.empty())
    j["loads"] = array_of(scene.loads, [&](const SceneLoad& load) { return load_json(load, box); });
  if (!scene.measured_markers.empty()) j["measured"] = measured_json(scene, box);
  return j;
}

ordered_json mesh_json(const SceneMesh& mesh) {
  const PackingBox box = packing_box(mesh.vertices_m);
  // Few meshes need more than 16 bits for an index.
  const bool is_wide = mesh.vertices_m.size() > 65535;
  std::vector<std::uint16_t> narrow;
  std::vector<std::uint32_t> wide;
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) {
      if (is_wide)
        wide.push_back(static_cast<std::uint32_t>(corner));
      else
        narrow.push_back(static_cast<std::uint16_t>(corner));
    }
  }
  return {{"origin", {box.origin.x(), box.origin.y(), box.origin.z()}},
          {"step", box.step},
          {"vertices", packed_points(box, mesh.vertices_m)},
          {"wide", is_wide},
          {"corners", is_wide ? base64(wide) : packed_codes(narrow, 3)}};
}

void validate(const SceneMesh& mesh) {
  const auto count = static_cast<int>(mesh.vertices_m.size());
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) {
      if (corner < 0 || corner >= count)
        throw InvalidInput(fmt::format("a mesh has {} vertices, not one {}", count, corner));
    }
  }
  for (const Vec3& p : mesh.vertices_m)
    if (!p.allFinite()) throw InvalidInput("a vertex of a mesh is not finite");
}

void validate_meshes(const ScenePage& page) {
  for (const SceneMesh& mesh : page.meshes) validate(mesh);
  for (const Scene& scene : page.scenes) {
    for (const SceneBody& body : scene.bodies) {
      for (const int mesh : body.meshes) {
        if (mesh < 0 || mesh >= static_cast<int>(page.meshes.size()))
          throw InvalidInput(fmt::format("body '{}' has no mesh number {}", body.name, mesh));
      }
    }
  }
}

}  // namespace

bool has_viewer() { return !viewer_bundle().script.empty(); }

std::string scenes_json(const ScenePage& page) {
  validate_meshes(page);
  for (const Scene& scene : page.scenes) validate(scene);
  ordered_json models = ordered_json::array(), scenes = ordered_json::array();
  for (const Scene& scene : page.scenes) {
    // Most trials have one model.
    ordered_json model = model_json(scene);
    const auto same = std::ranges::find(models, model);
    scenes.push_back(scene_json(scene, static_cast<std::size_t>(same - models.begin())));
    if (same == models.end()) models.push_back(std::move(model));
  }
  return embedded({{"title", page.title},
                   {"subtitle", page.subtitle},
                   {"meshes", array_of(page.meshes, mesh_json)},
                   {"models", std::move(models)},
                   {"scenes", std::move(scenes)}});
}

std::string scene_page(const ScenePage& page) {
  if (!has_viewer()) {
    throw InvalidInput(
        "this program was built without three.js, so it cannot write pages with a moving model: install the packages "
        "libjs-three and esbuild and build it again");
  }
  if (page.scenes.empty()) throw InvalidInput("a page with a moving model needs a scene");
  const std::string scenes = scenes_json(page);
  const ViewerBundle bundle = viewer_bundle();
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<!-- The script below contains three.js:\n\n{}-->\n<style>{}</style>\n"
      "</head>\n<body>\n<noscript>This page shows a moving model and needs JavaScript.</noscript>\n"
      "<script type=\"application/json\" id=\"scene\">{}</script>\n<script>{}</script>\n"
      "</body>\n</html>\n",
      escape_xml(page.title), bundle.license, bundle.style, scenes, bundle.script);
}

}  // namespace myoid::page
