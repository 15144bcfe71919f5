#include "myoid/kinematics/inverse_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/core/index.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/kinematics/pose_fit.h"

namespace myoid::kinematics {
namespace {

using Pair = PoseFit::Pair;

constexpr double kAtEnd = 1e-6;             // of the range: nearer to an end lies at it
constexpr int kFramesBetweenSearches = 50;  // for other limbs, while coordinates lie at ends
constexpr double kFarBetter = 0.5;          // share of the cost at which another minimum replaces the nearest
constexpr double kBetterThanAtEnds = 0.8;   // the same where coordinates lie at ends
constexpr double kMostFramesAtEnd = 0.9;    // a coordinate that lies at an end longer is told

std::vector<Pair> pair_markers(const model::BodyModel& model,
                               const recording::MarkerSeries& markers,
                               const IkOptions& options,
                               std::vector<std::string>& notes) {
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
    throw InvalidInput(
        fmt::format("marker weight: the model has no marker '{}'; there are {}", name, fmt::join(names, ", ")));
  }
  for (const std::string& name : markers.names) {
    if (!model.find_marker(name)) unknown.push_back(name);
  }
  if (!unseen.empty())
    notes.push_back(fmt::format("markers of the model that are not in the recording: {}", fmt::join(unseen, ", ")));
  if (!unknown.empty())
    notes.push_back(fmt::format("markers of the recording that are not in the model: {}", fmt::join(unknown, ", ")));
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

/// Returns postures to start from without a previous frame: the default posture, a posture near it,
/// and the default posture turned about the vertical by the root joint.
std::vector<Eigen::VectorXd> fresh_starts(const model::BodyModel& model) {
  const Eigen::VectorXd rest = model.default_q();
  std::vector<Eigen::VectorXd> starts{rest, Eigen::VectorXd(rest.array() + 0.3)};
  const Vec3 up = model.gravity_G.norm() > 0.0 ? Vec3(-model.gravity_G.normalized()) : Vec3(Vec3::UnitY());
  model::BodyState state = model::make_state(model);
  model::compute_poses(model, rest, state);
  for (const model::Joint& joint : model.joints) {
    if (joint.parent != 0 || joint.coordinates.size() < 6) continue;
    int best = -1;
    double most = 0.8;  // cosine of the axis with the vertical
    for (const int c : joint.coordinates) {
      const double share = std::abs(state.H_w_G[at(c)].dot(up));
      if (share > most) {
        most = share;
        best = c;
      }
    }
    if (best < 0) continue;
    for (const double turn : {0.5 * kPi, kPi, -0.5 * kPi}) {
      starts.push_back(rest);
      starts.back()[best] += turn;
    }
  }
  return starts;
}

bool lies_at_end(const model::Coordinate& of, double value) {
  return of.clamped && std::min(value - of.lower, of.upper - value) < kAtEnd * (of.upper - of.lower);
}

/// Tells of coordinates that lie at an end of their range in nearly every frame.
void note_ends(const model::BodyModel& model, const PoseFit& fit, const Eigen::MatrixXd& q, IkResult& result) {
  for (const Eigen::Index c : fit.free()) {
    const model::Coordinate& of = model.coordinates[at(c)];
    Eigen::Index lower = 0, upper = 0;
    for (const double value : q.col(c)) {
      if (lies_at_end(of, value)) ++(value - of.lower < of.upper - value ? lower : upper);
    }
    const Eigen::Index most = std::max(lower, upper);
    const double end = lower > upper ? of.lower : of.upper;
    // A person may turn as far as they like: a range of the whole body is the model's habit.
    const bool turns_body =
        model.joints[at(of.joint)].parent == 0 && of.motion == model::MotionType::rotational && lower + upper > 1;
    if (q.rows() < 2) continue;
    if (static_cast<double>(most) < kMostFramesAtEnd * static_cast<double>(q.rows())) {
      if (turns_body) {
        result.notes.push_back(fmt::format(
            "coordinate '{}' turns the whole body and lies at an end of its range, {:.4g} to {:.4g} deg, in {} of {} "
            "frames: does the person turn farther? <clamped> false, or a wider range, lets the model follow",
            of.name, of.lower * 180.0 / kPi, of.upper * 180.0 / kPi, lower + upper, q.rows()));
      }
      continue;
    }
    result.notes.push_back(fmt::format(
        "coordinate '{}' lies at the end of its range, {}, in {} of {} frames: its markers, or the range", of.name,
        of.motion == model::MotionType::rotational ? fmt::format("{:.4g} deg", end * 180.0 / kPi)
                                                   : fmt::format("{:.4g} m", end),
        most, q.rows()));
  }
}

/// Returns postures with the joints to ground as in q, and all others in their default posture or in the middle of
/// their ranges: a limb whose search ended at the ends of ranges may have a far better posture elsewhere.
std::vector<Eigen::VectorXd> other_limbs(const model::BodyModel& model, const Eigen::VectorXd& q) {
  Eigen::VectorXd rest = model.default_q(), middle = rest;
  for (const model::Joint& joint : model.joints) {
    for (const int c : joint.coordinates) {
      const model::Coordinate& of = model.coordinates[at(c)];
      if (joint.parent == 0) rest[c] = middle[c] = q[c];
      if (joint.parent != 0 && of.clamped) middle[c] = 0.5 * (of.lower + of.upper);
    }
  }
  return {std::move(rest), std::move(middle)};
}

bool better(const PoseFit::Pose& a, const PoseFit::Pose& b) {
  return (a.converged && !b.converged && a.cost <= b.cost * (1.0 + 1e-9)) || a.cost < b.cost * (1.0 - 1e-9);
}

/// Returns true if a pose replaces the minimum nearest to the start: at this share of its cost or less.
bool much_better(const PoseFit::Pose& a, const PoseFit::Pose& b, double share) {
  return a.converged && a.cost < share * b.cost;
}

void check_tasks(const model::BodyModel& model, const std::vector<CoordinateTask>& tasks, Eigen::Index frames) {
  for (const CoordinateTask& task : tasks) {
    (void)model.coordinate_index(task.coordinate);
    if (!(task.weight >= 0.0))
      throw InvalidInput(fmt::format("coordinate '{}': weight {}, expected 0 or more", task.coordinate, task.weight));
    if (task.values.size() != 0 && task.values.size() != frames)
      throw InvalidInput(
          fmt::format("coordinate '{}': {} target values for {} frames", task.coordinate, task.values.size(), frames));
  }
}

/// The frames of one recording in their order; each begins at the posture of the one before.
class FrameSequence {
 public:
  FrameSequence(const model::BodyModel& model, const IkOptions& options, PoseFit& fit)
      : model_(model),
        barrier_(options.range_barrier),
        fit_(fit),
        posture_(model.default_q()),
        fresh_(fresh_starts(model)) {}

  /// Returns the posture of the latest frame.
  [[nodiscard]] const Eigen::VectorXd& posture() const { return posture_; }

  /// Returns the pose for the targets of `fit`. Tries other starts in the first frame, after a jump of the cost, and
  /// where the search fails; other limbs also now and then while coordinates lie at ends of their ranges.
  PoseFit::Pose next() {
    PoseFit::Pose pose = solve_from(posture_);
    const bool jumped = pose.cost > 4.0 * cost_before_ + 1e-8;
    if (!std::isfinite(cost_before_) || !pose.converged || jumped) try_from(fresh_, kFarBetter, pose);
    if (solved_++ % kFramesBetweenSearches == 0 && has_ends(pose.q))
      try_from(other_limbs(model_, pose.q), kBetterThanAtEnds, pose);
    pose.cost = fit_.place(pose.q);
    if (!std::isfinite(cost_before_)) fit_.unwind(pose);
    cost_before_ = pose.cost;
    fit_.place(pose.q);
    posture_ = pose.q;
    return pose;
  }

 private:
  PoseFit::Pose solve_from(const Eigen::VectorXd& start) {
    return barrier_ > 0.0 ? fit_.solve_inside(start, barrier_) : fit_.solve(start);
  }

  /// Replaces the pose where a search from one of the starts ends at this share of its cost or less.
  void try_from(const std::vector<Eigen::VectorXd>& starts, double share, PoseFit::Pose& pose) {
    for (const Eigen::VectorXd& start : starts) {
      PoseFit::Pose again = solve_from(start);
      if (pose.converged ? much_better(again, pose, share) : better(again, pose)) pose = std::move(again);
    }
  }

  [[nodiscard]] bool has_ends(const Eigen::VectorXd& q) const {
    return std::any_of(fit_.free().begin(), fit_.free().end(),
                       [&](Eigen::Index c) { return lies_at_end(model_.coordinates[at(c)], q[c]); });
  }

  const model::BodyModel& model_;
  double barrier_;
  PoseFit& fit_;
  int solved_ = 0;  ///< Frames.
  Eigen::VectorXd posture_;
  std::vector<Eigen::VectorXd> fresh_;
  double cost_before_ = std::numeric_limits<double>::infinity();
};

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

std::vector<Channel> coordinate_channels(const model::BodyModel& model) {
  std::vector<Channel> channels;
  for (const model::Coordinate& coordinate : model.coordinates)
    channels.push_back({coordinate.name, coordinate_unit(coordinate, 0)});
  return channels;
}

std::vector<Channel> error_channels(const model::BodyModel& model, const std::vector<Pair>& pairs) {
  std::vector<Channel> channels{{"total_squared_error", Unit::dimensionless},
                                {"marker_error_RMS", Unit::meter},
                                {"marker_error_max", Unit::meter}};
  for (const Pair& pair : pairs) channels.push_back({model.markers[pair.model].name, Unit::meter});
  return channels;
}

std::vector<Channel> location_channels(const model::BodyModel& model, const std::vector<Pair>& pairs) {
  std::vector<Channel> channels;
  for (const Pair& pair : pairs) {
    for (const char* axis : {"_tx", "_ty", "_tz"})
      channels.push_back({model.markers[pair.model].name + axis, Unit::meter});
  }
  return channels;
}

}  // namespace

IkResult inverse_kinematics(const model::BodyModel& model,
                            const recording::MarkerSeries& markers,
                            const IkOptions& options) {
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
  FrameSequence sequence(model, options, fit);
  for (Eigen::Index frame = 0; frame < frames; ++frame) {
    if (frame % 256 == 0) {
      options.progress.check();
      options.progress.tell(static_cast<double>(frame) / static_cast<double>(frames), "inverse kinematics");
    }
    fit.set_targets(markers, frame);
    if (fit.seen_count() == 0) {
      result.status.push_back(FrameStatus::no_markers);
      result.objective.push_back(0.0);
      ++result.frames_without_markers;
      q.row(frame) = sequence.posture();
      errors.row(frame).setConstant(std::numeric_limits<double>::quiet_NaN());
      fit.place(sequence.posture());
      fit.locate(locations, frame);
      continue;
    }
    const PoseFit::Pose pose = sequence.next();
    if (frame % 16 == 0 || frame + 1 == frames) fit.collect_undetermined(undetermined);
    q.row(frame) = pose.q;
    result.status.push_back(pose.converged ? FrameStatus::converged : FrameStatus::not_converged);
    if (!pose.converged) ++result.frames_not_converged;
    result.objective.push_back(0.5 * pose.cost);
    errors.row(frame) = error_row(fit);
    fit.locate(locations, frame);
  }
  note_ends(model, fit, q, result);
  result.q = TimeSeries(markers.time_s, coordinate_channels(model), std::move(q));
  result.errors = TimeSeries(markers.time_s, error_channels(model, fit.pairs()), std::move(errors));
  result.marker_locations = TimeSeries(markers.time_s, location_channels(model, fit.pairs()), std::move(locations));
  for (std::size_t k = 0; k < undetermined.size(); ++k) {
    if (undetermined[k]) result.undetermined.push_back(model.coordinates[at(fit.free()[k])].name);
  }
  return result;
}

}  // namespace myoid::kinematics
