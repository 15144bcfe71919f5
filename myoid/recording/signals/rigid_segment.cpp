#include "myoid/recording/signals/rigid_segment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::recording {
namespace {

using ground::MarkerSeries;

constexpr Eigen::Index kLeastFrames = 3;

/// Returns the positions of the segment's markers in one frame, NaN for missing ones.
Eigen::Matrix3Xd seen(const MarkerSeries& markers, const RigidSegment& segment, Eigen::Index f) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(segment.markers.size()));
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    points.col(k) = markers.position(f, segment.markers[static_cast<std::size_t>(k)]);
  return points;
}

/// Two markers of one segment and the frames in which their distance departs from its median.
struct Pair {
  Eigen::Index first = 0, second = 0;
  std::vector<Eigen::Index> frames;
  double worst_m = 0.0;
  double median_m = 0.0;
};

Pair compare(const MarkerSeries& markers, Eigen::Index a, Eigen::Index b) {
  Pair pair{.first = a, .second = b};
  std::vector<Eigen::Index> frames;
  std::vector<double> distances;
  for (Eigen::Index f = 0; f < markers.frame_count(); ++f) {
    if (markers.missing(f, a) || markers.missing(f, b)) continue;
    frames.push_back(f);
    distances.push_back((markers.position(f, a) - markers.position(f, b)).norm());
  }
  if (distances.empty()) return pair;
  pair.median_m = math::upper_median(distances);
  const double limit = std::max(kLimits.markers.rigid_m, kLimits.markers.rigid_share * pair.median_m);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double change = std::abs(distances[i] - pair.median_m);
    if (change <= limit) continue;
    pair.frames.push_back(frames[i]);
    pair.worst_m = std::max(pair.worst_m, change);
  }
  return pair;
}

}  // namespace

RigidFit fit_rigid(const Eigen::Matrix3Xd& local_m, const Eigen::Matrix3Xd& seen_m) {
  if (local_m.cols() < 3 || local_m.cols() != seen_m.cols()) {
    throw InvalidInput("rigid fit: {} and {} points; expected as many, three or more", local_m.cols(), seen_m.cols());
  }
  const Vec3 from = local_m.rowwise().mean();
  const Vec3 to = seen_m.rowwise().mean();
  const Mat3 covariance = (seen_m.colwise() - to) * (local_m.colwise() - from).transpose();
  RigidFit fit;
  fit.R = math::nearest_rotation(covariance);
  fit.p_m = to - fit.R * from;
  const Eigen::Matrix3Xd rest = seen_m - ((fit.R * local_m).colwise() + fit.p_m);
  fit.rms_m = std::sqrt(rest.squaredNorm() / static_cast<double>(rest.cols()));
  return fit;
}

Eigen::Matrix3Xd mean_shape(const MarkerSeries& markers, const RigidSegment& segment) {
  Eigen::Matrix3Xd first(3, 0);
  if (segment.markers.size() < 3) return first;
  Eigen::Matrix3Xd sum;
  double count = 0.0;
  for (Eigen::Index f = 0; f < markers.frame_count(); ++f) {
    const Eigen::Matrix3Xd now = seen(markers, segment, f);
    if (!now.allFinite()) continue;
    if (first.cols() == 0) {
      first = now.colwise() - Vec3(now.rowwise().mean());
      sum = Eigen::Matrix3Xd::Zero(3, now.cols());
    }
    const RigidFit fit = fit_rigid(now, first);
    sum += (fit.R * now).colwise() + fit.p_m;
    count += 1.0;
  }
  if (count > 0.0) first = sum / count;
  return first;
}

std::vector<Remark> check_rigid_segments(const MarkerSeries& markers, const std::vector<RigidSegment>& segments) {
  std::vector<Remark> faults;
  const auto marker = [&](Eigen::Index m) { return markers.names[static_cast<std::size_t>(m)]; };
  for (const RigidSegment& segment : segments) {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < segment.markers.size(); ++i) {
      for (std::size_t k = i + 1; k < segment.markers.size(); ++k) {
        Pair pair = compare(markers, segment.markers[i], segment.markers[k]);
        if (static_cast<Eigen::Index>(pair.frames.size()) >= kLeastFrames) pairs.push_back(std::move(pair));
      }
    }
    // The marker with the most departures comes first; departures that it explains are not counted again.
    while (!pairs.empty()) {
      Eigen::Index culprit = -1;
      std::size_t most = 0;
      for (const Eigen::Index m : segment.markers) {
        std::size_t frames = 0;
        for (const Pair& p : pairs) frames += p.first == m || p.second == m ? p.frames.size() : 0;
        if (frames > most) {
          most = frames;
          culprit = m;
        }
      }
      const Pair* worst = nullptr;
      Eigen::Index begin = std::numeric_limits<Eigen::Index>::max();
      Eigen::Index end = 0;
      int partners = 0;
      for (const Pair& p : pairs) {
        if (p.first != culprit && p.second != culprit) continue;
        ++partners;
        if (worst == nullptr || p.worst_m > worst->worst_m) worst = &p;
        begin = std::min(begin, p.frames.front());
        end = std::max(end, p.frames.back());
      }
      const Eigen::Index other = worst->first == culprit ? worst->second : worst->first;
      faults.push_back(
          {.code = RemarkCode::segment_not_rigid,
           .severity = Severity::warning,
           .about = partners > 1 ? marker(culprit) : fmt::format("{}, {}", marker(culprit), marker(other)),
           .when = Stretch{markers.time_s[begin], markers.time_s[end]},
           .value = worst->worst_m,
           .says = fmt::format(
               "marker '{}' of {}: its distance to '{}', {:.0f} mm, changes by {:.0f} mm between {:.6g} and {:.6g} s",
               marker(culprit), segment.name, marker(other), 1000.0 * worst->median_m, 1000.0 * worst->worst_m,
               markers.time_s[begin], markers.time_s[end]),
           .remedy =
               "a wrong label or a marker that came loose? Give it a small [markers] weight, or cut that part off"});
      std::erase_if(pairs, [&](const Pair& p) { return p.first == culprit || p.second == culprit; });
    }
  }
  return faults;
}

}  // namespace myoid::recording
