#include "myoid/body/kinematics/marker_misfit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace myoid::body {
namespace {

constexpr double kFar_m = 0.04;

struct Shift {
  Vec3 mean_m = Vec3::Zero();
  double left_m = 0.0;  ///< RMS of the distances after the shift.
};

/// Returns the mean of all distances as vectors if it makes more than 90 % of their mean square:
/// angles cannot explain a displacement that all markers share.
std::optional<Shift> common_shift(const MarkerSeries& markers, const TimeSeries& model_places) {
  Vec3 sum = Vec3::Zero();
  double squares = 0.0;
  int count = 0;
  for (std::size_t m = 0; m < markers.names.size(); ++m) {
    const auto column = model_places.find(markers.names[m] + "_tx");
    if (!column) continue;
    for (Eigen::Index i = 0; i < model_places.sample_count(); ++i) {
      if (markers.missing(i, static_cast<Eigen::Index>(m))) continue;
      const Vec3 place = model_places.values().block<1, 3>(i, *column).transpose();
      const Vec3 off = markers.position(i, static_cast<Eigen::Index>(m)) - place;
      sum += off;
      squares += off.squaredNorm();
      ++count;
    }
  }
  if (count < 2) return std::nullopt;
  const Vec3 mean = sum / count;
  const double left = std::sqrt(std::max(0.0, squares / count - mean.squaredNorm()));
  if (mean.squaredNorm() < 0.9 * squares / count) return std::nullopt;
  return Shift{mean, left};
}

}  // namespace

std::vector<recording::ExpectedSegment> segments_of(const body::BodyModel& model, const MarkerSeries& markers) {
  std::map<int, recording::ExpectedSegment> by_body;
  for (const body::Marker& marker : model.markers) {
    const auto it = std::find(markers.names.begin(), markers.names.end(), marker.name);
    if (it == markers.names.end()) continue;
    recording::ExpectedSegment& e = by_body[marker.body];
    e.segment.name =
        marker.body >= 0 ? model.bodies[static_cast<std::size_t>(marker.body)].name : std::string("ground");
    e.segment.markers.push_back(it - markers.names.begin());
    e.local_m.conservativeResize(3, e.local_m.cols() + 1);
    e.local_m.col(e.local_m.cols() - 1) = marker.p_BM;
  }
  std::vector<recording::ExpectedSegment> segments;
  for (auto& [body, e] : by_body) {
    if (e.segment.markers.size() >= 2) segments.push_back(std::move(e));
  }
  return segments;
}

MarkerSeries spread_frames(const MarkerSeries& markers) {
  constexpr Eigen::Index kMost = 6;
  const Eigen::Index count = std::min(kMost, markers.frame_count());
  MarkerSeries some{Eigen::VectorXd(count), markers.names, Eigen::MatrixXd(count, markers.positions_m.cols())};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index frame = count == 1 ? 0 : i * (markers.frame_count() - 1) / (count - 1);
    some.time_s[i] = markers.time_s[frame];
    some.positions_m.row(i) = markers.positions_m.row(frame);
  }
  return some;
}

MarkerMisfit marker_misfit(const body::BodyModel& model, const MarkerSeries& markers, const IkResult& solved) {
  MarkerMisfit misfit;
  double sum = 0.0;
  int seen = 0;
  for (const double value : solved.errors.column("marker_error_RMS")) {
    if (std::isnan(value)) continue;
    sum += value * value;
    ++seen;
  }
  misfit.rms_m = std::sqrt(sum / std::max(1, seen));
  if (misfit.rms_m <= kFar_m) return misfit;
  if (const auto fault = recording::check_marker_unit(markers, segments_of(model, markers))) {
    misfit.wrong_unit = true;
    misfit.warning = fmt::format("{}: {}", fault->says, fault->remedy);
  } else if (const auto shift = common_shift(markers, solved.marker_locations)) {
    misfit.warning = fmt::format(
        "all markers lie about ({:.3f}, {:.3f}, {:.3f}) m from the model's: the laboratory's origin is not the "
        "model's, and no coordinate moves the model there; {:.1f} mm rms are left without that shift",
        shift->mean_m[0], shift->mean_m[1], shift->mean_m[2], 1000.0 * shift->left_m);
  } else {
    misfit.warning =
        "the markers lie far from the model's: another model, other units or swapped labels? The angles may still fit, "
        "the marker errors do not";
  }
  return misfit;
}

}  // namespace myoid::body
