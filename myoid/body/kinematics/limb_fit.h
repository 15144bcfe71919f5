#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/kinematics/pose_fit.h"
#include "myoid/body/kinematics/posture_table.h"
#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// The bodies that one joint carries, as a model of their own on a base that stands still. Its objective is the limb's
/// own part of the objective of the whole model. A limb begins at ground, at the trunk (the body that floats on a free
/// joint) or where the body branches; bodies that carry no marker are left out.
class LimbFit {
 public:
  LimbFit(const body::BodyModel& whole,
          std::size_t first_joint,
          const IkOptions& options,
          const std::vector<PoseFit::Pair>& pairs);
  LimbFit(const LimbFit&) = delete;
  LimbFit& operator=(const LimbFit&) = delete;

  /// Returns true if a rotation may begin elsewhere.
  [[nodiscard]] bool can_move() const { return !varied_.empty(); }
  /// Returns the indices of the limb's markers among the pairs of the whole.
  [[nodiscard]] const std::vector<std::size_t>& pairs() const { return pairs_of_whole_; }
  /// Returns the coordinates of the whole that are the limb's, in the order of the limb.
  [[nodiscard]] const std::vector<Eigen::Index>& coordinates() const { return whole_coordinate_; }
  /// Returns the free rotations of the whole from the base to the next branch.
  [[nodiscard]] std::vector<Eigen::Index> turning() const;

  /// Puts the limb on its base in posture q of the whole, which `whole` has as its posture, against the markers of a
  /// frame.
  void stand(const PoseFit& whole, const Eigen::VectorXd& q, const MarkerSeries& markers, Eigen::Index frame);

  /// Searches the limb for other minima: from the postures of a table (posture_table.h) that fit best among their
  /// neighbors, and from the other angles of joints at an end of a range. Returns q with the limb in each of them, the
  /// best first, if its own cost is less than `share` of the cost at q. stand() must have been called with q.
  [[nodiscard]] std::vector<Eigen::VectorXd> other_postures(const Eigen::VectorXd& q, double share);

  /// Returns the work of all searches so far: evaluations of a posture times bodies and coordinates.
  [[nodiscard]] double work() const { return fit_->work(); }

 private:
  void add_bodies(const body::BodyModel& whole, std::size_t first_joint, const std::vector<bool>& carries);
  void add_coordinates(const body::BodyModel& whole);
  void add_constraints(const body::BodyModel& whole);
  void choose_varied(const body::BodyModel& whole, std::size_t first_joint, const std::vector<bool>& carries);
  void make_table();
  [[nodiscard]] std::vector<PostureTable::Target> targets() const;
  [[nodiscard]] std::vector<PoseFit::Search> set_out(const Eigen::VectorXd& q);
  [[nodiscard]] bool bring_into_ranges(PoseFit::Pose& pose, const Eigen::VectorXd& here);
  static void keep_best(std::vector<PoseFit::Search>& searches, std::size_t count);
  [[nodiscard]] myoid::Pose base() const { return base_ != 0 ? model_.joints[0].X_PF : myoid::Pose{}; }

  body::BodyModel model_;
  IkOptions options_;
  int base_ = 0;                                ///< Body of the whole that carries the limb.
  std::vector<int> limb_body_;                  ///< Per body of the whole: index here, or -1.
  std::vector<int> limb_coordinate_;            ///< Per coordinate of the whole: index here, or -1.
  std::vector<Eigen::Index> whole_coordinate_;  ///< Per coordinate here.
  std::vector<std::size_t> pairs_of_whole_;
  std::vector<std::size_t> varied_;  ///< Free rotations from the base to the next branch.
  std::unique_ptr<PoseFit> fit_;
  std::optional<PostureTable> table_;  ///< Made before the first search.
};

/// Returns the limbs of the model that have markers and can move.
[[nodiscard]] std::vector<std::unique_ptr<LimbFit>> limbs_of(const body::BodyModel& model,
                                                             const IkOptions& options,
                                                             const std::vector<PoseFit::Pair>& pairs);

}  // namespace myoid::body
