#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/remark.h"

namespace myoid::page {

/// A surface of triangles, of a bone for example.
struct SceneMesh {
  std::vector<Vec3> vertices_m;               ///< In its body.
  std::vector<std::array<int, 3>> triangles;  ///< Counterclockwise from outside.
};

/// A body as it is drawn: its meshes, or its sticks in place of bones.
struct SceneBody {
  std::string name;
  double mass_kg = 0.0;
  Vec3 mass_center_m = Vec3::Zero();               ///< In the body.
  std::vector<std::array<Vec3, 2>> sticks_m = {};  ///< Ends, in the body.
  std::vector<int> meshes = {};                    ///< Numbers in ScenePage::meshes.
};

/// A point that is fixed in a body.
struct ScenePoint {
  int body = 0;
  Vec3 position_m = Vec3::Zero();
};

struct SceneMarker {
  std::string name;
  ScenePoint point;
};

enum class SurfaceKind { cylinder, ellipsoid, torus };

/// A surface that muscles wrap around.
struct SceneSurface {
  std::string name;
  int body = 0;
  Pose pose;  ///< In the body.
  SurfaceKind kind = SurfaceKind::cylinder;
  /// cylinder: radius, radius, length; ellipsoid: half axes; torus: radius of the tube, of the
  /// ring, 0. The axis of cylinder and torus is z.
  Vec3 size_m = Vec3::Zero();
};

/// A muscle, drawn as a line. The points of a muscle that always runs through the same points of
/// bodies are here; the lines of other muscles are in each frame.
struct SceneMuscle {
  std::string name;
  double max_isometric_force_n = 0.0;  ///< Decides the line's width.
  std::vector<ScenePoint> points = {};
};

struct SceneCoordinate {
  std::string name;
  std::string unit;  ///< As shown: "deg", "m" or none.
};

/// The quantity that colors the muscles.
struct SceneValues {
  std::string name;         ///< "force", "activation"
  std::string unit;         ///< "N"; empty: dimensionless.
  double top = 1.0;         ///< Upper end of the colors.
  Eigen::MatrixXd value{};  ///< Frames x muscles; NaN: not known.
};

/// A measured force on the person, as of a force plate or of a held handle.
struct SceneLoad {
  std::string name;
  Eigen::MatrixXd point_m{};  ///< Frames x 3, where it acts, in ground; NaN: no force.
  Eigen::MatrixXd force_n{};  ///< Frames x 3, in ground.
};

/// A model in one trial, or in one posture (a single frame), as plain values.
struct Scene {
  std::string name;                    ///< Name of the trial.
  std::vector<Remark> notes = {};      ///< Sentences: frames left out, columns not found.
  Vec3 up = Vec3::UnitY();             ///< Unit, in ground.
  std::vector<SceneBody> bodies = {};  ///< [0] is ground.
  std::vector<SceneMarker> markers = {};
  std::vector<SceneSurface> surfaces = {};
  std::vector<SceneMuscle> muscles = {};
  std::vector<SceneCoordinate> coordinates = {};

  Eigen::VectorXd time_s{};                                  ///< One per frame.
  std::vector<std::vector<Pose>> poses = {};                 ///< Frames x bodies, in ground.
  Eigen::MatrixXd coordinate_values{};                       ///< Frames x coordinates, in the units shown.
  std::vector<int> moving_muscles = {};                      ///< Muscles with a line per frame.
  std::vector<std::vector<std::vector<Vec3>>> lines_m = {};  ///< Frames x moving muscles, in ground.
  std::vector<SceneValues> values = {};
  std::vector<std::string> measured_markers = {};
  Eigen::MatrixXd measured_m{};  ///< Frames x 3 measured markers, in ground; NaN: not seen.
  std::vector<SceneLoad> loads = {};
};

/// Throws InvalidInput, naming the fault, unless all numbers of frames, bodies, muscles and
/// coordinates agree, positions are finite and indices exist.
void validate(const Scene& scene);

}  // namespace myoid::page
