#include "myoid/study/checks/foreign_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/math/statistics.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

constexpr Eigen::Index kContactFrames = 1500;
constexpr double kNoDistance = std::numeric_limits<double>::infinity();

/// One frame with a load.
struct LoadedFrame {
  double time_s = 0.0;
  double own_m = kNoDistance;    ///< Distance from the force's body or its neighbors.
  double other_m = kNoDistance;  ///< Distance from the nearest other body.
  body::BodyIndex other = 0;
  body::BodyIndex second = 0;  ///< A second foot on the ground nearby, or 0.
  double second_m = kNoDistance;
  Vec3 force_n = Vec3::Zero();
  double above_m = 0.0;  ///< Height of the center of pressure above the lowest point of all bodies.
};

struct GroundContact {
  std::vector<LoadedFrame> frames;
  [[nodiscard]] double begin_s() const { return frames.front().time_s; }
  [[nodiscard]] double end_s() const { return frames.back().time_s; }
};

/// Consecutive frames of a contact that belong to another body.
struct ForeignStretch {
  double begin_s = 0.0, end_s = 0.0;
  std::size_t frames = 0;
  double own_m = 0.0, other_m = kNoDistance;
  body::BodyIndex other = 0;
  bool second_foot = false;
};

Vec3 against_gravity(const body::BodyModel& model) {
  return model.gravity_G.norm() > 0.0 ? Vec3(-model.gravity_G.normalized()) : Vec3::UnitY();
}

/// Returns the center of pressure on the ground; empty if the force defines none.
std::optional<Vec3> pressure_center(const body::ExternalForce& force, double data_time_s, const Vec3& up) {
  const Vec3 at = force.point->at(data_time_s);
  if (!force.point->splines.empty() || !force.torque) return at;
  const Vec3 f = force.force->at(data_time_s);
  constexpr double kSteep = 0.3;  // a flatter force cuts the plane too far away
  if (!(f.dot(up) > kSteep * f.norm())) return std::nullopt;
  return at + up.cross(force.torque->at(data_time_s)) / f.dot(up);
}

bool is_on_the_ground(const body::ExternalForce& force) {
  return force.body != 0 && force.force_frame == 0 && force.point_frame == 0 && force.force && force.point &&
         !force.force->splines.empty() && (!force.point->splines.empty() || force.torque);
}

bool are_neighbors(const body::BodyModel& model, body::BodyIndex a, body::BodyIndex b) {
  return std::ranges::any_of(model.joints, [&](const body::Joint& joint) {
    return (joint.parent == a && joint.child == b) || (joint.parent == b && joint.child == a);
  });
}

/// The lowest point of each body and its speed, frame by frame.
struct Lowest {
  std::vector<std::optional<Vec3>> point_m;
  std::vector<double> speed_m_per_s;
};

Lowest lowest_of(const BodyPoints& points, std::size_t bodies, const Vec3& up, const Lowest& before, double since_s) {
  Lowest now{std::vector<std::optional<Vec3>>(bodies), std::vector<double>(bodies, kNoDistance)};
  for (std::size_t b = 1; b < bodies; ++b) {
    for (const Vec3& p : points.of(static_cast<body::BodyIndex>(b))) {
      if (!now.point_m[b] || p.dot(up) < now.point_m[b]->dot(up)) now.point_m[b] = p;
    }
    if (now.point_m[b] && b < before.point_m.size() && before.point_m[b] && since_s > 0.0)
      now.speed_m_per_s[b] = (*now.point_m[b] - *before.point_m[b]).norm() / since_s;
  }
  return now;
}

/// The loads of one trial over its frames.
class GroundContacts {
 public:
  GroundContacts(const body::BodyModel& model, const body::ExternalLoads& loads, BodyPoints points)
      : model_(model), loads_(loads), up_(against_gravity(model)), points_(std::move(points)) {
    const Eigen::Index n = points_.frame_count();
    step_ = std::max<Eigen::Index>(1, n / kContactFrames);
    for (const body::ExternalForce& force : loads.forces) {
      if (!is_on_the_ground(force)) continue;
      double largest = 0.0;
      for (Eigen::Index i = 0; i < n; i += step_) largest = std::max(largest, force.force->at(data_time(i)).norm());
      if (largest < kLimits.contacts.least_n) continue;
      forces_.push_back(&force);
      threshold_n_.push_back(std::max(kLimits.contacts.least_n, kLimits.contacts.least_share * largest));
    }
    of_force_.resize(forces_.size());
    walk();
  }

  [[nodiscard]] const std::vector<const body::ExternalForce*>& forces() const { return forces_; }
  [[nodiscard]] const std::vector<GroundContact>& of(std::size_t force) const { return of_force_[force]; }
  /// Returns true if a plate in the floor measures the force.
  [[nodiscard]] bool is_of_floor(std::size_t force) const {
    Vec3 sum_n = Vec3::Zero();
    std::vector<double> above;
    for (const GroundContact& contact : of_force_[force]) {
      for (const LoadedFrame& m : contact.frames) {
        sum_n += m.force_n;
        above.push_back(m.above_m);
      }
    }
    return !above.empty() && sum_n.dot(up_) >= kLimits.contacts.floor_cosine * sum_n.norm() &&
           math::median(std::move(above)) <= kLimits.contacts.two_steps_m;
  }

 private:
  [[nodiscard]] double data_time(Eigen::Index frame) const { return loads_.data_time_s(points_.time_s(frame)); }

  void walk() {
    Lowest before;
    double before_s = 0.0;
    std::vector<double> last_s(forces_.size(), -kNoDistance);
    for (Eigen::Index i = 0; i < points_.frame_count() && !forces_.empty(); i += step_) {
      points_.pose(i);
      const double now_s = points_.time_s(i);
      const Lowest lowest = lowest_of(points_, model_.bodies.size(), up_, before, now_s - before_s);
      const auto centers = centers_at(data_time(i));
      for (std::size_t k = 0; k < forces_.size(); ++k) {
        if (!centers[k]) continue;
        if (now_s - last_s[k] > std::max(kLimits.contacts.pause_s, 1.5 * (now_s - before_s)))
          of_force_[k].emplace_back();
        last_s[k] = now_s;
        of_force_[k].back().frames.push_back(frame_of(k, now_s, centers, lowest));
      }
      before = lowest;
      before_s = now_s;
    }
    for (std::vector<GroundContact>& contacts : of_force_)
      std::erase_if(contacts,
                    [](const GroundContact& c) { return c.end_s() - c.begin_s() < kLimits.contacts.least_s; });
  }

  [[nodiscard]] std::vector<std::optional<Vec3>> centers_at(double data_time_s) const {
    std::vector<std::optional<Vec3>> centers(forces_.size());
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      if (forces_[k]->force->at(data_time_s).norm() >= threshold_n_[k])
        centers[k] = pressure_center(*forces_[k], data_time_s, up_);
    }
    return centers;
  }

  [[nodiscard]] LoadedFrame frame_of(std::size_t k,
                                     double time_s,
                                     const std::vector<std::optional<Vec3>>& centers,
                                     const Lowest& lowest) const {
    const Vec3& p = *centers[k];
    const body::BodyIndex own = forces_[k]->body;
    LoadedFrame m{.time_s = time_s,
                  .own_m = points_.distance(p, own),
                  .force_n = forces_[k]->force->at(loads_.data_time_s(time_s)),
                  .above_m = above_all(p, lowest)};
    for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
      const auto body = static_cast<body::BodyIndex>(b);
      if (body == own || are_neighbors(model_, own, body)) continue;
      const double d = points_.of_one(p, body);
      if (d < m.other_m) {
        m.other_m = d;
        m.other = body;
      }
      if (d < m.second_m && d <= kLimits.contacts.second_foot_m && stands(b, own, lowest) &&
          !has_a_force(k, b, centers)) {
        m.second_m = d;
        m.second = body;
      }
    }
    return m;
  }

  [[nodiscard]] double above_all(const Vec3& p, const Lowest& lowest) const {
    double height = 0.0;
    for (const std::optional<Vec3>& point : lowest.point_m) {
      if (point) height = std::max(height, (p - *point).dot(up_));
    }
    return height;
  }

  /// Returns true for a body that does not move and is as low as the body of the force.
  [[nodiscard]] bool stands(std::size_t body, body::BodyIndex own, const Lowest& lowest) const {
    const auto& mine = lowest.point_m[static_cast<std::size_t>(own)];
    return mine && lowest.point_m[body] && lowest.speed_m_per_s[body] < kLimits.contacts.still_mps &&
           std::abs((*lowest.point_m[body] - *mine).dot(up_)) < kLimits.contacts.level_m;
  }

  /// Returns true if another force acts on the body, or under it.
  [[nodiscard]] bool has_a_force(std::size_t but,
                                 std::size_t body,
                                 const std::vector<std::optional<Vec3>>& centers) const {
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      if (k == but || !centers[k]) continue;
      if (forces_[k]->body == static_cast<body::BodyIndex>(body) ||
          points_.distance(*centers[k], static_cast<body::BodyIndex>(body)) < kLimits.contacts.off_body_m)
        return true;
    }
    return false;
  }

  const body::BodyModel& model_;
  const body::ExternalLoads& loads_;
  Vec3 up_;
  BodyPoints points_;
  Eigen::Index step_ = 1;
  std::vector<const body::ExternalForce*> forces_;
  std::vector<double> threshold_n_;
  std::vector<std::vector<GroundContact>> of_force_;
};

double usual_distance(const std::vector<LoadedFrame>& frames) {
  std::vector<double> own;
  for (const LoadedFrame& m : frames) own.push_back(m.own_m);
  return own.empty() ? kNoDistance : math::median(std::move(own));
}

/// Classifies a frame: 0 the body's own, 1 a foreign foot, 2 a second foot.
int frame_kind(const LoadedFrame& m, bool others_are_near) {
  if (!std::isfinite(m.own_m)) return 0;
  if (m.own_m > kLimits.contacts.off_body_m && m.other_m <= kLimits.contacts.much_nearer * m.own_m) return 1;
  if (m.own_m > kLimits.contacts.far_from_foot_m && others_are_near) return 1;
  if (m.own_m > kLimits.contacts.between_feet_m && m.second != 0) return 2;
  return 0;
}

void close_stretch(std::vector<ForeignStretch>& found, const std::vector<LoadedFrame>& part, int kind) {
  if (part.empty() || part.back().time_s - part.front().time_s < kLimits.contacts.least_s) return;
  ForeignStretch s{.begin_s = part.front().time_s,
                   .end_s = part.back().time_s,
                   .frames = part.size(),
                   .own_m = usual_distance(part),
                   .second_foot = kind == 2};
  const LoadedFrame& middle = part[part.size() / 2];
  s.other = kind == 2 ? middle.second : middle.other;
  s.other_m = kind == 2 ? middle.second_m : middle.other_m;
  found.push_back(s);
}

/// Returns the stretches of a contact that belong to another foot.
std::vector<ForeignStretch> foreign_stretches(const GroundContact& contact, bool others_are_near) {
  std::vector<ForeignStretch> found;
  std::vector<LoadedFrame> part;
  int kind = 0;
  for (const LoadedFrame& m : contact.frames) {
    const int now = frame_kind(m, others_are_near);
    if (now != kind) {
      if (kind != 0) close_stretch(found, part, kind);
      part.clear();
      kind = now;
    }
    part.push_back(m);
  }
  if (kind != 0) close_stretch(found, part, kind);
  return found;
}

/// Returns true if another body of the model is near.
bool is_of_another(const ForeignStretch& s) { return s.second_foot || s.other_m <= kLimits.contacts.second_foot_m; }

std::string stretch_words(const body::BodyModel& model, const ForeignStretch& s) {
  if (!is_of_another(s)) return fmt::format("from {:.4g} to {:.4g} s {:.2g} m away", s.begin_s, s.end_s, s.own_m);
  return fmt::format("from {:.4g} to {:.4g} s {} ({:.2g} m from its own, {:.2g} m from {})", s.begin_s, s.end_s,
                     s.second_foot ? "a second foot stands beside" : "another foot's", s.own_m, s.other_m,
                     model.bodies[static_cast<std::size_t>(s.other)].name);
}

/// Says the cause and the remedy of contacts that another body bears, or that no body of the model is near.
std::string remedy_of(bool of_another, bool own_clock) {
  if (of_another)
    return "; leave these times out ([[trial]] exclude = [\"foreign_contacts\"]), or give these forces to the body "
           "that "
           "bears them";
  return fmt::format(
      ", and no other body of the model is near: {}did somebody else step there? Then leave these "
      "times out ([[trial]] exclude = [\"foreign_contacts\"])",
      own_clock ? "are the forces on another clock than the motion ([sync] loads_offset_s), or " : "");
}

}  // namespace

ForeignContacts foreign_contacts(const body::BodyModel& model,
                                 const std::string& trial,
                                 const body::ExternalLoads& loads,
                                 BodyPoints points,
                                 bool own_clock) {
  ForeignContacts findings;
  const GroundContacts contacts(model, loads, std::move(points));
  for (std::size_t k = 0; k < contacts.forces().size(); ++k) {
    if (!contacts.is_of_floor(k)) continue;
    std::vector<double> usual;
    std::size_t loaded = 0;
    for (const GroundContact& c : contacts.of(k)) {
      usual.push_back(usual_distance(c.frames));
      loaded += c.frames.size();
    }
    const bool near = std::ranges::any_of(usual, [](double d) { return d < kLimits.contacts.off_body_m; });
    std::vector<std::string> said;
    std::size_t foreign = 0;
    std::size_t touched = 0;
    bool of_another = false;
    for (const GroundContact& c : contacts.of(k)) {
      const std::vector<ForeignStretch> stretches = foreign_stretches(c, near);
      touched += stretches.empty() ? 0 : 1;
      for (const ForeignStretch& s : stretches) {
        foreign += s.frames;
        of_another = of_another || is_of_another(s);
        said.push_back(stretch_words(model, s));
        findings.times.push_back({s.begin_s, s.end_s});
      }
    }
    if (said.empty()) continue;
    const body::ExternalForce& force = *contacts.forces()[k];
    const std::string& body = model.bodies[static_cast<std::size_t>(force.body)].name;
    findings.remarks.push_back(
        {.code = RemarkCode::foreign_contact,
         .severity = Severity::warning,
         .where = trial,
         .says = fmt::format(
             "'{}' is applied to {}, but {}, in {} of {} contacts and {:.0f} % of the loaded time: {}{}", force.name,
             body,
             of_another ? "not all that it bears is " + body + "'s" : "its center of pressure lies beside " + body,
             touched, contacts.of(k).size(), 100.0 * static_cast<double>(foreign) / static_cast<double>(loaded),
             fmt::join(said, "; "), remedy_of(of_another, own_clock))});
  }
  return findings;
}

}  // namespace myoid::study
