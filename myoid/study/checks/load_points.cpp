#include "myoid/study/checks/load_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/math/statistics.h"
#include "myoid/study/checks/body_points.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

constexpr double kLoaded = 0.2;  ///< Share of the largest force.
constexpr int kFrames = 200;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// Returns true for a force on a body whose center of pressure moves over the ground.
bool is_under_a_foot(const body::ExternalForce& force) {
  return force.body != 0 && force.force_frame == 0 && force.point_frame == 0 && force.force && force.point &&
         !force.force->splines.empty() && !force.point->splines.empty();
}

struct Load {
  const body::ExternalForce* force = nullptr;
  std::vector<double> distance_m;                              ///< Median distance from each body with its neighbors.
  std::vector<double> alone_m;                                 ///< Median distance from each body alone.
  std::array<double, 4> turned_m{kNone, kNone, kNone, kNone};  ///< From its body after turns by 90 degrees upright.
  double above_lowest_m = kNone;                               ///< Median height of its body above the lowest body.
  [[nodiscard]] double off_m(body::BodyIndex body) const { return distance_m[static_cast<std::size_t>(body)]; }
  [[nodiscard]] double own_m() const { return off_m(force->body); }
};

/// The distances of one load, frame by frame.
struct Samples {
  std::vector<std::vector<double>> all, alone;
  std::array<std::vector<double>, 4> turned;
  std::vector<double> above_lowest;

  explicit Samples(std::size_t bodies) : all(bodies), alone(bodies) {}
  void add(const BodyPoints& points, const Vec3& p, body::BodyIndex own, const Vec3& up) {
    constexpr double kFarBelow_m = 1e4;  // from there, distances differ as heights do
    const Vec3 below = p - kFarBelow_m * up;
    double lowest = kNone;
    for (std::size_t b = 1; b < all.size(); ++b) {
      const auto body = static_cast<body::BodyIndex>(b);
      const double d = points.distance(p, body), one = points.of_one(p, body);
      if (std::isfinite(d)) all[b].push_back(d);
      if (std::isfinite(one)) alone[b].push_back(one);
      lowest = std::min(lowest, points.of_one(below, body));
    }
    const double own_height = points.of_one(below, own);
    if (std::isfinite(own_height)) above_lowest.push_back(own_height - lowest);
    for (std::size_t k = 0; k < turned.size(); ++k) {
      const Eigen::AngleAxisd turn(0.5 * std::numbers::pi * static_cast<double>(k), up);
      const double d = points.distance(turn * p, own);
      if (std::isfinite(d)) turned[k].push_back(d);
    }
  }
};

double median_of(std::vector<double> values) { return values.empty() ? kNone : math::median(std::move(values)); }

std::vector<Load> distances(const body::BodyModel& model, const body::ExternalLoads& loads, BodyPoints& points) {
  std::vector<Load> result;
  std::vector<double> largest_n;
  const Vec3 up = model.gravity_G.norm() > 0.0 ? Vec3(-model.gravity_G.normalized()) : Vec3(Vec3::UnitY());
  const Eigen::Index n = points.frame_count();
  const Eigen::Index step = std::max<Eigen::Index>(1, n / kFrames);
  const auto at = [&](Eigen::Index frame) { return loads.data_time_s(points.time_s(frame)); };
  for (const body::ExternalForce& force : loads.forces) {
    if (!is_under_a_foot(force)) continue;
    double largest = 0.0;
    for (Eigen::Index i = 0; i < n; i += step) largest = std::max(largest, force.force->at(at(i)).norm());
    if (!(largest > 0.0)) continue;
    result.push_back({.force = &force, .distance_m = {}, .alone_m = {}});
    largest_n.push_back(largest);
  }
  std::vector<Samples> samples(result.size(), Samples(model.bodies.size()));
  for (Eigen::Index i = 0; i < n && !result.empty(); i += step) {
    points.pose(i);
    for (std::size_t k = 0; k < result.size(); ++k) {
      if (result[k].force->force->at(at(i)).norm() < kLoaded * largest_n[k]) continue;
      samples[k].add(points, result[k].force->point->at(at(i)), result[k].force->body, up);
    }
  }
  for (std::size_t k = 0; k < result.size(); ++k) {
    for (std::vector<double>& of_body : samples[k].all) result[k].distance_m.push_back(median_of(std::move(of_body)));
    for (std::vector<double>& of_body : samples[k].alone) result[k].alone_m.push_back(median_of(std::move(of_body)));
    for (std::size_t turn = 0; turn < 4; ++turn)
      result[k].turned_m[turn] = median_of(std::move(samples[k].turned[turn]));
    result[k].above_lowest_m = median_of(std::move(samples[k].above_lowest));
  }
  return result;
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

std::vector<Remark> misplaced_loads(const body::BodyModel& model,
                                    const body::ExternalLoads& all,
                                    const MarkerSeries* markers,
                                    const TimeSeries* motion,
                                    const std::string& file) {
  if (markers == nullptr && motion == nullptr) return {};
  BodyPoints points(model, markers, motion);
  return Placement(model, distances(model, all, points), file).findings();
}

}  // namespace myoid::study
