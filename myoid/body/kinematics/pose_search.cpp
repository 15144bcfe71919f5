// The search of PoseSequence for other minima.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/body/kinematics/pose_comparison.h"
#include "myoid/body/kinematics/pose_sequence.h"
#include "myoid/body/kinematics/valley_starts.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

constexpr double kSearchShare = 0.25;   // of the work, for searches of suspicious places
constexpr double kFilesOfFrame = 10.0;  // postures evaluated in the time in which a frame is read and written
constexpr double kSuspicious = 1.15;    // a limb's cost over its median
constexpr std::size_t kPlace = 8;       // frames of which the worst is searched then
constexpr std::size_t kRoutine = 64;    // frames of which one is searched in any case, and so is one of the last
constexpr int kInVain = 4;              // such searches of a limb in turn that found nothing end them
constexpr int kValleySteps = 4;         // after which a start in a valley must be
constexpr double kHopeless = 1.0;       // no farther above the frame's cost, in units of the limb's own part
constexpr double kJump = 0.05;          // sum of relative gains at which a jump pays

}  // namespace

/// Searches each limb now and then, and where it fits much worse than it usually does, the worst places first.
void PoseSequence::search_suspicious() {
  struct Place {
    double ratio = 0.0;
    std::size_t limb = 0, frame = 0;
  };
  std::vector<Place> places;
  for (std::size_t limb = 0; limb < limbs_.size() && !poses_.empty(); ++limb) {
    const auto column = parts_.col(static_cast<Eigen::Index>(limb));
    std::vector<double> parts(column.begin(), column.end());
    const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
    std::nth_element(parts.begin(), middle, parts.end());
    const double usual = *middle + kJumped_m2;
    for (std::size_t first = 0; first < poses_.size(); first += kPlace) {
      const auto count = static_cast<Eigen::Index>(std::min(poses_.size() - first, kPlace));
      Eigen::Index worst = 0;
      const double ratio = column.segment(static_cast<Eigen::Index>(first), count).maxCoeff(&worst) / usual;
      const bool routine = first + kPlace >= poses_.size() || (first + kPlace) % kRoutine == 0;
      if (routine) places.push_back({std::numeric_limits<double>::infinity(), limb, first + at(worst)});
      if (ratio > kSuspicious && !routine) places.push_back({ratio, limb, first + at(worst)});
    }
  }
  std::ranges::sort(places, std::greater(), &Place::ratio);
  std::vector<int> in_vain(limbs_.size(), 0);
  for (const Place& place : places) {
    if (!may_search()) return;
    if (!seen_[place.frame] || in_vain[place.limb] >= kInVain) continue;
    const bool better = search_limb(place.limb, place.frame);
    if (std::isfinite(place.ratio)) in_vain[place.limb] = better ? 0 : in_vain[place.limb] + 1;
  }
}

/// Returns true while searches have taken no more than their share of the work, to which reading and writing a frame
/// adds.
bool PoseSequence::may_search() const {
  const double files =
      kFilesOfFrame * static_cast<double>(solved_ * (model_.bodies.size() + model_.coordinates.size()));
  return searched_ < kSearchShare * (fit_.work() + files);
}

/// Searches a limb in a frame, again after a better minimum; returns true if one was found.
bool PoseSequence::search_limb(std::size_t limb, std::size_t frame) {
  const double before = fit_.work() + limbs_[limb]->work();
  bool better = false;
  for (int round = 0; round < kRounds; ++round) {
    aim_at(frame);
    const Eigen::VectorXd q = poses_[frame].q;
    (void)fit_.place(q);
    limbs_[limb]->stand(fit_, q, markers_, static_cast<Eigen::Index>(frame));
    bool taken = false;
    for (const Eigen::VectorXd& start : limbs_[limb]->other_postures(q, kOwnShare)) {
      auto pose = minimum_near(frame, start);
      taken = (pose && take(frame, *pose)) || taken;
    }
    if (!taken) break;
    better = true;
  }
  searched_ += fit_.work() + limbs_[limb]->work() - before;
  return better;
}

/// Searches a limb in the valleys of its posture, where it has one (valley_starts.h).
void PoseSequence::search_valley(std::size_t limb, std::size_t frame) {
  const double part = parts_(static_cast<Eigen::Index>(frame), static_cast<Eigen::Index>(limb));
  if (part < kJumped_m2) return;
  aim_at(frame);
  const Eigen::VectorXd q = poses_[frame].q;
  const std::vector<Eigen::Index> coordinates = limbs_[limb]->turning();
  for (const Eigen::VectorXd& start : valley_starts(model_, q, {coordinates, fit_.curvature(q, coordinates), part})) {
    aim_at(frame);
    PoseFit::Search search = fit_.begin(start);
    fit_.advance(search, kValleySteps);
    if (search.pose.cost > poses_[frame].cost + kHopeless * part) continue;
    if (auto pose = minimum_near(frame, search.pose.q)) (void)take(frame, *pose);
  }
}

/// Tries the other angles of a floating joint that lies at an end of a range.
void PoseSequence::try_roots(std::size_t frame) {
  for (const body::Joint& joint : model_.joints) {
    const Eigen::VectorXd q = poses_[frame].q;
    const bool at_end = std::any_of(joint.coordinates.begin(), joint.coordinates.end(), [&](int c) {
      return turns(joint, c) && lies_at_end(model_.coordinates[at(c)], q[c]);
    });
    if (joint.parent != 0 || !at_end) continue;
    for (const Eigen::VectorXd& twin : twin_angles(model_, joint, q))
      if (auto pose = minimum_near(frame, twin)) (void)take(frame, *pose);
  }
}

/// Returns the minimum near a start, with angles near the frame's; nothing if the search fails or an angle strays.
std::optional<PoseFit::Pose> PoseSequence::minimum_near(std::size_t frame, const Eigen::VectorXd& start) {
  aim_at(frame);
  PoseFit::Pose pose = fit_.solve(start);
  if (!pose.converged) return std::nullopt;
  fit_.unwind(pose);
  if (strays(model_, pose.q, poses_[frame].q)) return std::nullopt;
  fit_.unwind_towards(poses_[frame].q, pose);
  return pose;
}

/// Adopts another minimum of a frame if it is the better one.
bool PoseSequence::take(std::size_t frame, PoseFit::Pose& pose) {
  return replaces(pose, poses_[frame], kAnyBetter) && adopt(frame, pose);
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
    aim_at(frame);
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
    aim_at(f);
    set_pose(f, std::move(p));
  };
  for (std::size_t k = 0; k < before.poses.size(); ++k) keep(frame - 1 - k, std::move(before.poses[k]));
  for (std::size_t k = 0; k < after.poses.size(); ++k) keep(frame + 1 + k, std::move(after.poses[k]));
  keep(frame, std::move(pose));
  cost_before_ = poses_[solved_ - 1].cost;
  return true;
}

}  // namespace myoid::body
