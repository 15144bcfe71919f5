#include "myoid/recording/signals/marker_swaps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace myoid::recording {
namespace {

using ground::MarkerSeries;
constexpr std::size_t kFewestFrames = 10;  // that tell a usual distance
constexpr double kTellsApart = 4.0;        // spreads of a distance from that of the pair's other marker

using Labels = std::vector<Eigen::Index>;  ///< The marker that each column shows.

/// The end of a marker's path so far.
struct Path {
  std::optional<Vec3> last, before;
  double last_s = 0.0, before_s = 0.0;

  [[nodiscard]] std::optional<Vec3> expected(double time_s, double longest_s) const {
    if (!last || time_s - last_s > longest_s) return std::nullopt;
    if (!before) return last;
    // Over a long gap the velocity is extrapolated for the first half only.
    const double ahead = std::min(time_s - last_s, std::max(0.5 * longest_s, last_s - before_s));
    return *last + (*last - *before) / (last_s - before_s) * ahead;
  }
  void see(const Vec3& p, double time_s, double longest_s) {
    if (last && time_s - last_s <= longest_s) {
      before = last;
      before_s = last_s;
    } else {
      before.reset();
    }
    last = p;
    last_s = time_s;
  }
};

struct Candidate {
  Eigen::Index marker = 0;
  Vec3 seen, expected;
};

/// Returns the pair of markers whose exchange explains this frame best; empty if none does.
std::optional<std::pair<Eigen::Index, Eigen::Index>> crossing(const std::vector<Candidate>& off, double apart_m) {
  std::optional<std::pair<Eigen::Index, Eigen::Index>> best;
  double best_gain = 0.0;
  for (std::size_t i = 0; i < off.size(); ++i) {
    for (std::size_t k = i + 1; k < off.size(); ++k) {
      const Candidate& a = off[i];
      const Candidate& b = off[k];
      if ((a.expected - b.expected).norm() < apart_m) continue;
      const double straight = (a.seen - a.expected).norm() + (b.seen - b.expected).norm();
      const double crossed = (a.seen - b.expected).norm() + (b.seen - a.expected).norm();
      if (crossed >= 0.25 * straight || straight - crossed <= best_gain) continue;
      best_gain = straight - crossed;
      best = {a.marker, b.marker};
    }
  }
  return best;
}

/// Returns the distances of two markers in the frames that show both: those of the swap, or all others.
std::vector<double> distances(
    const MarkerSeries& markers, Eigen::Index a, Eigen::Index b, const MarkerSwap& swap, bool inside) {
  std::vector<double> found;
  for (Eigen::Index f = 0; f < markers.frame_count(); ++f) {
    if ((f >= swap.begin && f < swap.end) != inside || markers.missing(f, a) || markers.missing(f, b)) continue;
    found.push_back((markers.position(f, a) - markers.position(f, b)).norm());
  }
  return found;
}

/// Mean deviation from a length.
double mean_off(const std::vector<double>& values, double length) {
  double sum = 0.0;
  for (const double v : values) sum += std::abs(v - length);
  return sum / static_cast<double>(values.size());
}

/// Returns by how much an exchange of the pair in the swap's frames brings marker `of` nearer to its usual distance
/// from a marker of the same body [m]. Of the same body is the marker whose distance outside these frames changes
/// least, and is not the distance of the pair's other marker. Returns 0 where there is none.
double gain(const MarkerSeries& markers, const MarkerSwap& swap, Eigen::Index of, Eigen::Index other) {
  double best_spread = 0.0, found = 0.0;
  for (Eigen::Index c = 0; c < markers.marker_count(); ++c) {
    if (c == of || c == other) continue;
    const std::vector<double> own = distances(markers, of, c, swap, false), now = distances(markers, of, c, swap, true),
                              exchanged = distances(markers, other, c, swap, true);
    if (own.size() < kFewestFrames || now.empty() || exchanged.empty()) continue;
    const double usual = math::median(own), spread = mean_off(own, usual);
    const double apart = std::abs(math::median(distances(markers, other, c, swap, false)) - usual);
    if (kTellsApart * spread > apart || (best_spread > 0.0 && spread >= best_spread)) continue;
    best_spread = std::max(spread, 1e-9);
    found = mean_off(now, usual) - mean_off(exchanged, usual);
  }
  return found;
}

}  // namespace

std::vector<MarkerSwap> find_swaps(const MarkerSeries& markers) {
  const Eigen::Index count = markers.marker_count();
  std::vector<Path> paths(static_cast<std::size_t>(count));
  Labels labels(static_cast<std::size_t>(count));
  std::iota(labels.begin(), labels.end(), Eigen::Index{0});
  std::vector<std::pair<Eigen::Index, Labels>> since{{0, labels}};  // from this frame on
  for (Eigen::Index f = 0; f < markers.frame_count(); ++f) {
    const double now_s = markers.time_s[f];
    std::vector<Candidate> off;
    for (Eigen::Index m = 0; m < count; ++m) {
      if (markers.missing(f, m)) continue;
      const auto expected = paths[static_cast<std::size_t>(m)].expected(now_s, kLimits.markers.gap_s);
      const Vec3 p = markers.position(f, m);
      if (expected && (p - *expected).norm() > 0.5 * kLimits.markers.swap_m) off.push_back({m, p, *expected});
    }
    bool changed = false;
    while (const auto pair = crossing(off, kLimits.markers.swap_m)) {
      const auto [a, b] = *pair;
      std::swap(paths[static_cast<std::size_t>(a)], paths[static_cast<std::size_t>(b)]);
      std::swap(labels[static_cast<std::size_t>(a)], labels[static_cast<std::size_t>(b)]);
      std::erase_if(off, [a = a, b = b](const Candidate& c) {
        return c.marker == a || c.marker == b;  // copies: Clang 14 cannot capture bindings
      });
      changed = true;
    }
    if (changed) since.emplace_back(f, labels);
    for (Eigen::Index m = 0; m < count; ++m) {
      if (!markers.missing(f, m))
        paths[static_cast<std::size_t>(m)].see(markers.position(f, m), now_s, kLimits.markers.gap_s);
    }
  }
  if (since.size() == 1) return {};

  // The labels of the longest part are the right ones.
  std::map<Labels, Eigen::Index> held;
  for (std::size_t i = 0; i < since.size(); ++i) {
    const Eigen::Index end = i + 1 < since.size() ? since[i + 1].first : markers.frame_count();
    held[since[i].second] += end - since[i].first;
  }
  const Labels right = std::max_element(held.begin(), held.end(), [](const auto& x, const auto& y) {
                         return x.second < y.second;
                       })->first;
  std::vector<MarkerSwap> swaps;
  for (std::size_t i = 0; i < since.size(); ++i) {
    const Eigen::Index end = i + 1 < since.size() ? since[i + 1].first : markers.frame_count();
    Labels now = since[i].second;
    for (Eigen::Index m = 0; m < count; ++m) {
      const Eigen::Index wanted = right[static_cast<std::size_t>(m)];
      if (now[static_cast<std::size_t>(m)] == wanted) continue;
      const auto at = static_cast<Eigen::Index>(std::find(now.begin(), now.end(), wanted) - now.begin());
      std::swap(now[static_cast<std::size_t>(m)], now[static_cast<std::size_t>(at)]);
      swaps.push_back({m, at, since[i].first, end});
    }
  }
  // A path that is lost in bad frames changes labels that are right: the markers of the same body tell.
  MarkerSeries mended = markers;
  std::erase_if(swaps, [&](const MarkerSwap& swap) {
    const bool wrong = gain(mended, swap, swap.first, swap.second) + gain(mended, swap, swap.second, swap.first) < 0.0;
    if (!wrong) mended = undo_swaps(std::move(mended), {swap});
    return wrong;
  });
  return swaps;
}

MarkerSeries undo_swaps(MarkerSeries markers, const std::vector<MarkerSwap>& swaps) {
  for (const MarkerSwap& s : swaps) {
    auto a = markers.positions_m.block(s.begin, 3 * s.first, s.end - s.begin, 3);
    auto b = markers.positions_m.block(s.begin, 3 * s.second, s.end - s.begin, 3);
    a.swap(b);
  }
  return markers;
}

std::vector<Remark> swap_faults(const MarkerSeries& markers, const std::vector<MarkerSwap>& swaps) {
  std::vector<Remark> faults;
  for (const MarkerSwap& s : swaps) {
    const std::string& a = markers.names[static_cast<std::size_t>(s.first)];
    const std::string& b = markers.names[static_cast<std::size_t>(s.second)];
    const double begin_s = markers.time_s[s.begin];
    const double end_s = markers.time_s[s.end - 1];
    faults.push_back({.code = RemarkCode::marker_swap,
                      .severity = Severity::warning,
                      .about = fmt::format("{}, {}", a, b),
                      .when = Stretch{begin_s, end_s},
                      .value = end_s - begin_s,
                      .says = fmt::format("markers '{}' and '{}' carry each other's label from {:.6g} to {:.6g} s", a,
                                          b, begin_s, end_s),
                      .remedy = "they are exchanged back; correct the file"});
  }
  return faults;
}

}  // namespace myoid::recording
