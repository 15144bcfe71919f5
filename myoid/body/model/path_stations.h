#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"
#include "myoid/body/model/kinematic_tree.h"

namespace myoid::body {

/// A point of the path at this posture.
struct PathStation {
  BodyIndex body = 0;
  Vec3 p_B = Vec3::Zero();
  Vec3 p_G = Vec3::Zero();
  int source = -1;             ///< Number in the path's points, or -1 for a tangent point.
  int wrap = -1;               ///< Number in the path's wraps for a tangent point.
  bool on_wrap_after = false;  ///< True: the path to the next station lies on the object.
  double arc_after_m = 0.0;    ///< Length of that arc.
};

/// A path of a model at one posture.
struct PosedPath {
  const BodyModel& model;
  const MusclePath& path;
  const BodyState& state;
};

/// Space for computing paths, reused from call to call without allocation; one per thread. After a
/// call `stations` is the path.
struct PathWorkspace {
  std::vector<PathStation> stations;
  std::vector<std::array<Vec3, 2>> first_seen_G;  ///< Per wrap, for Compat::stale_wrap_points.
  std::vector<char> is_seen;
  std::vector<int> order;
};

/// A muscle at one posture.
struct PathResult {
  double length_m = 0.0;         ///< Musculotendon length.
  double speed_mps = 0.0;        ///< dl/dt at state.qdot, lengthening positive.
  Eigen::VectorXd moment_arm_m;  ///< r = -dl/dq per coordinate; torque = r times tendon force.
  bool wrapped = false;          ///< True if the path touches a wrap object.
  /// True if the tangent points on several objects came to rest. Objects that push the path off
  /// each other prevent rest; the length is then taken after the last pass and may jump.
  bool settled = true;
};

/// Computes a path by the geometry of the model: continuous length, r = -dl/dq.
void compute_exact_path(const PosedPath& posed, PathWorkspace& workspace, PathResult& result);

/// Computes a path by the algorithm of OpenSim 4.5.2, with the defects that `model.compat` switches on.
void compute_opensim_path(const PosedPath& posed, PathWorkspace& workspace, PathResult& result);

/// Fills the stations of a path without wrap objects, the first step of all computations of a path.
void place_points(const PosedPath& posed, PathWorkspace& workspace);

/// First and last station between which a wrap may act: the wrap's range counts all points from 1
/// and shrinks to the active points. {0, -1} if the range holds none.
struct StationRange {
  int begin = 0;
  int end = -1;
};
[[nodiscard]] StationRange station_range(const MusclePath& path,
                                         const PathWrap& wrap,
                                         const std::vector<PathStation>& stations);

/// Returns the sum of the straight pieces and of the arcs.
[[nodiscard]] double length_of(const std::vector<PathStation>& stations);

/// Adds to `arm` minus the derivative of u . (p_b - p_a) by each coordinate. The points are fixed in the bodies a and
/// b, and u is the direction from a to b. Coordinates that do not move the bodies against each other get exactly zero.
void add_pair_moment(const BodyModel& model,
                     const BodyState& state,
                     BodyIndex a,
                     const Vec3& p_GA,
                     BodyIndex b,
                     const Vec3& p_GB,
                     const Vec3& u_G,
                     Eigen::VectorXd& arm);

/// Returns the two stations of the contact of wrap `number` with an object, whose frame W has the
/// pose X_GW in ground: tangent points and arc.
[[nodiscard]] std::array<PathStation, 2> contact_stations(const WrapObject& object,
                                                          int number,
                                                          const Pose& X_GW,
                                                          const Vec3& first_W,
                                                          const Vec3& second_W,
                                                          double arc_length_m);

/// Inserts two stations behind a station.
void insert_behind(std::vector<PathStation>& stations, int station, const std::array<PathStation, 2>& contact);

/// Returns the moving point at a station, if a coordinate moves it; null at other stations.
[[nodiscard]] const PathPoint* moving_point(const MusclePath& path, const PathStation& station);

/// Calls `visit` with each coordinate that moves such a point and the derivative of its location by it, in ground.
/// `beyond_range`: nonzero also outside the coordinate's range, as in OpenSim.
template <typename Visit>
void for_each_moving_rate(const PosedPath& posed, const PathPoint& point, bool beyond_range, const Visit& visit) {
  const PathPoint::Moving& moving = *point.moving;
  for (std::size_t first = 0; first < 3; ++first) {
    const int c = moving.coordinates[first];
    bool is_new = c >= 0;
    for (std::size_t k = 0; k < first; ++k) is_new = is_new && moving.coordinates[k] != c;
    if (!is_new) continue;
    const Coordinate& coordinate = posed.model.coordinates[static_cast<std::size_t>(c)];
    const double q = posed.state.q[c];
    if (!beyond_range && (q < coordinate.lower || q > coordinate.upper)) continue;
    Vec3 rate = Vec3::Zero();
    for (std::size_t k = first; k < 3; ++k)
      if (moving.coordinates[k] == c) rate[static_cast<Eigen::Index>(k)] = evaluate(moving.location[k], q).first;
    visit(c, Vec3(posed.state.X_GB[static_cast<std::size_t>(point.body)].R * (moving.X_BF.R * rate)));
  }
}

/// Adds to `arm` the moments of two moving points, a and b, by the coordinates that they follow; u
/// is the direction from a to b. Other stations have none.
void add_moving_moments(const PosedPath& posed,
                        const PathStation& a,
                        const PathStation& b,
                        const Vec3& u,
                        bool beyond_range,
                        Eigen::VectorXd& arm);

}  // namespace myoid::body
