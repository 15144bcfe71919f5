#include "myoid/body/kinematics/inverse_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/pose_fit.h"
#include "myoid/body/kinematics/pose_sequence.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/nearest_word.h"

namespace myoid::body {
namespace {

using Pair = PoseFit::Pair;

constexpr double kManyFrames = 0.25;  // a coordinate that lies longer at an end of its range is told

std::vector<Pair> pair_markers(const body::BodyModel& model,
                               const MarkerSeries& markers,
                               const IkOptions& options,
                               std::vector<Remark>& notes) {
  std::vector<Pair> pairs;
  std::vector<std::string> names, unseen, unknown;
  for (std::size_t i = 0; i < model.markers.size(); ++i) {
    const std::string& name = names.emplace_back(model.markers[i].name);
    const auto it = std::find(markers.names.begin(), markers.names.end(), name);
    if (it == markers.names.end()) {
      unseen.push_back(name);
      continue;
    }
    const auto weight = options.marker_weights.find(name);
    if (weight == options.marker_weights.end() && options.only_named_markers) continue;
    const double w = weight == options.marker_weights.end() ? 1.0 : weight->second;
    if (!(w >= 0.0)) throw InvalidInput(fmt::format("marker '{}': weight {}, expected 0 or more", name, w));
    pairs.push_back({i, it - markers.names.begin(), w});
  }
  for (const auto& [name, weight] : options.marker_weights) {
    if (model.find_marker(name)) continue;
    throw InvalidInput(fmt::format("marker weight: the model has no marker '{}'{}", name, not_among(name, names)));
  }
  for (const std::string& name : markers.names) {
    if (!model.find_marker(name)) unknown.push_back(name);
  }
  if (!unseen.empty())
    notes.push_back(
        {.code = RemarkCode::reading,
         .severity = Severity::note,
         .says = fmt::format("markers of the model that are not in the recording: {}", fmt::join(unseen, ", "))});
  if (!unknown.empty())
    notes.push_back(
        {.code = RemarkCode::reading,
         .severity = Severity::note,
         .says = fmt::format("markers of the recording that are not in the model: {}", fmt::join(unknown, ", "))});
  if (pairs.empty()) {
    const auto some = [](const std::vector<std::string>& all) {
      const std::vector<std::string> head(
          all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(all.size(), 12)));
      return fmt::format("{}{}", fmt::join(head, ", "), all.size() > head.size() ? ", ..." : "");
    };
    throw InvalidInput(
        fmt::format("no marker of the recording ({}) is in the model ({}); rename them ([markers] rename in a study)",
                    some(markers.names), some(names)));
  }
  return pairs;
}

void check_tasks(const body::BodyModel& model, const std::vector<CoordinateTask>& tasks, Eigen::Index frames) {
  for (const CoordinateTask& task : tasks) {
    (void)model.coordinate_index(task.coordinate);
    if (!(task.weight >= 0.0))
      throw InvalidInput(fmt::format("coordinate '{}': weight {}, expected 0 or more", task.coordinate, task.weight));
    if (task.values.size() != 0 && task.values.size() != frames)
      throw InvalidInput(
          fmt::format("coordinate '{}': {} target values for {} frames", task.coordinate, task.values.size(), frames));
  }
}

/// Returns squared error, its root mean square, the largest error, then the error of each pair.
Eigen::RowVectorXd error_row(const PoseFit& fit) {
  const auto pairs = static_cast<Eigen::Index>(fit.pairs().size());
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(3 + pairs);
  double total = 0.0;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < pairs; ++i) {
    const double error = fit.error(at(i));
    row[3 + i] = error;
    if (!std::isfinite(error)) continue;
    total += error * error;
    largest = std::max(largest, error);
  }
  row[0] = total;
  row[1] = std::sqrt(total / fit.seen_count());
  row[2] = largest;
  return row;
}

std::string with_unit(const body::Coordinate& of, double value) {
  switch (of.motion) {
    case body::MotionType::rotational:
      return fmt::format("{:.4g} deg", value * 180.0 / kPi);
    case body::MotionType::translational:
      return fmt::format("{:.4g} m", value);
    case body::MotionType::coupled:
      break;
  }
  return fmt::format("{:.4g}", value);
}

std::vector<Channel> coordinate_channels(const body::BodyModel& model) {
  std::vector<Channel> channels;
  for (const body::Coordinate& coordinate : model.coordinates)
    channels.push_back({coordinate.name, coordinate_unit(coordinate, 0)});
  return channels;
}

std::vector<Channel> error_channels(const body::BodyModel& model, const std::vector<Pair>& pairs) {
  std::vector<Channel> channels{{"total_squared_error", Unit::dimensionless},
                                {"marker_error_RMS", Unit::meter},
                                {"marker_error_max", Unit::meter}};
  for (const Pair& pair : pairs) channels.push_back({model.markers[pair.model].name, Unit::meter});
  return channels;
}

std::vector<Channel> location_channels(const body::BodyModel& model, const std::vector<Pair>& pairs) {
  std::vector<Channel> channels;
  for (const Pair& pair : pairs) {
    for (const char* axis : {"_tx", "_ty", "_tz"})
      channels.push_back({model.markers[pair.model].name + axis, Unit::meter});
  }
  return channels;
}

}  // namespace

std::vector<CoordinateAtEnd> coordinates_at_ends(const body::BodyModel& model, const TimeSeries& q) {
  std::vector<CoordinateAtEnd> list;
  const auto frames = static_cast<double>(q.sample_count());
  for (std::size_t c = 0; c < model.coordinates.size() && q.sample_count() > 1; ++c) {
    const body::Coordinate& of = model.coordinates[c];
    const auto column = q.find(of.name);
    if (!column || model.is_constrained(static_cast<int>(c))) continue;
    Eigen::Index lower = 0, upper = 0;
    for (const double value : q.values().col(*column))
      if (lies_at_end(of, value)) ++(value - of.lower < of.upper - value ? lower : upper);
    const double share = static_cast<double>(std::max(lower, upper)) / frames;
    // A person may turn as far as they like: a range of the whole body's turn tells after two frames.
    const bool turns_body =
        model.joints[at(of.joint)].parent == 0 && of.motion == body::MotionType::rotational && lower + upper > 1;
    if (share >= kManyFrames || turns_body) list.push_back({of.name, lower > upper ? of.lower : of.upper, share});
  }
  return list;
}

std::vector<Remark> remarks_on_ends(const body::BodyModel& model, const TimeSeries& q) {
  const std::vector<CoordinateAtEnd> list = coordinates_at_ends(model, q);
  if (list.empty()) return {};
  std::vector<std::string> names, places;
  for (const CoordinateAtEnd& of : list) {
    const body::Coordinate& coordinate = model.coordinates[at(model.coordinate_index(of.coordinate))];
    names.push_back(of.coordinate);
    places.push_back(
        fmt::format("{} at {} in {:.0f} %", of.coordinate, with_unit(coordinate, of.end), 100.0 * of.share));
  }
  return {{.about = fmt::format("{}", fmt::join(names, ", ")),
           .says = fmt::format("coordinates at the end of their range: {} of the frames", fmt::join(places, ", ")),
           .remedy = "see whether their markers, or the ranges of the model, are right"}};
}

IkResult inverse_kinematics(const body::BodyModel& model, const MarkerSeries& markers, const IkOptions& options) {
  IkResult result;
  const Eigen::Index frames = markers.frame_count();
  check_tasks(model, options.tasks, frames);
  PoseFit fit(model, options, pair_markers(model, markers, options, result.notes));
  if (fit.free().empty()) throw ModelError("inverse kinematics: every coordinate of the model is locked");
  const auto pairs = static_cast<Eigen::Index>(fit.pairs().size());
  Eigen::MatrixXd q(frames, static_cast<Eigen::Index>(model.coordinates.size()));
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(frames, 3 + pairs);
  Eigen::MatrixXd locations(frames, 3 * pairs);
  std::vector<bool> undetermined(fit.free().size(), false);
  PoseSequence sequence(model, markers, options, fit);
  sequence.solve();
  for (Eigen::Index frame = 0; frame < frames; ++frame) {
    const PoseFit::Pose& pose = sequence.pose(frame);
    q.row(frame) = pose.q;
    fit.set_targets(markers, frame);
    const double cost = fit.place(pose.q);
    fit.locate(locations, frame);
    if (!sequence.seen(frame)) {
      result.status.push_back(FrameStatus::no_markers);
      result.objective.push_back(0.0);
      ++result.frames_without_markers;
      errors.row(frame).setConstant(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    if (frame % 16 == 0 || frame + 1 == frames) fit.collect_undetermined(undetermined);
    result.status.push_back(pose.converged ? FrameStatus::converged : FrameStatus::not_converged);
    if (!pose.converged) ++result.frames_not_converged;
    result.objective.push_back(0.5 * cost);
    errors.row(frame) = error_row(fit);
  }
  result.q = TimeSeries(markers.time_s, coordinate_channels(model), std::move(q));
  result.errors = TimeSeries(markers.time_s, error_channels(model, fit.pairs()), std::move(errors));
  result.marker_locations = TimeSeries(markers.time_s, location_channels(model, fit.pairs()), std::move(locations));
  for (std::size_t k = 0; k < undetermined.size(); ++k) {
    if (undetermined[k]) result.open_coordinates.push_back(model.coordinates[at(fit.free()[k])].name);
  }
  return result;
}

}  // namespace myoid::body
