#include "myoid/checks/load_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "myoid/checks/body_points.h"
#include "myoid/intake/limits.h"
#include "myoid/math/statistics.h"

namespace myoid {
namespace {

constexpr double kLoaded = 0.2;  ///< Share of the largest force.
constexpr int kFrames = 200;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// Returns true for a force on a body whose center of pressure moves over the ground.
bool is_under_a_foot(const dynamics::ExternalForce& force) {
  return force.body != 0 && force.force_frame == 0 && force.point_frame == 0 && force.force && force.point &&
         !force.force->splines.empty() && !force.point->splines.empty();
}

struct Load {
  const dynamics::ExternalForce* force = nullptr;
  std::vector<double> distance_m;  ///< Median distance from each body with its neighbors.
  std::vector<double> alone_m;     ///< Median distance from each body alone.
};

double median_of(std::vector<double> values) { return values.empty() ? kNone : math::median(std::move(values)); }

std::vector<Load> distances(const model::BodyModel& model, const dynamics::ExternalLoads& loads, BodyPoints& points) {
  std::vector<Load> result;
  std::vector<double> largest_n;
  const Eigen::Index n = points.frame_count();
  const Eigen::Index step = std::max<Eigen::Index>(1, n / kFrames);
  const auto at = [&](Eigen::Index frame) { return loads.data_time_s(points.time_s(frame)); };
  for (const dynamics::ExternalForce& force : loads.forces) {
    if (!is_under_a_foot(force)) continue;
    double largest = 0.0;
    for (Eigen::Index i = 0; i < n; i += step) largest = std::max(largest, force.force->at(at(i)).norm());
    if (!(largest > 0.0)) continue;
    result.push_back({&force, {}, {}});
    largest_n.push_back(largest);
  }
  const std::vector<std::vector<double>> none(model.bodies.size());
  std::vector<std::vector<std::vector<double>>> all(result.size(), none), alone = all;
  for (Eigen::Index i = 0; i < n && !result.empty(); i += step) {
    points.pose(i);
    for (std::size_t k = 0; k < result.size(); ++k) {
      if (result[k].force->force->at(at(i)).norm() < kLoaded * largest_n[k]) continue;
      const Vec3 p = result[k].force->point->at(at(i));
      for (std::size_t b = 1; b < model.bodies.size(); ++b) {
        const double d = points.distance(p, static_cast<model::BodyIndex>(b));
        if (std::isfinite(d)) all[k][b].push_back(d);
        const double one = points.of_one(p, static_cast<model::BodyIndex>(b));
        if (std::isfinite(one)) alone[k][b].push_back(one);
      }
    }
  }
  for (std::size_t k = 0; k < result.size(); ++k) {
    for (std::vector<double>& of_body : all[k]) result[k].distance_m.push_back(median_of(std::move(of_body)));
    for (std::vector<double>& of_body : alone[k]) result[k].alone_m.push_back(median_of(std::move(of_body)));
  }
  return result;
}

}  // namespace

std::vector<Remark> misplaced_loads(const model::BodyModel& model,
                                    const dynamics::ExternalLoads& all,
                                    const recording::MarkerSeries* markers,
                                    const TimeSeries* motion,
                                    const std::string& file) {
  std::vector<Remark> found;
  if (markers == nullptr && motion == nullptr) return found;
  BodyPoints points(model, markers, motion);
  const std::vector<Load> loads = distances(model, all, points);
  const auto name = [&](model::BodyIndex b) { return model.bodies[static_cast<std::size_t>(b)].name; };
  const auto off = [&](const Load& load, model::BodyIndex body) {
    return load.distance_m[static_cast<std::size_t>(body)];
  };
  std::vector<bool> said(loads.size(), false);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const model::BodyIndex own = loads[i].force->body;
    if (off(loads[i], own) > kLimits.elsewhere_m && off(loads[i], own) < kNone) {
      said[i] = true;
      found.push_back(
          {.code = RemarkCode::load_misplaced,
           .severity = Severity::error,
           .says = fmt::format("{}: the point of '{}' lies {:.3g} m from {}, on which it acts (median while loaded), "
                               "expected under it: is it in mm, or in other axes or another origin than the motion?",
                               file, loads[i].force->name, off(loads[i], own), name(own))});
    }
    for (std::size_t j = i + 1; j < loads.size() && !said[i]; ++j) {
      const model::BodyIndex other = loads[j].force->body;
      if (other == own || said[j] || off(loads[i], own) < kLimits.off_body_m ||
          off(loads[j], other) < kLimits.off_body_m ||
          off(loads[i], other) > kLimits.much_nearer * off(loads[i], own) ||
          off(loads[j], own) > kLimits.much_nearer * off(loads[j], other))
        continue;
      said[i] = said[j] = true;
      found.push_back({.code = RemarkCode::load_misplaced,
                       .severity = Severity::error,
                       .says = fmt::format(
                           "{}: '{}' is applied to {} and '{}' to {}, but each acts at the other's: {:.2g} m from its "
                           "own body and {:.2g} m from the other (median while loaded); exchange their applied_to_body",
                           file, loads[i].force->name, name(own), loads[j].force->name, name(other), off(loads[i], own),
                           off(loads[i], other))});
    }
  }
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const model::BodyIndex own = loads[i].force->body;
    if (said[i] || off(loads[i], own) < kLimits.off_body_m || off(loads[i], own) == kNone) continue;
    const std::vector<double>& alone = loads[i].alone_m;
    const auto nearest = std::min_element(alone.begin() + 1, alone.end()) - alone.begin();
    if (alone[static_cast<std::size_t>(nearest)] > kLimits.much_nearer * off(loads[i], own)) continue;
    found.push_back(
        {.code = RemarkCode::load_misplaced,
         .severity = Severity::warning,
         .says = fmt::format("{}: '{}' is applied to {}, but acts {:.2g} m from it (median while loaded) and {:.2g} m "
                             "from {}; is applied_to_body right?",
                             file, loads[i].force->name, name(own), off(loads[i], own),
                             alone[static_cast<std::size_t>(nearest)], name(static_cast<model::BodyIndex>(nearest)))});
  }
  return found;
}

}  // namespace myoid
