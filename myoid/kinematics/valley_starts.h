#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/model/body_model.h"

namespace myoid::kinematics {

/// A limb at a minimum of J.
struct LimbMinimum {
  const std::vector<Eigen::Index>& coordinates;  ///< Of the model: rotations of the limb.
  Eigen::MatrixXd curvature;                     ///< First-order second derivatives of J by them.
  double part_m2 = 0.0;                          ///< The limb's own part of 2 J.
};

/// Returns postures from which a search may find the other minima of a valley of J.
///
/// Where two axes are nearly parallel, as the first and the last of a shoulder abducted by 90 degrees, a limb turns far
/// against itself at little cost: J has a valley, and so it has on the other side of the lock, where the same rotation
/// has other angles. The ends of the ranges cut both into minima that last for a few frames only. The starts lie at
/// both ends of the valley, and at the joint's other angles, brought into their ranges: each if the way along the
/// valley costs, by the curvature, no more than some times the limb's own part.
[[nodiscard]] std::vector<Eigen::VectorXd> valley_starts(const model::BodyModel& model,
                                                         const Eigen::VectorXd& q,
                                                         const LimbMinimum& limb);

}  // namespace myoid::kinematics
