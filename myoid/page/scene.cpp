#include "myoid/page/scene.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::page {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw InvalidInput(what);
}

void validate_model(const Scene& scene) {
  const auto count = static_cast<int>(scene.bodies.size());
  require(count > 0, "there is no ground");
  const auto exists = [&](const ScenePoint& p) { return p.body >= 0 && p.body < count && p.position_m.allFinite(); };
  for (const SceneMarker& m : scene.markers) require(exists(m.point), fmt::format("marker '{}' is on no body", m.name));
  for (const SceneSurface& s : scene.surfaces)
    require(s.body >= 0 && s.body < count && s.size_m.allFinite(), fmt::format("surface '{}' is on no body", s.name));
  for (const SceneMuscle& m : scene.muscles) {
    require(std::ranges::all_of(m.points, exists), fmt::format("a point of muscle '{}' is on no body", m.name));
  }
}

void validate_frame(const Scene& scene, std::size_t frame) {
  const auto where = [&] { return fmt::format("frame {}", frame); };
  require(scene.poses[frame].size() == scene.bodies.size(), where() + ": a pose for each body");
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Pose& pose = scene.poses[frame][b];
    require(pose.p.allFinite() && pose.R.allFinite(),
            where() + fmt::format(": body '{}' is nowhere", scene.bodies[b].name));
  }
  const auto& lines = scene.lines_m[frame];
  require(lines.size() == scene.moving_muscles.size(), where() + ": a line for each moving muscle");
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto finite = [](const Vec3& p) { return p.allFinite(); };
    require(std::all_of(lines[k].begin(), lines[k].end(), finite) && lines[k].size() < 65536,
            where() + fmt::format(": the line of muscle number {}", scene.moving_muscles[k]));
  }
}

void validate_frames(const Scene& scene) {
  const Eigen::Index frames = scene.time_s.size();
  const auto n = static_cast<std::size_t>(frames);
  require(frames > 0 && scene.time_s.allFinite(), "there are no frames");
  require(scene.poses.size() == n && scene.lines_m.size() == n,
          fmt::format("{} frames expected of poses and lines", frames));
  require(scene.coordinate_values.rows() == frames &&
              scene.coordinate_values.cols() == static_cast<Eigen::Index>(scene.coordinates.size()),
          "expected values of frames x coordinates");
  for (const int m : scene.moving_muscles) {
    require(m >= 0 && m < static_cast<int>(scene.muscles.size()), fmt::format("there is no muscle number {}", m));
  }
  for (const SceneValues& v : scene.values) {
    require(
        v.value.rows() == frames && v.value.cols() == static_cast<Eigen::Index>(scene.muscles.size()) && v.top > 0.0,
        fmt::format("expected '{}' of frames x muscles, top above 0", v.name));
  }
  for (const SceneLoad& load : scene.loads) {
    require(load.point_m.rows() == frames && load.point_m.cols() == 3 && load.force_n.rows() == frames &&
                load.force_n.cols() == 3 && load.force_n.allFinite(),
            fmt::format("expected points and forces of '{}' in every frame", load.name));
  }
  require(scene.measured_markers.empty() ||
              (scene.measured_m.rows() == frames &&
               scene.measured_m.cols() == 3 * static_cast<Eigen::Index>(scene.measured_markers.size())),
          "expected positions of frames x measured markers");
  for (std::size_t f = 0; f < n; ++f) validate_frame(scene, f);
}

}  // namespace

void validate(const Scene& scene) {
  try {
    validate_model(scene);
    validate_frames(scene);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("scene '{}': {}", scene.name, error.what()));
  }
}

}  // namespace myoid::page
