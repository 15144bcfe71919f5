#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// A limb at a minimum of J.
struct LimbMinimum {
  const std::vector<Eigen::Index>& coordinates;  ///< Of the model: rotations of the limb.
  Eigen::MatrixXd curvature;                     ///< First-order second derivatives of J by them.
  double part_m2 = 0.0;                          ///< The limb's own part of 2 J.
};

/// Returns postures from which a search may find the other minima of a valley of J.
///
/// The first and the last axis of a shoulder that is abducted by 90 degrees are nearly parallel. Turns about both
/// cancel there, so J has a valley. J has a second valley on the other side of this lock, where other angles make the
/// same rotation. The ends of the ranges cut both into minima that last for a few frames only. The starts lie at both
/// ends of the valley, and at the joint's other angles, brought into their ranges: each if the way along the valley
/// costs, by the curvature, no more than some times the limb's own part.
[[nodiscard]] std::vector<Eigen::VectorXd> valley_starts(const body::BodyModel& model,
                                                         const Eigen::VectorXd& q,
                                                         const LimbMinimum& limb);

}  // namespace myoid::body
