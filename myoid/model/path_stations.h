#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "myoid/model/body_model.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::model {

/// A point the path runs through at this posture.
struct PathStation {
  BodyIndex body = 0;
  Vec3 p_B = Vec3::Zero();
  Vec3 p_G = Vec3::Zero();
  int source = -1;             ///< Number in the path's points, or -1 for a tangent point.
  int wrap = -1;               ///< Number in the path's wraps for a tangent point.
  bool on_wrap_after = false;  ///< From here to the next station the path lies on the object,
  double arc_after_m = 0.0;    ///< for this length.
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
  bool wrapped = false;          ///< It lies on a wrap object.
  /// The tangent points on several objects have come to rest. Where they cannot (objects that push
  /// the path off each other), the length is that of the last of many passes and may jump.
  bool settled = true;
};

/// The stations of a path without wrap objects; the first step of every way to compute a path.
void place_points(const BodyModel& model,
                  const MusclePath& path,
                  const BodyState& state,
                  PathWorkspace& workspace);

/// First and last station between which a wrap may act: its range counts all points, 1-based, and
/// is drawn in to the active ones. {0, -1} if there is none.
struct StationRange {
  int begin = 0;
  int end = -1;
};
[[nodiscard]] StationRange station_range(const MusclePath& path,
                                         const PathWrap& wrap,
                                         const std::vector<PathStation>& stations);

/// Sum of the straight pieces and of the arcs.
[[nodiscard]] double length_of(const std::vector<PathStation>& stations);

/// Adds to `arm` minus the derivative by each coordinate of u . (p_b - p_a), where the points are
/// fixed in bodies a and b: exactly zero for coordinates that do not move one against the other,
/// where u points from one to the other.
void add_pair_moment(const BodyModel& model,
                     const BodyState& state,
                     BodyIndex a,
                     const Vec3& p_GA,
                     BodyIndex b,
                     const Vec3& p_GB,
                     const Vec3& u_G,
                     Eigen::VectorXd& arm);

/// Derivative of a moving point's location by its coordinate, in ground; `beyond_range`: also where
/// the coordinate has left its range (as OpenSim).
[[nodiscard]] Vec3 moving_rate(const BodyModel& model,
                               const PathPoint& point,
                               const BodyState& state,
                               bool beyond_range);

}  // namespace myoid::model
