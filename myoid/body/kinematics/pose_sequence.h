#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/kinematics/limb_fit.h"
#include "myoid/body/kinematics/pose_fit.h"

namespace myoid::body {

/// The postures of one recording, found frame after frame, each from the posture before.
///
/// A frame may have several minima, such as those of an arm turned about its length with the elbow bent the other way.
/// The search therefore tries each limb in other postures (limb_fit.h), judged by the limb's own markers: in the first
/// frame, where its markers moved far or fit much worse than before, and last where they fit worse than they usually
/// do. Where the posture lies in a valley, its other minima are tried in every frame (valley_starts.h), for they last
/// for a few frames only. A better minimum is followed backwards and forwards. It replaces the postures at hand as far
/// as that lowers J. A jump between minima must lower the sum of J over the frames by 5 % of a frame's J, so that the
/// posture stays in one minimum where both fit alike, within 1 % of J and 1e-6 m^2.
class PoseSequence {
 public:
  /// Prepares the search. All arguments must outlive the object.
  PoseSequence(const body::BodyModel& model, const MarkerSeries& markers, const IkOptions& options, PoseFit& fit);

  /// Solves all frames. A frame without markers keeps the posture of the frame before.
  void solve();

  [[nodiscard]] bool seen(Eigen::Index frame) const { return seen_[static_cast<std::size_t>(frame)]; }
  /// Returns posture, 2 J and whether the search converged; of a frame without markers only the posture.
  [[nodiscard]] const PoseFit::Pose& pose(Eigen::Index frame) const { return poses_[static_cast<std::size_t>(frame)]; }

 private:
  static constexpr std::size_t kWindow = 8;  ///< Frames between tries of a floating joint's other angles.
  static constexpr int kRounds = 4;          ///< Searches in a frame, each after one that found a better minimum.
  static constexpr double kOwnShare = 30.0;  ///< Another posture's own cost on a fixed base over the limb's own cost.
  static constexpr double kAnyBetter = 1.0 - 1e-6;  ///< Share of the cost at which another minimum is the better one.
  static constexpr double kJumped_m2 = 1e-8;        ///< A smaller difference of costs says nothing.

  /// Frames that another minimum would take over on one side of the frame where it was found.
  struct Stretch {
    std::vector<PoseFit::Pose> poses;  ///< In the order of the walk.
    double gain = 0.0;                 ///< Sum of the frames' relative gains.
    bool clear = false;                ///< A frame fits clearly better.
    bool jumps = false;                ///< The posture jumps behind the last frame.
  };

  void aim_at(std::size_t frame);
  void solve_frame(std::size_t frame);
  [[nodiscard]] PoseFit::Pose first_pose();
  [[nodiscard]] PoseFit::Pose next_pose(const Eigen::VectorXd& before);
  [[nodiscard]] PoseFit::Pose solve_from(const Eigen::VectorXd& start);

  [[nodiscard]] double cost_without_limbs(const Eigen::VectorXd& q);
  void improve_limbs(std::size_t frame, PoseFit::Pose& pose);
  [[nodiscard]] std::vector<bool> surprised_limbs(std::size_t frame, const Eigen::VectorXd& distances) const;
  [[nodiscard]] Eigen::VectorXd limb_distances() const;
  bool search_limb(std::size_t limb, std::size_t frame);
  void search_valley(std::size_t limb, std::size_t frame);
  [[nodiscard]] bool may_search() const;
  void search_suspicious();
  void try_roots(std::size_t frame);

  [[nodiscard]] std::optional<PoseFit::Pose> minimum_near(std::size_t frame, const Eigen::VectorXd& start);
  bool take(std::size_t frame, PoseFit::Pose& pose);

  [[nodiscard]] Stretch follow(std::size_t frame, const PoseFit::Pose& pose, bool forwards);
  bool adopt(std::size_t frame, PoseFit::Pose pose);
  void set_pose(std::size_t frame, PoseFit::Pose pose);

  const body::BodyModel& model_;
  const MarkerSeries& markers_;
  const IkOptions& options_;
  PoseFit& fit_;
  std::vector<std::unique_ptr<LimbFit>> limbs_;
  std::vector<PoseFit::Pose> poses_;
  std::vector<bool> seen_;
  Eigen::MatrixXd parts_;             ///< Per frame and limb: the limb's own part of 2 J.
  Eigen::VectorXd distances_;         ///< Mean square distance of each limb's markers in the latest frame.
  std::size_t solved_ = 0;            ///< Frames.
  std::optional<std::size_t> aimed_;  ///< Frame of the targets of `fit_`.
  double cost_before_;
  double searched_ = 0.0;  ///< Work of searches.
};

}  // namespace myoid::body
