#include "myoid/study/checks/load_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/math/statistics.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

constexpr double kLoaded = 0.2;  ///< Share of the largest force.
constexpr double kNone = std::numeric_limits<double>::infinity();

/// A force whose center of pressure moves over the ground; medians over the frames in which it is loaded.
struct Load {
  const body::ExternalForce* force = nullptr;
  std::vector<double> distance_m;                              ///< From each body with its neighbors.
  std::vector<double> alone_m;                                 ///< From each body alone.
  std::array<double, 4> turned_m{kNone, kNone, kNone, kNone};  ///< From its body after turns by 90 degrees upright.
  double above_lowest_m = kNone;                               ///< Height of its body above the lowest body.
  [[nodiscard]] double off_m(body::BodyIndex body) const { return distance_m[static_cast<std::size_t>(body)]; }
  [[nodiscard]] double own_m() const { return off_m(force->body); }
};

/// Returns the median of the finite values of the frames; infinite if there are none.
template <typename Value>
double median_of(const std::vector<const ContactFrame*>& frames, const Value& value) {
  std::vector<double> values;
  for (const ContactFrame* frame : frames) {
    if (const double v = value(*frame); std::isfinite(v)) values.push_back(v);
  }
  return values.empty() ? kNone : math::median(std::move(values));
}

/// Returns the height of the body's lowest point above the lowest one of all bodies.
double height_m(const ContactFrame& frame, body::BodyIndex body, const Vec3& up) {
  const std::optional<Vec3>& own = frame.lowest_m[static_cast<std::size_t>(body)];
  if (!own) return kNone;
  double height = 0.0;
  for (const std::optional<Vec3>& other : frame.lowest_m)
    if (other) height = std::max(height, (*own - *other).dot(up));
  return height;
}

Load load_of(const ContactTable& table, std::size_t k) {
  const ContactForce& of = table.forces[k];
  std::vector<const ContactFrame*> loaded;
  for (const ContactFrame& frame : table.frames)
    if (frame.of[k] && frame.of[k]->force_n.norm() >= kLoaded * of.largest_n) loaded.push_back(&frame);
  Load load{.force = of.force, .distance_m = {}, .alone_m = {}};
  for (std::size_t b = 0; b < table.frames.front().lowest_m.size(); ++b) {
    load.distance_m.push_back(median_of(loaded, [&](const ContactFrame& f) { return f.of[k]->near_m[b]; }));
    load.alone_m.push_back(median_of(loaded, [&](const ContactFrame& f) { return f.of[k]->alone_m[b]; }));
  }
  for (std::size_t turn = 0; turn < 4; ++turn)
    load.turned_m[turn] = median_of(loaded, [&](const ContactFrame& f) { return f.of[k]->turned_m[turn]; });
  load.above_lowest_m = median_of(loaded, [&](const ContactFrame& f) { return height_m(f, of.force->body, table.up); });
  return load;
}

/// Finds loads of one file that do not act where their bodies are; the most probable cause of each comes first.
class Placement {
 public:
  Placement(const body::BodyModel& model, std::vector<Load> loads, const std::string& file)
      : model_(model), loads_(std::move(loads)), file_(file), said_(loads_.size(), false) {}

  std::vector<Remark> findings() {
    if (find_turn()) return std::move(found_);
    for (std::size_t i = 0; i < loads_.size(); ++i) {
      find_far(i);
      for (std::size_t j = i + 1; j < loads_.size(); ++j) find_exchanged(i, j);
    }
    for (std::size_t i = 0; i < loads_.size(); ++i) find_beside(i);
    return std::move(found_);
  }

 private:
  void add(Severity severity, const std::string& text) {
    found_.push_back({.code = RemarkCode::load_misplaced, .severity = severity, .says = file_ + ": " + text});
  }
  [[nodiscard]] const std::string& name(body::BodyIndex b) const {
    return model_.bodies[static_cast<std::size_t>(b)].name;
  }

  /// Finds a turn about the vertical that brings all points under their bodies.
  bool find_turn() {
    const auto measured = [](const Load& load) { return load.own_m() < kNone; };
    if (std::ranges::none_of(loads_,
                             [&](const Load& l) { return measured(l) && l.own_m() > kLimits.contacts.far_off_m; }))
      return false;
    for (std::size_t turn = 1; turn < 4; ++turn) {
      if (std::ranges::any_of(
              loads_, [&](const Load& l) { return measured(l) && l.turned_m[turn] > kLimits.contacts.off_body_m; }))
        continue;
      std::vector<std::string> now, then, names;
      for (const Load& load : loads_) {
        if (!measured(load)) continue;
        names.push_back(fmt::format("'{}'", load.force->name));
        now.push_back(fmt::format("{:.2g}", load.own_m()));
        then.push_back(fmt::format("{:.2g}", load.turned_m[turn]));
      }
      add(Severity::error,
          fmt::format(
              "the points of {} lie {} m from the bodies on which they act (median while loaded), and {} m after "
              "a turn by {} degrees about the vertical: turn the loads so, or the motion back",
              fmt::join(names, ", "), fmt::join(now, ", "), fmt::join(then, ", "), 90 * turn));
      return true;
    }
    return false;
  }

  void find_far(std::size_t i) {
    const Load& load = loads_[i];
    if (said_[i] || !(load.own_m() > kLimits.contacts.elsewhere_m) || load.own_m() == kNone) return;
    said_[i] = true;
    add(Severity::error,
        fmt::format(
            "the point of '{}' lies {:.3g} m from {}, on which it acts (median while loaded), expected under it: "
            "is it in mm, or in other axes or another origin than the motion?",
            load.force->name, load.own_m(), name(load.force->body)));
  }

  void find_exchanged(std::size_t i, std::size_t j) {
    const Load &a = loads_[i], &b = loads_[j];
    if (said_[i] || said_[j] || a.force->body == b.force->body || a.own_m() < kLimits.contacts.off_body_m ||
        b.own_m() < kLimits.contacts.off_body_m || a.off_m(b.force->body) > kLimits.contacts.much_nearer * a.own_m() ||
        b.off_m(a.force->body) > kLimits.contacts.much_nearer * b.own_m())
      return;
    said_[i] = said_[j] = true;
    add(Severity::error,
        fmt::format(
            "'{}' is applied to {} and '{}' to {}, but each acts at the other's: {:.2g} m from its own body and "
            "{:.2g} m from the other (median while loaded); exchange their applied_to_body",
            a.force->name, name(a.force->body), b.force->name, name(b.force->body), a.own_m(), a.off_m(b.force->body)));
  }

  void find_beside(std::size_t i) {
    const Load& load = loads_[i];
    if (said_[i] || load.own_m() < kLimits.contacts.off_body_m || load.own_m() == kNone) return;
    const auto nearest = std::min_element(load.alone_m.begin() + 1, load.alone_m.end()) - load.alone_m.begin();
    const double least_m = load.alone_m[static_cast<std::size_t>(nearest)];
    if (least_m <= kLimits.contacts.much_nearer * load.own_m()) {
      add(Severity::warning,
          fmt::format("'{}' is applied to {}, but acts {:.2g} m from it (median while loaded) and {:.2g} m from {}; is "
                      "applied_to_body right?",
                      load.force->name, name(load.force->body), load.own_m(), least_m,
                      name(static_cast<body::BodyIndex>(nearest))));
    } else if (load.own_m() > kLimits.contacts.far_off_m && load.above_lowest_m < kLimits.contacts.far_off_m) {
      add(Severity::warning,
          fmt::format("'{}' is applied to {}, but acts {:.2g} m from it (median while loaded), expected under it (less "
                      "than {:g} m), and under no other body: are the loads on another clock than the motion, or in "
                      "other axes or another origin?",
                      load.force->name, name(load.force->body), load.own_m(), kLimits.contacts.far_off_m));
    }
  }

  const body::BodyModel& model_;
  std::vector<Load> loads_;
  const std::string& file_;
  std::vector<bool> said_;
  std::vector<Remark> found_;
};

}  // namespace

std::vector<Remark> misplaced_loads(const body::BodyModel& model, const ContactTable& table, const std::string& file) {
  std::vector<Load> loads;
  for (std::size_t k = 0; k < table.forces.size(); ++k)
    if (!table.forces[k].force->point->splines.empty()) loads.push_back(load_of(table, k));
  return Placement(model, std::move(loads), file).findings();
}

}  // namespace myoid::study
