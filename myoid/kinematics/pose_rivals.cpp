// The search of PoseSequence for other minima.
#include <algorithm>
#include <functional>
#include <utility>

#include "myoid/core/index.h"
#include "myoid/kinematics/joint_angles.h"
#include "myoid/kinematics/pose_comparison.h"
#include "myoid/kinematics/pose_sequence.h"

namespace myoid::kinematics {
namespace {

constexpr std::size_t kLongest = 32;  // frames between searches of a limb after searches that found nothing
constexpr double kRivalShare = 0.4;   // of the work, for rivals and routine searches
constexpr double kLastShare = 0.6;    // the same with the searches behind the last frame
constexpr double kSuspicious = 1.15;  // a limb's cost over its median
constexpr std::size_t kPlace = 8;     // frames of which the worst is searched then
constexpr int kAlone = 4;             // such searches of a limb in turn that found nothing end them
constexpr double kNear = 0.5;         // lag of a rival that is found again in the next frame,
constexpr double kMiddle = 1.5;       // in the next but one,
constexpr double kFar = 5.0;          // in the fourth
constexpr double kForgotten = 15.0;   // lag of a rival that is not followed any longer
constexpr double kJump = 0.05;        // sum of relative gains at which a jump pays

}  // namespace

/// Searches each limb thoroughly where it fits much worse than it usually does, the worst places first.
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
      if (ratio > kSuspicious) places.push_back({ratio, limb, first + at(worst)});
    }
  }
  std::ranges::sort(places, std::greater(), &Place::ratio);
  std::vector<int> alone(limbs_.size(), 0);
  for (const Place& place : places) {
    if (!may_search(kLastShare)) return;
    if (!seen_[place.frame] || alone[place.limb] >= kAlone) continue;
    rivals_[place.limb].clear();
    searched_until_[place.limb] = place.frame - std::min(place.frame, kPlace);
    alone[place.limb] = search_limb(place.limb, place.frame, true) ? 0 : alone[place.limb] + 1;
  }
}

/// Returns how much higher a posture's cost is than that of the frame, in units of the limb's own part.
double PoseSequence::lag_of(const PoseFit::Pose& pose, std::size_t limb, std::size_t frame) const {
  return (pose.cost - poses_[frame].cost) /
         (parts_(static_cast<Eigen::Index>(frame), static_cast<Eigen::Index>(limb)) + kJumped_m2);
}

/// Returns a start for a rival in another frame: the limb stays, everything else moves as the postures at hand do.
Eigen::VectorXd PoseSequence::carried(const Rival& rival, std::size_t limb, std::size_t frame) const {
  Eigen::VectorXd start = rival.pose.q + poses_[frame].q - poses_[rival.frame].q;
  for (const Eigen::Index c : limbs_[limb]->coordinates()) start[c] = rival.pose.q[c];
  return start;
}

/// Finds the rivals of a limb again in a frame, those that are due or all; one that is the better minimum is taken.
void PoseSequence::follow_rivals(std::size_t limb, std::size_t frame, bool all) {
  if (!all && !may_search(kRivalShare)) return;
  const double before = fit_.work();
  std::vector<Rival> kept;
  std::vector<Rival> rivals = std::move(rivals_[limb]);
  rivals_[limb].clear();
  for (Rival& rival : rivals) {
    if (rival.frame == frame || !(all || rival.due <= frame)) {
      kept.push_back(std::move(rival));
      continue;
    }
    auto pose = minimum_near(frame, carried(rival, limb, frame));
    if (!pose || same_posture(*pose, poses_[frame])) continue;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Rival& other) {
      return other.frame == frame && same_posture(*pose, other.pose);
    });
    if (known) continue;
    PoseFit::Pose old = poses_[frame];
    if (take(frame, *pose)) pose = std::move(old);
    const double lag = lag_of(*pose, limb, frame);
    if (lag > kForgotten) continue;
    const std::size_t wait = lag < kNear ? 1 : lag < kMiddle ? 2 : lag < kFar ? 4 : kWindow;
    kept.push_back({frame, std::move(*pose), frame + wait});
  }
  rivals_[limb] = std::move(kept);
  searched_ += fit_.work() - before;
}

/// Searches a limb in a frame for rivals that are not known; follows each back to the frame of the search before.
/// Returns true if the limb has other minima on its base.
bool PoseSequence::search_limb(std::size_t limb, std::size_t frame, bool thorough) {
  follow_rivals(limb, frame, true);
  const double before = fit_.work() + limbs_[limb]->work();
  bool alone = true;
  for (int round = 0; round < kRounds; ++round) {
    fit_.set_targets(markers_, static_cast<Eigen::Index>(frame));
    const Eigen::VectorXd q = poses_[frame].q;
    (void)fit_.place(q);
    limbs_[limb]->stand(fit_, q, markers_, static_cast<Eigen::Index>(frame));
    bool taken = false;
    for (const Eigen::VectorXd& start : limbs_[limb]->other_postures(q, kOwnShare, thorough)) {
      alone = false;
      auto& rivals = rivals_[limb];
      auto pose = minimum_near(frame, start);
      if (!pose || same_posture(*pose, poses_[frame])) continue;
      const bool known = std::any_of(rivals.begin(), rivals.end(), [&](const Rival& other) {
        return other.frame == frame && same_posture(*pose, other.pose);
      });
      if (known) continue;
      PoseFit::Pose old = poses_[frame];
      if (take(frame, *pose)) {
        taken = true;
        pose = std::move(old);
      }
      if (lag_of(*pose, limb, frame) > kForgotten) continue;
      rivals.push_back({frame, *pose, frame + 1});
      look_back(rivals.back(), limb, searched_until_[limb]);
    }
    if (!taken) break;
  }
  searched_until_[limb] = frame + 1;
  pause_[limb] = alone ? std::min(2 * pause_[limb], kLongest) : kWindow;
  searched_ += fit_.work() + limbs_[limb]->work() - before;
  return !alone;
}

/// Follows a new rival backwards while it is near, and takes it where it is the better minimum.
void PoseSequence::look_back(Rival rival, std::size_t limb, std::size_t since) {
  while (rival.frame > since && lag_of(rival.pose, limb, rival.frame) < kMiddle) {
    const std::size_t frame = rival.frame - 1;
    if (!seen_[frame]) return;
    auto pose = minimum_near(frame, carried(rival, limb, frame));
    if (!pose || same_posture(*pose, poses_[frame])) return;
    rival = {frame, *pose, frame};
    if (take(frame, *pose)) return;
  }
}

/// Tries the other angles of a floating joint that lies at an end of a range.
void PoseSequence::try_roots(std::size_t frame) {
  for (const model::Joint& joint : model_.joints) {
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
  fit_.set_targets(markers_, static_cast<Eigen::Index>(frame));
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
