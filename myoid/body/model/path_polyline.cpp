#include "myoid/body/model/path_polyline.h"

#include <algorithm>
#include <cmath>

#include "myoid/body/model/wrap_surfaces.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

/// An arc and the straight pieces before and after it, in the frame of a wrap object.
struct Arc {
  Vec3 before, first, second, after;
  double length_m = 0.0;
};

/// Angles of `first` and `second` about the center of a circle, and the signed turn between them.
struct Turn {
  double first = 0.0;
  double turned = 0.0;
};

/// Returns the way from `first` to `second` whose direction continues the longer of the straight
/// pieces. All points are in the plane of the circle, whose center is the origin.
Turn turn_of(const Eigen::Vector2d& before,
             const Eigen::Vector2d& first,
             const Eigen::Vector2d& second,
             const Eigen::Vector2d& after) {
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  const Eigen::Vector2d in = first - before;
  const Eigen::Vector2d out = after - second;
  const double sense = in.norm() > out.norm() ? cross(first, in) : cross(second, out);
  Turn turn;
  turn.first = std::atan2(first.y(), first.x());
  const double last = std::atan2(second.y(), second.x());
  turn.turned = sense >= 0.0 ? within_one_turn(last - turn.first) : -within_one_turn(turn.first - last);
  return turn;
}

int pieces_of(double turned, double most_turn_rad) {
  return std::max(1, static_cast<int>(std::ceil(std::abs(turned) / most_turn_rad)));
}

/// Points between first and second on the helix about z.
std::vector<Vec3> on_cylinder(double radius, const Arc& arc, double most_turn_rad) {
  const auto flat = [](const Vec3& v) -> Eigen::Vector2d { return v.head<2>(); };
  const Turn turn = turn_of(flat(arc.before), flat(arc.first), flat(arc.second), flat(arc.after));
  const int pieces = pieces_of(turn.turned, most_turn_rad);
  std::vector<Vec3> points;
  for (int i = 1; i < pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    const double angle = turn.first + share * turn.turned;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                        arc.first.z() + share * (arc.second.z() - arc.first.z()));
  }
  return points;
}

/// Points between first and second on the cut of an ellipsoid by the plane of the straight pieces.
/// Where the ellipsoid is the unit sphere, the cut is a circle.
std::vector<Vec3> on_ellipsoid(const Vec3& radii, const Arc& arc, double most_turn_rad) {
  const auto scaled = [&](const Vec3& v) -> Vec3 { return v.cwiseQuotient(radii); };
  const Vec3 P = scaled(arc.before);
  const Vec3 F = scaled(arc.first);
  const Vec3 S = scaled(arc.second);
  const Vec3 Q = scaled(arc.after);
  // The plane through the three points that are farthest from a line.
  Vec3 normal = (F - P).cross(S - F);
  for (const Vec3& other : {Vec3((S - F).cross(Q - S)), Vec3((F - P).cross(Q - S))})
    if (other.norm() > normal.norm()) normal = other;
  if (!(normal.norm() > 0.0)) return {};
  normal.normalize();
  const Vec3 center = F.dot(normal) * normal;
  const double radius = (F - center).norm();
  if (!(radius > 0.0)) return {};
  const Vec3 u = (F - center) / radius;
  const Vec3 v = normal.cross(u);
  const auto flat = [&](const Vec3& x) -> Eigen::Vector2d { return {(x - center).dot(u), (x - center).dot(v)}; };
  const Turn turn = turn_of(flat(P), flat(F), flat(S), flat(Q));
  const int pieces = pieces_of(turn.turned, most_turn_rad);
  std::vector<Vec3> points;
  for (int i = 1; i < pieces; ++i) {
    const double angle = turn.first + turn.turned * i / pieces;
    const Vec3 x = center + radius * (std::cos(angle) * u + std::sin(angle) * v);
    points.push_back(x.cwiseProduct(radii));
  }
  return points;
}

std::vector<Vec3> on_object(const WrapObject& object, const Arc& arc, double most_turn_rad) {
  if (const auto* cylinder = std::get_if<CylinderShape>(&object.shape))
    return on_cylinder(cylinder->radius_m, arc, most_turn_rad);
  if (const auto* sphere = std::get_if<SphereShape>(&object.shape))
    return on_ellipsoid(Vec3::Constant(sphere->radius_m), arc, most_turn_rad);
  if (const auto* ellipsoid = std::get_if<EllipsoidShape>(&object.shape))
    return on_ellipsoid(ellipsoid->radii_m, arc, most_turn_rad);
  const auto& torus = std::get<TorusShape>(object.shape);
  const auto tube = torus_tube(torus, object.quadrant, arc.before, arc.after);
  if (!tube) return {};
  const Pose X_CW = tube->inverse();
  const Arc in_tube{X_CW * arc.before, X_CW * arc.first, X_CW * arc.second, X_CW * arc.after, arc.length_m};
  std::vector<Vec3> points = on_cylinder(torus.inner_radius_m, in_tube, most_turn_rad);
  for (Vec3& p : points) p = *tube * p;
  return points;
}

/// True if the points from first to second have the length of the arc, apart from their corners.
bool is_the_arc(const std::vector<Vec3>& points, const Arc& arc, double most_turn_rad) {
  double length = 0.0;
  Vec3 last = arc.first;
  for (const Vec3& p : points) {
    length += (p - last).norm();
    last = p;
  }
  length += (arc.second - last).norm();
  // Chord over arc is 1 - turn^2 / 24 on a circle, and on an ellipse worse by at most its axes'
  // ratio; OpenSim's arcs are sums of chords.
  const double slack = 0.02 + most_turn_rad * most_turn_rad;
  return std::abs(length - arc.length_m) <= slack * arc.length_m + 1e-6;
}

}  // namespace

std::vector<Vec3> path_polyline(const BodyModel& model,
                                const MusclePath& path,
                                const BodyState& state,
                                const std::vector<PathStation>& stations,
                                double most_turn_rad) {
  std::vector<Vec3> line;
  line.reserve(stations.size() + 8);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    line.push_back(stations[i].p_G);
    if (!stations[i].on_wrap_after || i == 0 || i + 2 >= stations.size()) continue;
    const WrapObject& object = model.wrap_objects[at(path.wraps[at(stations[i].wrap)].wrap_object)];
    const Pose X_GW = state.X_GB[at(object.body)] * object.X_BW;
    const Pose X_WG = X_GW.inverse();
    const Arc arc{X_WG * stations[i - 1].p_G, X_WG * stations[i].p_G, X_WG * stations[i + 1].p_G,
                  X_WG * stations[i + 2].p_G, stations[i].arc_after_m};
    const std::vector<Vec3> points = on_object(object, arc, most_turn_rad);
    if (!is_the_arc(points, arc, most_turn_rad)) continue;
    for (const Vec3& p : points) line.push_back(X_GW * p);
  }
  return line;
}

}  // namespace myoid::body
