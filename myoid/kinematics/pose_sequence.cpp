#include "myoid/kinematics/pose_sequence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "myoid/core/index.h"
#include "myoid/kinematics/joint_angles.h"

namespace myoid::kinematics {
namespace {

constexpr std::size_t kWindow = 32;     // frames
constexpr int kRounds = 4;              // searches of a limb in a window at most
constexpr double kSearchShare = 0.25;   // of the work, for routine searches
constexpr double kLastShare = 0.6;      // the same with the searches behind the last frame
constexpr double kSuspicious = 1.15;    // a limb's cost over its median
constexpr double kFilesOfFrame = 10.0;  // postures evaluated in the time in which a frame is read and written
constexpr double kFarBetter = 0.5;      // share of the cost at which a fresh start replaces a converged posture
constexpr double kAnyBetter = 1.0 - 1e-6;
constexpr double kRoundOff_m2 = 1e-13;  // of 2 J
constexpr double kAlike = 0.01;         // relative difference of the costs of postures that fit alike
constexpr double kAlike_m2 = 2e-6;      // the same of 2 J
constexpr double kJump = 0.05;          // sum of relative gains at which a jump pays
constexpr double kNearlyAsGood = 1.15;  // own cost of a limb on a fixed base that may be the lower one on a free base
constexpr double kJumped = 4.0;         // times the cost of the frame before
constexpr double kJumped_m2 = 1e-8;     // more than that
constexpr double kFarMoved_m = 0.1;     // rms distance of a limb's markers from their places in the frame before
constexpr double kTurned_rad = 0.5;     // from frame to frame
constexpr double kSame_rad = 1e-4;      // postures nearer to each other are one

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

bool replaces(const PoseFit::Pose& a, const PoseFit::Pose& b, double share) {
  if (b.converged) return a.converged && a.cost < share * b.cost - kRoundOff_m2;
  return (a.converged && a.cost <= b.cost * (1.0 + 1e-9)) || a.cost < b.cost * (1.0 - 1e-9);
}

/// Returns the difference of the costs in units of the lower one.
double gain_of(const PoseFit::Pose& then, const PoseFit::Pose& now) {
  const double difference = now.cost - then.cost;
  if (std::abs(difference) <= kRoundOff_m2) return 0.0;
  return difference / (std::min(now.cost, then.cost) + kRoundOff_m2);
}

/// Returns true if the first pose fits better by more than poses that fit alike.
bool clearly_better(const PoseFit::Pose& then, const PoseFit::Pose& now) {
  return gain_of(then, now) > kAlike || now.cost - then.cost > kAlike_m2;
}

bool same_posture(const PoseFit::Pose& a, const PoseFit::Pose& b) {
  return (a.q - b.q).cwiseAbs().maxCoeff() < kSame_rad && std::abs(gain_of(a, b)) < 1e-6;
}

}  // namespace

PoseSequence::PoseSequence(const model::BodyModel& model,
                           const recording::MarkerSeries& markers,
                           const IkOptions& options,
                           PoseFit& fit)
    : model_(model),
      markers_(markers),
      options_(options),
      fit_(fit),
      poses_(at(markers.frame_count())),
      seen_(poses_.size(), false),
      cost_before_(std::numeric_limits<double>::infinity()) {
  if (options.range_barrier == 0.0 && options.max_iterations > 0) limbs_ = limbs_of(model, options, fit.pairs());
  parts_.setZero(markers.frame_count(), static_cast<Eigen::Index>(limbs_.size()));
}

void PoseSequence::solve() {
  for (std::size_t first = 0; first < poses_.size(); first += kWindow) {
    options_.progress.check();
    options_.progress.tell(static_cast<double>(first) / static_cast<double>(poses_.size()), "inverse kinematics");
    const std::size_t last = std::min(poses_.size(), first + kWindow) - 1;
    for (std::size_t frame = first; frame <= last; ++frame) solve_frame(frame);
    search_window(first, last);
  }
  search_suspicious();
}

PoseFit::Pose PoseSequence::solve_from(const Eigen::VectorXd& start) {
  return options_.range_barrier > 0.0 ? fit_.solve_inside(start, options_.range_barrier) : fit_.solve(start);
}

/// Returns true while searches have taken no more than this share of the work, to which reading and writing a frame
/// adds.
bool PoseSequence::may_search(double share) const {
  const double files =
      kFilesOfFrame * static_cast<double>(solved_ * (model_.bodies.size() + model_.coordinates.size()));
  return searched_ < share * (fit_.work() + files);
}

/// Returns the pose of a frame that has none before it: the best from all fresh starts, each with its limbs improved.
PoseFit::Pose PoseSequence::first_pose() {
  const std::size_t frame = solved_ - 1;
  std::vector<PoseFit::Pose> found;
  for (const Eigen::VectorXd& start : fresh_starts(model_)) {
    PoseFit::Pose pose = solve_from(start);
    const bool known =
        std::any_of(found.begin(), found.end(), [&](const auto& other) { return same_posture(pose, other); });
    if (!known) found.push_back(std::move(pose));
  }
  PoseFit::Pose best = found.front();
  for (PoseFit::Pose& pose : found) {
    improve_limbs(frame, pose);
    const bool other_is_better = replaces(pose, best, kAnyBetter) && !strays(model_, pose.q, best.q);
    if (&pose == &found.front() || other_is_better) best = std::move(pose);
  }
  best.cost = fit_.place(best.q);
  fit_.unwind(best);
  return best;
}

/// Improves the pose of the frame whose targets `fit_` has, limb by limb.
void PoseSequence::improve_limbs(std::size_t frame, PoseFit::Pose& pose) {
  for (const auto& limb : limbs_) {
    (void)fit_.place(pose.q);
    limb->stand(fit_, pose.q, markers_, static_cast<Eigen::Index>(frame));
    const auto start = limb->other_posture(pose.q, kNearlyAsGood);
    if (!start) continue;
    PoseFit::Pose other = fit_.solve(*start);
    if (replaces(other, pose, kAnyBetter) && !strays(model_, other.q, pose.q)) pose = std::move(other);
  }
}

/// Returns the mean square distance of each limb's markers from their targets.
Eigen::VectorXd PoseSequence::limb_distances() const {
  Eigen::VectorXd distances(static_cast<Eigen::Index>(limbs_.size()));
  for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
    distances[static_cast<Eigen::Index>(limb)] = fit_.mean_square(limbs_[limb]->pairs());
  return distances;
}

/// Finds the posture of a frame from the one before; in the first frame from other starts.
void PoseSequence::solve_frame(std::size_t frame) {
  solved_ = frame + 1;
  const Eigen::VectorXd before = frame > 0 ? poses_[frame - 1].q : model_.default_q();
  fit_.set_targets(markers_, static_cast<Eigen::Index>(frame));
  if (fit_.seen_count() == 0) {
    poses_[frame] = {before, 0.0, true};
    return;
  }
  seen_[frame] = true;
  const bool first = !std::isfinite(cost_before_);
  (void)fit_.place(before);
  const Eigen::VectorXd distances = limb_distances();
  PoseFit::Pose pose = first ? first_pose() : next_pose(before);
  cost_before_ = pose.cost;
  set_pose(frame, std::move(pose));
  const std::vector<bool> surprised = first ? std::vector<bool>(limbs_.size()) : surprised_limbs(frame, distances);
  distances_ = limb_distances();
  for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
    if (surprised[limb]) (void)try_limb(limb, frame);
}

/// Returns the minimum near the posture before; after a jump of the cost, or where the search fails, a far better one
/// from a fresh start.
PoseFit::Pose PoseSequence::next_pose(const Eigen::VectorXd& before) {
  PoseFit::Pose pose = solve_from(before);
  if (!pose.converged || pose.cost > kJumped * cost_before_ + kJumped_m2) {
    for (const Eigen::VectorXd& start : fresh_starts(model_)) {
      PoseFit::Pose again = solve_from(start);
      if (replaces(again, pose, kFarBetter)) pose = std::move(again);
    }
    fit_.unwind_towards(before, pose);
  }
  pose.cost = fit_.place(pose.q);
  return pose;
}

/// Returns the limbs whose search may have ended in another minimum: their markers moved far or fit much worse than
/// before, their angles jumped or, while routine searches may be made, met the end of a range.
std::vector<bool> PoseSequence::surprised_limbs(std::size_t frame, const Eigen::VectorXd& distances) const {
  std::vector<bool> surprised(limbs_.size(), false);
  if (frame == 0 || !seen_[frame - 1]) {
    surprised.assign(limbs_.size(), true);
    return surprised;
  }
  const Eigen::VectorXd& now = poses_[frame].q;
  const Eigen::VectorXd& then = poses_[frame - 1].q;
  for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
    const auto l = static_cast<Eigen::Index>(limb);
    const auto f = static_cast<Eigen::Index>(frame);
    surprised[limb] = distances[l] > distances_[l] + kFarMoved_m * kFarMoved_m ||
                      parts_(f, l) > kJumped * parts_(f - 1, l) + kJumped_m2;
    for (const Eigen::Index c : limbs_[limb]->coordinates()) {
      const model::Coordinate& coordinate = model_.coordinates[at(c)];
      surprised[limb] =
          surprised[limb] || std::abs(now[c] - then[c]) > kTurned_rad ||
          (may_search(kSearchShare) && lies_at_end(coordinate, now[c]) && !lies_at_end(coordinate, then[c]));
    }
  }
  return surprised;
}

/// Keeps the posture of the frame whose targets `fit_` has.
void PoseSequence::set_pose(std::size_t frame, PoseFit::Pose pose) {
  if (!limbs_.empty()) (void)fit_.place(pose.q);
  for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
    parts_(static_cast<Eigen::Index>(frame), static_cast<Eigen::Index>(limb)) = fit_.part_of(limbs_[limb]->pairs());
  poses_[frame] = std::move(pose);
}

std::size_t PoseSequence::worst_frame(std::size_t limb, std::size_t first, std::size_t last) const {
  Eigen::Index worst = 0;
  parts_.col(static_cast<Eigen::Index>(limb))
      .segment(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(last - first + 1))
      .maxCoeff(&worst);
  return first + at(worst);
}

/// Tries each limb in the frame where its markers lie worst, again while that helps. The limbs take turns to be first.
void PoseSequence::search_window(std::size_t first, std::size_t last) {
  if (limbs_.empty()) return;
  if (seen_[last]) try_roots(last);
  ++window_;
  for (std::size_t k = 0; k < limbs_.size() && may_search(kSearchShare); ++k) {
    const std::size_t limb = (window_ + k) % limbs_.size();
    for (int round = 0; round < kRounds; ++round) {
      const std::size_t frame = worst_frame(limb, first, last);
      if (!seen_[frame] || !try_limb(limb, frame)) break;
    }
  }
}

/// Tries each limb where a window's worst frame fits much worse than the limb usually does, the worst first: routine
/// searches may have had no work left there.
void PoseSequence::search_suspicious() {
  if (poses_.empty()) return;
  struct Place {
    double ratio = 0.0;
    std::size_t limb = 0, first = 0, last = 0;
  };
  std::vector<Place> places;
  for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
    const auto column = parts_.col(static_cast<Eigen::Index>(limb));
    std::vector<double> parts(column.begin(), column.end());
    const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
    std::nth_element(parts.begin(), middle, parts.end());
    const double usual = *middle + kJumped_m2;
    for (std::size_t first = 0; first < poses_.size(); first += kWindow) {
      const std::size_t last = std::min(poses_.size(), first + kWindow) - 1;
      const double ratio = column[static_cast<Eigen::Index>(worst_frame(limb, first, last))] / usual;
      if (ratio > kSuspicious) places.push_back({ratio, limb, first, last});
    }
  }
  std::ranges::sort(places, std::greater(), &Place::ratio);
  for (const Place& place : places) {
    for (int round = 0; round < kRounds && may_search(kLastShare); ++round) {
      const std::size_t frame = worst_frame(place.limb, place.first, place.last);
      if (!seen_[frame] || !try_limb(place.limb, frame)) break;
    }
  }
}

/// Tries another posture of a limb in a frame; returns true if the frame keeps it.
bool PoseSequence::try_limb(std::size_t limb, std::size_t frame) {
  const double before = fit_.work() + limbs_[limb]->work();
  const Eigen::VectorXd& q = poses_[frame].q;
  fit_.set_targets(markers_, static_cast<Eigen::Index>(frame));
  (void)fit_.place(q);
  limbs_[limb]->stand(fit_, q, markers_, static_cast<Eigen::Index>(frame));
  const auto start = limbs_[limb]->other_posture(q, kNearlyAsGood);
  const bool kept = start && try_start(frame, *start);
  searched_ += fit_.work() + limbs_[limb]->work() - before;
  return kept;
}

/// Tries the other angles of a floating joint that lies at an end of a range.
void PoseSequence::try_roots(std::size_t frame) {
  for (const model::Joint& joint : model_.joints) {
    const Eigen::VectorXd q = poses_[frame].q;
    const bool at_end = std::any_of(joint.coordinates.begin(), joint.coordinates.end(), [&](int c) {
      return turns(joint, c) && lies_at_end(model_.coordinates[at(c)], q[c]);
    });
    if (joint.parent != 0 || !at_end) continue;
    for (const Eigen::VectorXd& twin : twin_angles(model_, joint, q)) (void)try_start(frame, twin);
  }
}

/// Adopts the minimum near a start if it is the better one.
bool PoseSequence::try_start(std::size_t frame, const Eigen::VectorXd& start) {
  fit_.set_targets(markers_, static_cast<Eigen::Index>(frame));
  PoseFit::Pose pose = fit_.solve(start);
  if (!replaces(pose, poses_[frame], kAnyBetter)) return false;
  fit_.unwind(pose);
  if (strays(model_, pose.q, poses_[frame].q)) return false;
  fit_.unwind_towards(poses_[frame].q, pose);
  return adopt(frame, std::move(pose));
}

/// Follows another minimum from frame to frame until it meets the postures at hand or is clearly the worse one.
PoseSequence::Stretch PoseSequence::follow(std::size_t frame, const PoseFit::Pose& pose, bool forwards) {
  Stretch all;
  Stretch best;
  std::size_t kept = 0;
  best.jumps = true;
  Eigen::VectorXd start = pose.q;
  const std::size_t end = forwards ? solved_ - 1 : 0;
  while (frame != end) {
    frame = forwards ? frame + 1 : frame - 1;
    if (!seen_[frame]) {
      all.poses.push_back({start, 0.0, true});
      continue;
    }
    fit_.set_targets(markers_, static_cast<Eigen::Index>(frame));
    PoseFit::Pose other = fit_.solve(start);
    const PoseFit::Pose& here = poses_[frame];
    if (same_posture(other, here)) return all;
    all.gain += gain_of(other, here);
    all.clear = all.clear || clearly_better(other, here);
    if (!other.converged || clearly_better(here, other) || all.gain < best.gain - kJump) {
      all.poses.resize(kept);
      best.poses = std::move(all.poses);
      return best;
    }
    start = other.q;
    all.poses.push_back(std::move(other));
    if (all.gain < best.gain) continue;
    best.gain = all.gain;
    best.clear = all.clear;
    kept = all.poses.size();
  }
  return all;
}

/// Takes a better minimum of a frame, and of the frames around it, if the gain is worth the jumps.
bool PoseSequence::adopt(std::size_t frame, PoseFit::Pose pose) {
  const double gain = gain_of(pose, poses_[frame]);
  Stretch before = follow(frame, pose, false), after = follow(frame, pose, true);
  const double jumps = (before.jumps ? kJump : 0.0) + (after.jumps ? kJump : 0.0);
  const bool clear = clearly_better(pose, poses_[frame]) || before.clear || after.clear;
  if (!clear && gain + before.gain + after.gain <= jumps) return false;
  const auto keep = [&](std::size_t f, PoseFit::Pose p) {
    fit_.set_targets(markers_, static_cast<Eigen::Index>(f));
    set_pose(f, std::move(p));
  };
  for (std::size_t k = 0; k < before.poses.size(); ++k) keep(frame - 1 - k, std::move(before.poses[k]));
  for (std::size_t k = 0; k < after.poses.size(); ++k) keep(frame + 1 + k, std::move(after.poses[k]));
  keep(frame, std::move(pose));
  cost_before_ = poses_[solved_ - 1].cost;
  return true;
}

}  // namespace myoid::kinematics
