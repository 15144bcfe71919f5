#include "scaled_model.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <variant>

#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"

namespace {

using namespace myoid;

class Difference {
 public:
  explicit Difference(std::string property) { row_.property = std::move(property); }
  void add(const std::string& where, double ours, double theirs) {
    const double error = std::abs(ours - theirs);
    peak_ = std::max(peak_, std::abs(theirs));
    if (row_.where.empty() || !(error <= row_.error)) {
      row_.error = error;
      row_.where = where;
    }
  }
  template <typename A, typename B>
  void add_all(const std::string& where, const A& ours, const B& theirs) {
    for (Eigen::Index i = 0; i < ours.size(); ++i) add(where, ours.reshaped()[i], theirs.reshaped()[i]);
  }
  void missing(const std::string& where) { add(where + " (missing)", INFINITY, 0.0); }
  [[nodiscard]] ModelDifference row() const {
    ModelDifference row = row_;
    row.relative = row.error / std::max(peak_, 1e-12);
    return row;
  }
  [[nodiscard]] bool any() const { return !row_.where.empty(); }

 private:
  ModelDifference row_;
  double peak_ = 0.0;
};

Vec3 size_of(const body::WrapObject& wrap) {
  if (const auto* c = std::get_if<body::CylinderShape>(&wrap.shape)) return {c->radius_m, c->length_m, 0.0};
  if (const auto* s = std::get_if<body::SphereShape>(&wrap.shape)) return {s->radius_m, 0.0, 0.0};
  if (const auto* t = std::get_if<body::TorusShape>(&wrap.shape)) return {t->inner_radius_m, t->outer_radius_m, 0.0};
  return std::get<body::EllipsoidShape>(wrap.shape).radii_m;
}

}  // namespace

std::vector<ModelDifference> compare_models(const body::BodyModel& ours, const body::BodyModel& theirs) {
  Difference mass("masses [kg]"), center("mass centers [m]"), inertia("inertias [kg m^2]");
  Difference frames("joint frames [m, 1]"), places("bodies in 50 postures [m]");
  Difference points("path points [m]"), wraps("wrap objects [m, 1]");
  Difference lengths("paths in 50 postures [m]"), fibers("optimal fiber lengths [m]");
  Difference tendons("tendon slack lengths [m]"), forces("F_max, pennation, v_max [N, rad, 1/s]");
  Difference coordinates("defaults and ranges [rad, m]"), markers("markers [m]");
  for (const body::Body& body : theirs.bodies) {
    const auto b = ours.find_body(body.name);
    if (!b) {
      mass.missing(body.name);
      continue;
    }
    const body::Body& own = ours.bodies[static_cast<std::size_t>(*b)];
    mass.add(body.name, own.mass_kg, body.mass_kg);
    center.add_all(body.name, own.p_BBcm_B, body.p_BBcm_B);
    inertia.add_all(body.name, own.I_BBcm_B, body.I_BBcm_B);
  }
  for (const body::Joint& joint : theirs.joints) {
    const auto own = std::find_if(ours.joints.begin(), ours.joints.end(),
                                  [&](const body::Joint& j) { return j.name == joint.name; });
    if (own == ours.joints.end()) {
      frames.missing(joint.name);
      continue;
    }
    for (const auto& [mine, other] : {std::pair(&own->X_PF, &joint.X_PF), std::pair(&own->X_BM, &joint.X_BM)}) {
      frames.add_all(joint.name, mine->p, other->p);
      frames.add_all(joint.name, mine->R, other->R);
    }
  }
  for (const body::Coordinate& c : theirs.coordinates) {
    const auto k = ours.find_coordinate(c.name);
    if (!k) {
      coordinates.missing(c.name);
      continue;
    }
    const body::Coordinate& own = ours.coordinates[static_cast<std::size_t>(*k)];
    coordinates.add_all(c.name, Eigen::Vector4d(own.default_value, own.lower, own.upper, own.locked + 2 * own.clamped),
                        Eigen::Vector4d(c.default_value, c.lower, c.upper, c.locked + 2 * c.clamped));
  }
  for (std::size_t w = 0; w < theirs.wrap_objects.size() && w < ours.wrap_objects.size(); ++w) {
    const body::WrapObject &own = ours.wrap_objects[w], &other = theirs.wrap_objects[w];
    wraps.add_all(other.name, own.X_BW.p, other.X_BW.p);
    wraps.add_all(other.name, own.X_BW.R, other.X_BW.R);
    wraps.add_all(other.name, size_of(own), size_of(other));
  }
  for (const body::Muscle& muscle : theirs.muscles) {
    const auto m = ours.find_muscle(muscle.name);
    if (!m) {
      fibers.missing(muscle.name);
      continue;
    }
    const body::Muscle& own = ours.muscles[static_cast<std::size_t>(*m)];
    const body::MuscleProperties &a = own.properties, &b = muscle.properties;
    fibers.add(muscle.name, a.optimal_fiber_length_m, b.optimal_fiber_length_m);
    tendons.add(muscle.name, a.tendon_slack_length_m, b.tendon_slack_length_m);
    forces.add_all(muscle.name, Vec3(a.max_isometric_force_n, a.pennation_at_optimal_rad, a.max_contraction_velocity),
                   Vec3(b.max_isometric_force_n, b.pennation_at_optimal_rad, b.max_contraction_velocity));
    for (std::size_t p = 0; p < muscle.path.points.size() && p < own.path.points.size(); ++p)
      points.add_all(muscle.name, own.path.points[p].p_BP, muscle.path.points[p].p_BP);
  }
  for (const body::Marker& marker : theirs.markers) {
    const auto m = ours.find_marker(marker.name);
    if (m) {
      markers.add_all(marker.name, ours.markers[static_cast<std::size_t>(*m)].p_BM, marker.p_BM);
    } else {
      markers.missing(marker.name);
    }
  }
  std::mt19937_64 random(1);
  body::BodyState at_ours = body::make_state(ours), at_theirs = body::make_state(theirs);
  body::PathWorkspace workspace;
  body::PathResult mine, other;
  for (int posture = 0; posture < 50; ++posture) {
    Eigen::VectorXd q = theirs.default_q();
    for (std::size_t c = 0; c < theirs.coordinates.size(); ++c) {
      const body::Coordinate& k = theirs.coordinates[c];
      if (!theirs.is_constrained(static_cast<int>(c)) && k.lower < k.upper)
        q[static_cast<Eigen::Index>(c)] = std::uniform_real_distribution<>(k.lower, k.upper)(random);
    }
    q = body::assemble(theirs, q).q;
    body::compute_poses(theirs, q, at_theirs);
    body::compute_poses(ours, q, at_ours);
    for (std::size_t b = 0; b < theirs.bodies.size() && b < ours.bodies.size(); ++b)
      places.add_all(theirs.bodies[b].name, at_ours.X_GB[b].p, at_theirs.X_GB[b].p);
    for (std::size_t m = 0; m < theirs.muscles.size() && m < ours.muscles.size(); ++m) {
      body::compute_path(ours, ours.muscles[m].path, at_ours, workspace, mine);
      body::compute_path(theirs, theirs.muscles[m].path, at_theirs, workspace, other);
      lengths.add(theirs.muscles[m].name, mine.length_m, other.length_m);
    }
  }
  std::vector<ModelDifference> rows;
  for (const Difference* d : {&mass, &center, &inertia, &frames, &coordinates, &places, &points, &wraps, &lengths,
                              &fibers, &tendons, &forces, &markers}) {
    if (d->any()) rows.push_back(d->row());
  }
  return rows;
}
