#include "myoid/study/checks/marker_sides.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/ground/core/error.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kSides{{{"Right", "Left"},
                                                                               {"right", "left"},
                                                                               {"RIGHT", "LEFT"},
                                                                               {"Left", "Right"},
                                                                               {"left", "right"},
                                                                               {"LEFT", "RIGHT"},
                                                                               {"R", "L"},
                                                                               {"L", "R"}}};

/// Returns true if an initial letter for the side stands apart: before a sign or another capital.
bool stands_apart(const std::string& label, std::size_t length) {
  if (label.size() <= length) return false;
  const auto next = static_cast<unsigned char>(label[length]);
  return length > 1 || std::isupper(next) != 0 || (std::isalnum(next) == 0);
}

MarkerSeries one_frame(const MarkerSeries& markers) {
  Eigen::Index best = 0;
  Eigen::Index most = -1;
  for (Eigen::Index f = 0; f < markers.frame_count(); ++f) {
    Eigen::Index seen = 0;
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) seen += markers.missing(f, m) ? 0 : 1;
    if (seen <= most) continue;
    most = seen;
    best = f;
  }
  return {markers.time_s.segment(best, 1), markers.names, markers.positions_m.middleRows(best, 1)};
}

double rms_m(const body::BodyModel& model, const MarkerSeries& frame, const std::map<std::string, double>& weights) {
  return body::inverse_kinematics(model, frame, {.marker_weights = weights}).errors.column("marker_error_RMS")[0];
}

std::string file_of(const TrialSpec& trial) {
  return trial.markers ? trial.markers->filename().string() : "the markers";
}

/// Returns true for a distance from the model that is good, and far better than as read.
bool much_better(double then_m, double now_m) {
  return then_m < kLimits.markers.sides_better * now_m && then_m <= kLimits.markers.sides_m;
}

/// Returns true if two segments of the model have three markers or more: fewer fit a turned or mirrored model as well.
bool tell_the_way(const body::BodyModel& model, const MarkerSeries& frame) {
  const auto segments = body::segments_of(model, frame);
  return std::count_if(segments.begin(), segments.end(),
                       [](const recording::ExpectedSegment& s) { return s.segment.markers.size() >= 3; }) >= 2;
}

/// Markers in another place, and how the file is read so.
struct Reading {
  RemarkCode code = RemarkCode::vertical_across_trunk;
  MarkerSeries frame;
  std::string by, remedy;
};

/// Returns a frame with each other axis up, and its mirror images by the planes of the model's ground.
std::vector<Reading> other_readings(const body::BodyModel& model, const MarkerSeries& frame, const Vec3& up_L) {
  std::vector<Reading> others;
  const MarkerSeries laboratory = rotated(frame, rotation_onto(model, up_L).transpose());
  for (const char* up : {"x", "y", "z"}) {
    if (up == recording::axis_name(up_L)) continue;
    const Mat3 turn = rotation_onto(model, *recording::axis_vector(up));
    others.push_back({RemarkCode::vertical_across_trunk, rotated(laboratory, turn), fmt::format("with {} up", up),
                      fmt::format("[markers] up = \"{}\"", up)});
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Reading mirrored{RemarkCode::sides_exchanged, frame, "as their mirror image",
                     "if they are of the other side of the body, use that side's model; else one axis of the file is "
                     "reversed: export it from a right-handed laboratory"};
    for (Eigen::Index c = axis; c < mirrored.frame.positions_m.cols(); c += 3)
      mirrored.frame.positions_m.col(c) *= -1.0;
    others.push_back(std::move(mirrored));
  }
  return others;
}

}  // namespace

std::optional<std::string> other_side(const std::string& label) {
  for (const auto& [side, other] : kSides) {
    if (label.starts_with(side) && stands_apart(label, side.size()))
      return std::string(other) + label.substr(side.size());
  }
  for (const auto& [side, other] :
       {std::pair{"_r", "_l"}, {"_l", "_r"}, {"_R", "_L"}, {"_L", "_R"}, {".R", ".L"}, {".L", ".R"}}) {
    if (label.ends_with(side)) return label.substr(0, label.size() - 2) + other;
  }
  for (const auto& [side, other] : {std::pair{"r_", "l_"}, {"l_", "r_"}}) {
    if (label.starts_with(side)) return other + label.substr(2);
  }
  return std::nullopt;
}

std::optional<Remark> exchanged_sides(const body::BodyModel& model,
                                      const TrialSpec& trial,
                                      const MarkerSeries& markers,
                                      const std::map<std::string, double>& weights) {
  MarkerSeries exchanged = markers;
  int renamed = 0;
  for (std::string& name : exchanged.names) {
    const auto other = other_side(name);
    if (!other || !model.find_marker(name) || !model.find_marker(*other) ||
        std::ranges::find(markers.names, *other) == markers.names.end())
      continue;
    name = *other;
    ++renamed;
  }
  if (renamed < 2 * kLimits.markers.sides_pairs) return std::nullopt;
  try {
    const double now = rms_m(model, one_frame(markers), weights);
    if (!(now > kLimits.markers.sides_m)) return std::nullopt;
    const double then = rms_m(model, one_frame(exchanged), weights);
    if (!much_better(then, now)) return std::nullopt;
    return Remark{.code = RemarkCode::sides_exchanged,
                  .severity = Severity::error,
                  .where = trial.name,
                  .about = "left, right",
                  .says = fmt::format("{}: the markers lie {:.0f} mm rms from the model's, and {:.0f} mm "
                                      "with the labels of left and right exchanged: exchange them in the "
                                      "file, or by [markers] rename",
                                      file_of(trial), 1e3 * now, 1e3 * then)};
  } catch (const InvalidInput&) {
    return std::nullopt;  // the comparison of markers with the model reports this
  }
}

std::optional<Remark> turned_markers(const body::BodyModel& model,
                                     const TrialSpec& trial,
                                     const MarkerSeries& markers,
                                     const Vec3& up_L,
                                     const std::map<std::string, double>& weights) {
  try {
    const MarkerSeries frame = one_frame(markers);
    if (!tell_the_way(model, frame)) return std::nullopt;
    const double now = rms_m(model, frame, weights);
    if (!(now > kLimits.markers.sides_m)) return std::nullopt;
    std::optional<Reading> best;
    double least = now;
    for (Reading& reading : other_readings(model, frame, up_L)) {
      const double then = rms_m(model, reading.frame, weights);
      if (!(then < least) || !much_better(then, now)) continue;
      least = then;
      best = std::move(reading);
    }
    if (!best) return std::nullopt;
    return Remark{.code = best->code,
                  .severity = Severity::error,
                  .where = trial.name,
                  .about = best->by,
                  .says = fmt::format("{}: the markers lie {:.0f} mm rms from the model's with {} up, and {:.0f} mm {}",
                                      file_of(trial), 1e3 * now, recording::axis_name(up_L), 1e3 * least, best->by),
                  .remedy = best->remedy};
  } catch (const InvalidInput&) {
    return std::nullopt;  // the comparison of markers with the model reports this
  }
}

}  // namespace myoid::study
