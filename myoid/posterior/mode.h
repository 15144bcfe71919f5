#pragma once

#include <string>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/posterior/density.h"

namespace myoid::identification {

constexpr double kFine = 1e-4;   ///< Promise of a mode that is reported, in ln density.
constexpr double kRough = 0.05;  ///< Promise that tells one mode from another.

/// The point of greatest density that a search found, and Laplace's approximation about it.
struct Mode {
  Eigen::VectorXd x;
  double log_density = 0.0;
  Eigen::MatrixXd covariance;  ///< Inverse of minus the second derivatives by x.
  /// Laplace's ln of the density's integral: weighs the fit against the model's freedom.
  double log_evidence = 0.0;
  bool converged = false;
  int iterations = 0;
  std::string message;
};

/// Climbs from `start` by the quasi-Newton method of Broyden, Fletcher, Goldfarb and Shanno with
/// Gauss and Newton's second derivatives at first. Stops where a full step promises less than
/// `promise` of ln density; one above kFine is believed without fresh second derivatives. Leaves
/// `covariance` and `log_evidence` to `add_curvature`.
[[nodiscard]] Mode find_mode(const Density& density,
                             const Eigen::VectorXd& start,
                             const Progress& progress,
                             double promise = kFine);

/// Adds covariance and evidence from second derivatives: if `exact`, central differences of the
/// exact gradient over a third of a standard deviation, made symmetric, else Gauss and Newton's. A
/// direction in which the density does not fall gets a tenth of its Gauss-Newton curvature.
void add_curvature(const Density& density, bool exact, Mode& mode, const Progress& progress);

}  // namespace myoid::identification
