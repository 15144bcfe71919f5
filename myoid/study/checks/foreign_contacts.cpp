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

constexpr double kNoDistance = std::numeric_limits<double>::infinity();

/// One frame with a load.
struct LoadedFrame {
  double time_s = 0.0;
  double own_m = kNoDistance;    ///< Distance from the force's body or its neighbors.
  double other_m = kNoDistance;  ///< Distance from the nearest other body.
  body::BodyIndex other = 0;
  body::BodyIndex second = 0;  ///< A second foot on the ground nearby, or 0.
  double second_m = kNoDistance;
};

using Contact = std::vector<LoadedFrame>;

/// Consecutive frames of a contact that belong to another body.
struct ForeignStretch {
  double begin_s = 0.0, end_s = 0.0;
  std::size_t frames = 0;
  double own_m = 0.0, other_m = kNoDistance;
  body::BodyIndex other = 0;
  bool second_foot = false;
};

bool are_neighbors(const body::BodyModel& model, body::BodyIndex a, body::BodyIndex b) {
  return std::ranges::any_of(model.joints, [&](const body::Joint& joint) {
    return (joint.parent == a && joint.child == b) || (joint.parent == b && joint.child == a);
  });
}

/// The contacts of each force of one trial.
class Contacts {
 public:
  Contacts(const body::BodyModel& model, const ContactTable& table) : model_(model), table_(table) {}

  /// Returns the contacts of a force; none unless a plate in the floor measures it.
  [[nodiscard]] std::vector<Contact> of(std::size_t force) const {
    if (table_.forces[force].largest_n < kLimits.contacts.least_n || !is_of_floor(force)) return {};
    std::vector<Contact> contacts;
    double last_s = -kNoDistance, before_s = 0.0;
    for (const ContactFrame& frame : table_.frames) {
      if (is_loaded(frame, force)) {
        if (frame.time_s - last_s > std::max(kLimits.contacts.pause_s, 1.5 * (frame.time_s - before_s)))
          contacts.emplace_back();
        last_s = frame.time_s;
        contacts.back().push_back(loaded_frame(frame, force));
      }
      before_s = frame.time_s;
    }
    std::erase_if(contacts, is_knock);
    return contacts;
  }

 private:
  static bool is_knock(const Contact& c) { return c.back().time_s - c.front().time_s < kLimits.contacts.least_s; }

  [[nodiscard]] bool is_loaded(const ContactFrame& frame, std::size_t force) const {
    return table_.forces[force].largest_n >= kLimits.contacts.least_n && frame.of[force] &&
           frame.of[force]->force_n.norm() >= kLimits.contacts.least_n;
  }

  [[nodiscard]] bool is_of_floor(std::size_t force) const {
    Vec3 sum_n = Vec3::Zero();
    std::vector<double> above_m;
    for (const ContactFrame& frame : table_.frames) {
      if (!is_loaded(frame, force)) continue;
      sum_n += frame.of[force]->force_n;
      double height_m = 0.0;  // above the lowest point of all bodies
      for (const std::optional<Vec3>& point : frame.lowest_m) {
        if (point) height_m = std::max(height_m, (frame.of[force]->center_m - *point).dot(table_.up));
      }
      above_m.push_back(height_m);
    }
    return !above_m.empty() && sum_n.dot(table_.up) >= kLimits.contacts.floor_cosine * sum_n.norm() &&
           math::median(std::move(above_m)) <= kLimits.contacts.two_steps_m;
  }

  [[nodiscard]] LoadedFrame loaded_frame(const ContactFrame& frame, std::size_t force) const {
    const GroundContact& contact = *frame.of[force];
    const body::BodyIndex own = table_.forces[force].force->body;
    LoadedFrame m{.time_s = frame.time_s, .own_m = contact.near_m[static_cast<std::size_t>(own)]};
    for (std::size_t b = 1; b < contact.alone_m.size(); ++b) {
      const auto body = static_cast<body::BodyIndex>(b);
      if (body == own || are_neighbors(model_, own, body)) continue;
      const double d = contact.alone_m[b];
      if (d < m.other_m) {
        m.other_m = d;
        m.other = body;
      }
      if (d < m.second_m && d <= kLimits.contacts.second_foot_m && stands(frame, b, own) &&
          !has_a_force(frame, force, b)) {
        m.second_m = d;
        m.second = body;
      }
    }
    return m;
  }

  /// Returns true for a body that does not move and is as low as the body of the force.
  [[nodiscard]] bool stands(const ContactFrame& frame, std::size_t body, body::BodyIndex own) const {
    const auto& mine = frame.lowest_m[static_cast<std::size_t>(own)];
    return mine && frame.lowest_m[body] && frame.speed_mps[body] < kLimits.contacts.still_mps &&
           std::abs((*frame.lowest_m[body] - *mine).dot(table_.up)) < kLimits.contacts.level_m;
  }

  /// Returns true if another force acts on the body, or under it.
  [[nodiscard]] bool has_a_force(const ContactFrame& frame, std::size_t but, std::size_t body) const {
    for (std::size_t k = 0; k < table_.forces.size(); ++k) {
      if (k == but || !is_loaded(frame, k)) continue;
      if (table_.forces[k].force->body == static_cast<body::BodyIndex>(body) ||
          frame.of[k]->near_m[body] < kLimits.contacts.off_body_m)
        return true;
    }
    return false;
  }

  const body::BodyModel& model_;
  const ContactTable& table_;
};

double usual_distance(const Contact& frames) {
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

void close_stretch(std::vector<ForeignStretch>& found, const Contact& part, int kind) {
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
std::vector<ForeignStretch> foreign_stretches(const Contact& contact, bool others_are_near) {
  std::vector<ForeignStretch> found;
  Contact part;
  int kind = 0;
  for (const LoadedFrame& m : contact) {
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
                                 const ContactTable& table,
                                 bool own_clock) {
  ForeignContacts findings;
  const Contacts all(model, table);
  for (std::size_t k = 0; k < table.forces.size(); ++k) {
    const std::vector<Contact> contacts = all.of(k);
    std::vector<double> usual;
    std::size_t loaded = 0;
    for (const Contact& c : contacts) {
      usual.push_back(usual_distance(c));
      loaded += c.size();
    }
    const bool near = std::ranges::any_of(usual, [](double d) { return d < kLimits.contacts.off_body_m; });
    std::vector<std::string> said;
    std::size_t foreign = 0;
    std::size_t touched = 0;
    bool of_another = false;
    for (const Contact& c : contacts) {
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
    const body::ExternalForce& force = *table.forces[k].force;
    const std::string& body = model.bodies[static_cast<std::size_t>(force.body)].name;
    findings.remarks.push_back(
        {.code = RemarkCode::foreign_contact,
         .severity = Severity::warning,
         .where = trial,
         .says = fmt::format(
             "'{}' is applied to {}, but {}, in {} of {} contacts and {:.0f} % of the loaded time: {}{}", force.name,
             body,
             of_another ? "not all that it bears is " + body + "'s" : "its center of pressure lies beside " + body,
             touched, contacts.size(), 100.0 * static_cast<double>(foreign) / static_cast<double>(loaded),
             fmt::join(said, "; "), remedy_of(of_another, own_clock))});
  }
  return findings;
}

}  // namespace myoid::study
