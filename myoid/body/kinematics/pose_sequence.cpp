#include "myoid/body/kinematics/pose_sequence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/body/kinematics/pose_comparison.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

constexpr double kFarBetter = 0.5;   // share of the cost at which a fresh start replaces a converged posture
constexpr double kJumped = 4.0;      // times the cost of the frame before
constexpr double kFarMoved_m = 0.1;  // rms distance of a limb's markers from their places in the frame before
constexpr double kTurned_rad = 0.5;  // from frame to frame

/// Returns postures to start from without a previous frame: the default posture, a posture near it,
/// and the default posture turned about the vertical by the root joint.
std::vector<Eigen::VectorXd> fresh_starts(const body::BodyModel& model) {
  const Eigen::VectorXd rest = model.default_q();
  std::vector<Eigen::VectorXd> starts{rest, Eigen::VectorXd(rest.array() + 0.3)};
  const Vec3 up = model.gravity_G.norm() > 0.0 ? Vec3(-model.gravity_G.normalized()) : Vec3(Vec3::UnitY());
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, rest, state);
  for (const body::Joint& joint : model.joints) {
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

}  // namespace

PoseSequence::PoseSequence(const body::BodyModel& model,
                           const MarkerSeries& markers,
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
    if (!limbs_.empty() && seen_[last]) try_roots(last);
  }
  search_suspicious();
}

/// Gives `fit_` the targets of a frame. The slopes of its latest step last while the frame stays.
void PoseSequence::aim_at(std::size_t frame) {
  if (aimed_ == frame) return;
  fit_.set_targets(markers_, static_cast<Eigen::Index>(frame));
  aimed_ = frame;
}

PoseFit::Pose PoseSequence::solve_from(const Eigen::VectorXd& start) {
  return options_.range_barrier > 0.0 ? fit_.solve_inside(start, options_.range_barrier) : fit_.solve(start);
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
  // Limbs in other postures improve a pose by the part of their markers, or by a little more.
  std::ranges::sort(found, {}, &PoseFit::Pose::cost);
  PoseFit::Pose best = found.front();
  for (PoseFit::Pose& pose : found) {
    const bool first = &pose == &found.front();
    if (!first && cost_without_limbs(pose.q) > best.cost) continue;
    improve_limbs(frame, pose);
    if (first || (replaces(pose, best, kAnyBetter) && !strays(model_, pose.q, best.q))) best = std::move(pose);
  }
  best.cost = fit_.place(best.q);
  fit_.unwind(best);
  return best;
}

double PoseSequence::cost_without_limbs(const Eigen::VectorXd& q) {
  double cost = fit_.place(q);
  for (const auto& limb : limbs_) cost -= fit_.part_of(limb->pairs());
  return cost;
}

/// Improves the pose of the frame whose targets `fit_` has, limb by limb.
void PoseSequence::improve_limbs(std::size_t frame, PoseFit::Pose& pose) {
  for (const auto& limb : limbs_) {
    (void)fit_.place(pose.q);
    limb->stand(fit_, pose.q, markers_, static_cast<Eigen::Index>(frame));
    for (const Eigen::VectorXd& start : limb->other_postures(pose.q, kOwnShare)) {
      PoseFit::Pose other = fit_.solve(start);
      if (replaces(other, pose, kAnyBetter) && !strays(model_, other.q, pose.q)) pose = std::move(other);
    }
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
  aim_at(frame);
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
  // A limb in another minimum pulls the body, and so the other limbs.
  double cost = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds && poses_[frame].cost < kAnyBetter * cost - kJumped_m2; ++round) {
    cost = poses_[frame].cost;
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
      if (surprised[limb]) (void)search_limb(limb, frame);
  }
  for (std::size_t limb = 0; limb < limbs_.size(); ++limb) search_valley(limb, frame);
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
/// before, or their angles jumped.
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
    for (const Eigen::Index c : limbs_[limb]->coordinates())
      surprised[limb] = surprised[limb] || std::abs(now[c] - then[c]) > kTurned_rad;
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

}  // namespace myoid::body
