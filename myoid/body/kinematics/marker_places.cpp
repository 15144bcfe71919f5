#include "myoid/body/kinematics/marker_places.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/rigid_segment.h"

namespace myoid::body {
namespace {

constexpr Eigen::Index kFrames = 25;
constexpr double kLeast_m = 0.02, kMost_m = 0.04;
/// The next recorded marker is this many times as far.
constexpr double kOnlyOne = 1.5;
/// A marker on another body moves more than this about its place on this one.
constexpr double kStays_m = 0.02;

/// A body of the model with its markers, those under the model's names and those that were not recorded.
struct BodyMarkers {
  std::vector<Eigen::Index> seen;  ///< Columns of the recording.
  Eigen::Matrix3Xd seen_local_m, missing_local_m;
  std::vector<std::string> missing;
};

/// Returns the distance of the farthest point from the line through the two outermost ones [m].
double off_the_line_m(const Eigen::Matrix3Xd& points) {
  Eigen::Index a = 0, b = 0;
  double longest = -1.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    for (Eigen::Index j = i + 1; j < points.cols(); ++j) {
      const double d = (points.col(i) - points.col(j)).norm();
      if (d > longest) {
        longest = d;
        a = i;
        b = j;
      }
    }
  }
  if (!(longest > 0.0)) return 0.0;
  const Vec3 along = (points.col(b) - points.col(a)) / longest;
  double off = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 from = points.col(i) - points.col(a);
    off = std::max(off, from.cross(along).norm());
  }
  return off;
}

std::vector<BodyMarkers> bodies_of(const body::BodyModel& model, const MarkerSeries& markers) {
  MarkerSeries all;
  for (const body::Marker& m : model.markers) all.names.push_back(m.name);
  std::vector<BodyMarkers> bodies;
  for (const recording::ExpectedSegment& segment : segments_of(model, all)) {
    BodyMarkers body;
    const auto add = [](Eigen::Matrix3Xd& places, const Vec3& place) {
      places.conservativeResize(Eigen::NoChange, places.cols() + 1);
      places.rightCols(1) = place;
    };
    for (std::size_t k = 0; k < segment.segment.markers.size(); ++k) {
      const std::string& name = all.names[static_cast<std::size_t>(segment.segment.markers[k])];
      const Vec3 place = segment.local_m.col(static_cast<Eigen::Index>(k));
      const auto column = std::ranges::find(markers.names, name);
      if (column != markers.names.end()) {
        body.seen.push_back(column - markers.names.begin());
        add(body.seen_local_m, place);
      } else {
        body.missing.push_back(name);
        add(body.missing_local_m, place);
      }
    }
    if (body.seen.size() >= 3 && !body.missing.empty() && off_the_line_m(body.seen_local_m) > kLeast_m)
      bodies.push_back(std::move(body));
  }
  return bodies;
}

/// The body in one frame.
struct PlacedBody {
  recording::RigidFit fit;  ///< From the scaled body to the laboratory.
  double scale = 1.0;
};

std::optional<PlacedBody> placed(const BodyMarkers& body, const MarkerSeries& markers, Eigen::Index frame) {
  Eigen::Matrix3Xd seen(3, static_cast<Eigen::Index>(body.seen.size()));
  for (std::size_t k = 0; k < body.seen.size(); ++k) {
    if (markers.missing(frame, body.seen[k])) return std::nullopt;
    seen.col(static_cast<Eigen::Index>(k)) = markers.position(frame, body.seen[k]);
  }
  const auto spread = [](const Eigen::Matrix3Xd& points) {
    return (points.colwise() - points.rowwise().mean()).norm();
  };
  PlacedBody found;
  found.scale = spread(seen) / spread(body.seen_local_m);
  if (!(found.scale > 0.6 && found.scale < 1.6)) return std::nullopt;
  found.fit = recording::fit_rigid(found.scale * body.seen_local_m, seen);
  return found;
}

/// The distances of a recorded marker from a place on the body, and how far it wanders there.
struct Nearness {
  double median_m = 0.0, wander_m = 0.0;
  std::size_t frames = 0;
};

Nearness nearness(const MarkerSeries& markers,
                  const std::vector<std::pair<Eigen::Index, PlacedBody>>& frames,
                  const Vec3& local_m,
                  Eigen::Index marker) {
  std::vector<double> distances;
  std::vector<Vec3> on_body;
  for (const auto& [frame, body] : frames) {
    if (markers.missing(frame, marker)) continue;
    const Vec3 seen = markers.position(frame, marker);
    distances.push_back((body.fit.apply(body.scale * local_m) - seen).norm());
    on_body.push_back(body.fit.R.transpose() * (seen - body.fit.p_m));
  }
  Nearness found{.frames = distances.size()};
  if (distances.empty()) return found;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : on_body) mean += p / static_cast<double>(on_body.size());
  for (const Vec3& p : on_body) found.wander_m = std::max(found.wander_m, (p - mean).norm());
  found.median_m = math::median(std::move(distances));
  return found;
}

void pair_on(const BodyMarkers& body,
             const MarkerSeries& markers,
             const std::vector<Eigen::Index>& nameless,
             std::vector<PlacedMarker>& pairs) {
  std::vector<std::pair<Eigen::Index, PlacedBody>> frames;
  std::vector<double> residuals;
  const Eigen::Index step = std::max<Eigen::Index>(1, markers.frame_count() / kFrames);
  for (Eigen::Index frame = 0; frame < markers.frame_count(); frame += step) {
    const std::optional<PlacedBody> here = placed(body, markers, frame);
    if (!here) continue;
    frames.emplace_back(frame, *here);
    residuals.push_back(here->fit.rms_m);
  }
  if (frames.empty()) return;
  const double near_m = std::clamp(2.0 * math::median(std::move(residuals)), kLeast_m, kMost_m);
  for (std::size_t k = 0; k < body.missing.size(); ++k) {
    const Vec3 place = body.missing_local_m.col(static_cast<Eigen::Index>(k));
    std::optional<Eigen::Index> best;
    double least = 1e300, next = 1e300;
    for (const Eigen::Index marker : nameless) {
      const Nearness found = nearness(markers, frames, place, marker);
      if (2 * found.frames < frames.size() || found.frames == 0) continue;
      if (found.median_m < least) {
        next = least;
        least = found.median_m;
        best = found.wander_m < kStays_m ? std::optional(marker) : std::nullopt;
      } else {
        next = std::min(next, found.median_m);
      }
    }
    if (best && least < near_m && next > kOnlyOne * least)
      pairs.push_back({markers.names[static_cast<std::size_t>(*best)], body.missing[k], least});
  }
}

}  // namespace

std::vector<PlacedMarker> markers_by_place(const body::BodyModel& model, const MarkerSeries& markers) {
  std::vector<Eigen::Index> nameless;
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    if (!model.find_marker(markers.names[static_cast<std::size_t>(m)])) nameless.push_back(m);
  }
  std::vector<PlacedMarker> pairs;
  if (nameless.empty()) return pairs;
  for (const BodyMarkers& body : bodies_of(model, markers)) pair_on(body, markers, nameless, pairs);
  // One recorded marker is one marker: of two places the nearer.
  std::ranges::stable_sort(pairs, {}, &PlacedMarker::distance_m);
  std::vector<PlacedMarker> unique;
  for (PlacedMarker& pair : pairs) {
    if (std::ranges::find(unique, pair.recorded, &PlacedMarker::recorded) == unique.end())
      unique.push_back(std::move(pair));
  }
  return unique;
}

std::string place_question(const std::vector<PlacedMarker>& pairs) {
  std::vector<std::string> places;
  for (const PlacedMarker& pair : pairs)
    places.push_back(
        fmt::format("'{}' where the model has '{}' ({:.0f} mm)", pair.recorded, pair.wanted, 1000.0 * pair.distance_m));
  return fmt::format("recorded markers stand at places of the model's under another name: {}; are they the same?",
                     fmt::join(places, ", "));
}

}  // namespace myoid::body
