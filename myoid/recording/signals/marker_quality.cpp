#include "myoid/recording/signals/marker_quality.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/marker_swaps.h"

namespace myoid::recording {
namespace {

using ground::MarkerSeries;

/// Returns the step that selects some hundred frames, evenly spread.
Eigen::Index stride_of(const MarkerSeries& markers) { return std::max<Eigen::Index>(1, markers.frame_count() / 100); }

/// Returns the median over pairs of (measured distance) / (distance in the model); empty if no pair is seen.
std::optional<double> size_ratio(const MarkerSeries& markers, const std::vector<ExpectedSegment>& expected) {
  std::vector<double> ratios;
  for (const ExpectedSegment& e : expected) {
    for (std::size_t i = 0; i < e.segment.markers.size(); ++i) {
      for (std::size_t k = i + 1; k < e.segment.markers.size(); ++k) {
        const double model_m =
            (e.local_m.col(static_cast<Eigen::Index>(i)) - e.local_m.col(static_cast<Eigen::Index>(k))).norm();
        std::vector<double> seen;
        for (Eigen::Index f = 0; f < markers.frame_count(); f += stride_of(markers)) {
          const double d =
              (markers.position(f, e.segment.markers[i]) - markers.position(f, e.segment.markers[k])).norm();
          if (std::isfinite(d)) seen.push_back(d);
        }
        if (model_m > 1e-3 && !seen.empty()) ratios.push_back(math::upper_median(seen) / model_m);
      }
    }
  }
  if (ratios.empty()) return std::nullopt;
  return math::upper_median(ratios);
}

/// Returns the median over frames of the largest distance between two markers.
std::optional<double> extent_m(const MarkerSeries& markers) {
  std::vector<double> extents;
  for (Eigen::Index f = 0; f < markers.frame_count(); f += stride_of(markers)) {
    double largest = 0.0;
    for (Eigen::Index a = 0; a < markers.marker_count(); ++a) {
      for (Eigen::Index b = a + 1; b < markers.marker_count(); ++b) {
        const double d = (markers.position(f, a) - markers.position(f, b)).norm();
        if (std::isfinite(d)) largest = std::max(largest, d);
      }
    }
    if (largest > 0.0) extents.push_back(largest);
  }
  if (extents.empty()) return std::nullopt;
  return math::upper_median(extents);
}

std::string probable_unit(double too_large) {
  const double power = std::log10(too_large);
  const double nearest = std::round(power);
  if (std::abs(power - nearest) > 0.4) return "";
  if (nearest == 3.0) return "the numbers look like millimeters that are declared as meters";
  if (nearest == 2.0) return "the numbers look like centimeters that are declared as meters";
  if (nearest == 1.0) return "the numbers look like millimeters that are declared as centimeters";
  if (nearest == -3.0) return "the numbers look like meters that are declared as millimeters";
  if (nearest == -2.0) return "the numbers look like meters that are declared as centimeters";
  if (nearest == -1.0) return "the numbers look like centimeters that are declared as millimeters";
  return "";
}

}  // namespace

std::vector<MarkerGap> find_marker_gaps(const MarkerSeries& markers) {
  std::vector<MarkerGap> gaps;
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    for (Eigen::Index f = 0; f < markers.frame_count(); ++f) {
      if (!markers.missing(f, m)) continue;
      const Eigen::Index begin = f;
      while (f < markers.frame_count() && markers.missing(f, m)) ++f;
      gaps.push_back({m, begin, f});
    }
  }
  return gaps;
}

std::vector<Remark> check_marker_gaps(const MarkerSeries& markers) {
  std::vector<Remark> faults;
  const std::vector<MarkerGap> gaps = find_marker_gaps(markers);
  const double interval_s = markers.frame_count() > 1
                                ? (markers.time_s[markers.frame_count() - 1] - markers.time_s[0]) /
                                      static_cast<double>(markers.frame_count() - 1)
                                : 0.0;
  for (auto it = gaps.begin(); it != gaps.end();) {
    const auto next = std::find_if(it, gaps.end(), [&](const MarkerGap& g) { return g.marker != it->marker; });
    const auto longest = std::max_element(
        it, next, [](const MarkerGap& a, const MarkerGap& b) { return a.end - a.begin < b.end - b.begin; });
    Eigen::Index missing = 0;
    for (auto g = it; g != next; ++g) missing += g->end - g->begin;
    const double share = static_cast<double>(missing) / static_cast<double>(markers.frame_count());
    const double longest_s = static_cast<double>(longest->end - longest->begin) * interval_s;
    const std::string& marker = markers.names[static_cast<std::size_t>(it->marker)];
    const double begin_s = markers.time_s[longest->begin];
    const double end_s = markers.time_s[longest->end - 1];
    const auto count = std::distance(it, next);
    const bool never = missing == markers.frame_count();
    faults.push_back(
        {.code = RemarkCode::marker_gap,
         .severity = (longest_s > kLimits.markers.gap_s || share > kLimits.markers.missing_share) ? Severity::warning
                                                                                                  : Severity::note,
         .about = marker,
         .when = Stretch{begin_s, end_s},
         .value = longest_s,
         .says =
             never ? fmt::format("marker '{}' is in no frame", marker)
                   : fmt::format("marker '{}' is missing in {:.1f} % of the frames, {} gap{}{} from {:.6g} to {:.6g} s",
                                 marker, 100.0 * share, count, count == 1 ? "" : "s", count == 1 ? "" : ", the longest",
                                 begin_s, end_s),
         .remedy =
             longest_s > kLimits.markers.gap_s
                 ? "where its segment's other markers do not show it either, that segment's pose rests on fewer markers"
                 : ""});
    it = next;
  }
  return faults;
}

std::vector<Remark> check_marker_jumps(const MarkerSeries& markers) {
  std::vector<Remark> faults;
  const Eigen::Index frames = markers.frame_count();
  if (frames < 6) return faults;
  const double h = (markers.time_s[frames - 1] - markers.time_s[0]) / static_cast<double>(frames - 1);
  // Fourth difference of 0.2 m at 4 Hz, divided by 6.
  const double fast_m = 0.2 * std::pow(2.0 * kPi * 4.0 * h, 4) / 6.0;
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    std::vector<double> away;
    std::vector<Eigen::Index> at;
    for (Eigen::Index f = 2; f + 2 < frames; ++f) {
      const Vec3 path = (-markers.position(f - 2, m) + 4.0 * markers.position(f - 1, m) +
                         4.0 * markers.position(f + 1, m) - markers.position(f + 2, m)) /
                        6.0;
      const double d = (markers.position(f, m) - path).norm();
      if (!std::isfinite(d)) continue;
      away.push_back(d);
      at.push_back(f);
    }
    if (away.empty()) continue;
    const double limit = std::max({kLimits.markers.jump_m, fast_m, 10.0 * math::upper_median(away)});
    const auto worst = std::max_element(away.begin(), away.end());
    if (*worst <= limit) continue;
    // The neighbors of a jump depart from their path too: separate jumps are at least five frames apart.
    int count = 0;
    Eigen::Index last = -10;
    Eigen::Index begin = -1;
    for (std::size_t i = 0; i < away.size(); ++i) {
      if (away[i] <= limit) continue;
      if (begin < 0) begin = at[i];
      if (at[i] - last > 5) ++count;
      last = at[i];
    }
    const std::string& marker = markers.names[static_cast<std::size_t>(m)];
    const double worst_s = markers.time_s[at[static_cast<std::size_t>(worst - away.begin())]];
    faults.push_back(
        {.code = RemarkCode::marker_jump,
         .severity = Severity::warning,
         .about = marker,
         .when = Stretch{markers.time_s[begin], markers.time_s[last]},
         .value = *worst,
         .says =
             fmt::format("marker '{}' jumps {}, by {:.0f} mm at {:.6g} s", marker,
                         count == 1 ? std::string("once") : fmt::format("{} times", count), 1000.0 * *worst, worst_s),
         .remedy = "a ghost or a wrong label? Remove it there from the file, or give it a small [markers] weight"});
  }
  return faults;
}

std::optional<Remark> check_marker_unit(const MarkerSeries& markers, const std::vector<ExpectedSegment>& expected) {
  constexpr double kFactor = 5.0;
  double ratio = 1.0;
  std::string text;
  const auto ratio_found = size_ratio(markers, expected);
  if (ratio_found) {
    ratio = *ratio_found;
    text = fmt::format("the markers lie {:.3g} times as far apart as the model's", ratio);
  } else if (const auto extent = extent_m(markers)) {
    constexpr double kLeast_m = 0.03;
    constexpr double kMost_m = 5.0;
    constexpr double kUsual_m = 1.0;
    if (*extent > kMost_m || *extent < kLeast_m) ratio = *extent / kUsual_m;
    text = fmt::format("the outermost markers are {:.3g} m apart", *extent);
  }
  if (ratio < kFactor && ratio > 1.0 / kFactor) return std::nullopt;
  const std::string unit = probable_unit(ratio);
  return Remark{.code = RemarkCode::marker_unit,
                .severity = ratio_found && !unit.empty() ? Severity::error : Severity::warning,
                .about = "markers",
                .when = Stretch{markers.time_s[0], markers.time_s[markers.frame_count() - 1]},
                .value = ratio,
                .says = std::move(text),
                .remedy = unit.empty() ? "correct the unit in the file, or choose another model"
                                       : fmt::format("{}: correct the unit in the file", unit)};
}

std::vector<Remark> check_markers(const MarkerSeries& markers, const std::vector<ExpectedSegment>& expected) {
  std::vector<Remark> faults;
  if (markers.frame_count() < 2) return faults;
  const auto append = [&](std::vector<Remark> more) {
    std::move(more.begin(), more.end(), std::back_inserter(faults));
  };
  if (auto unit = check_marker_unit(markers, expected)) {
    // In a wrong unit no other check of lengths is meaningful.
    faults.push_back(std::move(*unit));
    append(check_marker_gaps(markers));
    return faults;
  }
  const std::vector<MarkerSwap> swaps = find_swaps(markers);
  append(swap_faults(markers, swaps));
  const MarkerSeries right = undo_swaps(markers, swaps);
  append(check_marker_jumps(right));
  std::vector<RigidSegment> segments;
  for (const ExpectedSegment& e : expected) segments.push_back(e.segment);
  append(check_rigid_segments(right, segments));
  append(check_marker_gaps(markers));
  return faults;
}

}  // namespace myoid::recording
