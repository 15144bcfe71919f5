#include "myoid/recording/signals/mend_markers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/spline.h"
#include "myoid/recording/signals/marker_quality.h"
#include "myoid/recording/signals/marker_swaps.h"

namespace myoid::recording {
namespace {

using ground::MarkerSeries;

constexpr int kNeighbors = 4;
constexpr double kApart_s = 0.03;  ///< The noise of nearer frames would spoil the slope.

/// Returns up to `kNeighbors` frames on each side of a gap that show the marker, `kApart_s` apart.
std::vector<Eigen::Index> neighbors(const MarkerSeries& markers, const MarkerGap& gap) {
  std::vector<Eigen::Index> frames;
  const auto walk = [&](Eigen::Index from, Eigen::Index step) {
    int found = 0;
    double last_s = 0.0;
    for (Eigen::Index f = from; f >= 0 && f < markers.frame_count() && found < kNeighbors; f += step) {
      const double t = markers.time_s[f];
      if (markers.missing(f, gap.marker)) continue;
      if (found > 0 && std::abs(t - last_s) < kApart_s * (1.0 - 1e-6)) continue;
      if (std::abs(t - markers.time_s[from]) > 3.0 * kNeighbors * kApart_s) return;
      frames.push_back(f);
      last_s = t;
      ++found;
    }
  };
  walk(gap.begin - 1, -1);
  std::reverse(frames.begin(), frames.end());
  walk(gap.end, 1);
  return frames;
}

bool fill_by_spline(const MarkerSeries& seen, const MarkerGap& gap, MarkerSeries& filled) {
  const std::vector<Eigen::Index> frames = neighbors(seen, gap);
  if (frames.size() < 4) return false;
  const auto n = static_cast<Eigen::Index>(frames.size());
  Eigen::VectorXd t(n);
  for (Eigen::Index i = 0; i < n; ++i) t[i] = seen.time_s[frames[static_cast<std::size_t>(i)]];
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd x(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      x[i] = seen.positions_m(frames[static_cast<std::size_t>(i)], 3 * gap.marker + axis);
    }
    const math::Spline spline = math::Spline::interpolate(t, x, 3);
    for (Eigen::Index f = gap.begin; f < gap.end; ++f)
      filled.positions_m(f, 3 * gap.marker + axis) = spline.at(seen.time_s[f]).value;
  }
  return true;
}

/// A segment, the places of its markers, and the index of the sought marker.
struct Shape {
  const RigidSegment* segment = nullptr;
  Eigen::Matrix3Xd local_m;
};

/// Returns the position of the marker by the segment's other markers; empty if fewer than three are
/// seen or they lie on a line, because the turn about that line is then unknown.
std::optional<Vec3> from_segment(const MarkerSeries& seen,
                                 const Shape& shape,
                                 Eigen::Index marker,
                                 Eigen::Index frame) {
  Eigen::Matrix3Xd local(3, shape.local_m.cols());
  Eigen::Matrix3Xd there(3, shape.local_m.cols());
  Eigen::Index count = 0;
  Vec3 wanted = Vec3::Zero();
  for (Eigen::Index k = 0; k < shape.local_m.cols(); ++k) {
    const Eigen::Index m = shape.segment->markers[static_cast<std::size_t>(k)];
    if (m == marker) {
      wanted = shape.local_m.col(k);
    } else if (!seen.missing(frame, m)) {
      local.col(count) = shape.local_m.col(k);
      there.col(count) = seen.position(frame, m);
      ++count;
    }
  }
  if (count < 3) return std::nullopt;
  local.conservativeResize(3, count);
  there.conservativeResize(3, count);
  const Eigen::Matrix3Xd centered = local.colwise() - Vec3(local.rowwise().mean());
  constexpr double kLeastWidth_m = 0.01;
  const double squared_m2 = math::symmetric_eigenvalues(centered * centered.transpose())[1];
  if (squared_m2 < kLeastWidth_m * kLeastWidth_m) return std::nullopt;
  return fit_rigid(local, there).apply(wanted);
}

bool fill_from_segment(const MarkerSeries& seen,
                       const std::vector<Shape>& shapes,
                       const MarkerGap& gap,
                       MarkerSeries& filled) {
  for (const Shape& shape : shapes) {
    const auto& members = shape.segment->markers;
    if (std::find(members.begin(), members.end(), gap.marker) == members.end()) continue;
    const auto before = from_segment(seen, shape, gap.marker, gap.begin - 1);
    const auto after = from_segment(seen, shape, gap.marker, gap.end);
    if (!before || !after) continue;
    const Vec3 shift_before = seen.position(gap.begin - 1, gap.marker) - *before;
    const Vec3 shift_after = seen.position(gap.end, gap.marker) - *after;
    const double begin_s = seen.time_s[gap.begin - 1];
    const double length_s = seen.time_s[gap.end] - begin_s;
    std::vector<Vec3> positions;
    for (Eigen::Index f = gap.begin; f < gap.end; ++f) {
      const auto p = from_segment(seen, shape, gap.marker, f);
      if (!p) break;
      const double s = (seen.time_s[f] - begin_s) / length_s;
      positions.push_back(*p + (1.0 - s) * shift_before + s * shift_after);
    }
    if (static_cast<Eigen::Index>(positions.size()) != gap.end - gap.begin) continue;
    for (Eigen::Index f = gap.begin; f < gap.end; ++f) {
      filled.positions_m.block<1, 3>(f, 3 * gap.marker) =
          positions[static_cast<std::size_t>(f - gap.begin)].transpose();
    }
    return true;
  }
  return false;
}

}  // namespace

MendedMarkers mend_markers(MarkerSeries markers,
                           const std::vector<RigidSegment>& segments,
                           const MendOptions& options) {
  MendedMarkers result;
  if (options.undo_swaps) {
    const std::vector<MarkerSwap> swaps = find_swaps(markers);
    for (const Remark& fault : swap_faults(markers, swaps))
      result.swaps.push_back(fmt::format("{}: exchanged back", fault.says));
    markers = undo_swaps(std::move(markers), swaps);
  }
  result.markers = markers;
  if (!options.fill_gaps) return result;

  std::vector<Shape> shapes;
  for (const RigidSegment& segment : segments) {
    Shape shape{&segment, mean_shape(markers, segment)};
    if (shape.local_m.cols() >= 4) shapes.push_back(std::move(shape));
  }
  std::map<std::pair<Eigen::Index, bool>, Eigen::Index> filled;  // frames, by marker and whether a spline fills them
  for (const MarkerGap& gap : find_marker_gaps(markers)) {
    if (gap.begin == 0 || gap.end == markers.frame_count()) continue;
    const double length_s = markers.time_s[gap.end] - markers.time_s[gap.begin - 1];
    const double interval_s = length_s / static_cast<double>(gap.end - gap.begin + 1);
    const bool is_short = length_s - interval_s <= kLimits.markers.gap_s * (1.0 + 1e-9);
    const bool done = is_short ? fill_by_spline(markers, gap, result.markers)
                               : fill_from_segment(markers, shapes, gap, result.markers);
    if (done) filled[{gap.marker, is_short}] += gap.end - gap.begin;
  }
  for (const auto& [key, frames] : filled) {
    std::string& words = result.filled[markers.names[static_cast<std::size_t>(key.first)]];
    words +=
        fmt::format("{}{} filled {}", words.empty() ? "" : ", ", counted(static_cast<std::size_t>(frames), "frame"),
                    key.second ? "by a spline" : "from its segment's other markers");
  }
  return result;
}

}  // namespace myoid::recording
