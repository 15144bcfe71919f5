#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/intervals/uncertainty.h"

namespace myoid::identification {

/// The systematic error of the model, estimated from the residuals.
struct Discrepancy {
  /// Standard deviation of muscle errors, relative to the muscles' torques.
  double relative_size = 0.0;
  double joint_size = 0.0;     ///< Standard deviation of passive errors, relative to the torque's rms.
  Eigen::MatrixXd covariance;  ///< Addition to the estimates' covariance, in the solver's scale.
  /// A pair of sizes and its posterior probability; pairs below 1e-4 are left out.
  struct Sizes {
    double muscle = 0.0, joint = 0.0, probability = 0.0;
  };
  std::vector<Sizes> posterior;
  Eigen::VectorXd by_muscle, by_joint;  ///< Variance of each estimate for a size of 1.

  /// Returns the distance to either side of estimate j within which an error lies with this probability, where
  /// `variance` adds to the model's error. The distance is at most that of a normal error of the same total variance
  /// where the model may well be right: the variance is then that of rare large errors.
  [[nodiscard]] double reach(Eigen::Index j, double variance, double probability) const;
};

/// Estimates the systematic error of the model. No muscle equals its model: beside noise the residuals hold a part that
/// depends smoothly on posture, activation and speed (ErrorShapes). No amount of data averages this part out, and it
/// biases the estimates: a wrong moment arm becomes a wrong force-length curve. With shapes
/// S (k x n, after ErrorShapes::contrast), weights D and W = nu / s^2,
///
///   r = noise + S'x,   x ~ N(0, size^2 D^2),
///   h = S W r ~ N(0, C + size^2 C D^2 C),   C = S W S' - S W J' A^-1 J W S'
///
/// is the remainder after the fit. There are two sizes, of muscles and of joints. Each is 0 with a probability of one
/// half, else half normal 0.1 (0 without any shape). The result is the root of the mean square of the size over its
/// posterior. The estimates then err by A^-1 J W S'x, with covariance
///
///   size^2 (A^-1 J W S') D^2 (A^-1 J W S')'.
///
/// Kennedy & O'Hagan (2001), J R Stat Soc B 63:425-464, in linear form.
[[nodiscard]] Discrepancy discrepancy(const Estimator& estimator,
                                      const Estimator::Solution& solution,
                                      const Eigen::MatrixXd& model_based);

}  // namespace myoid::identification
