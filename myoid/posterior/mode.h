#pragma once

#include <string>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/posterior/density.h"

namespace myoid::identification {

/// The greatest density that a search found, and Laplace's approximation about it.
struct Mode {
  Eigen::VectorXd x;
  double log_density = 0.0;
  Eigen::MatrixXd covariance;  ///< Of x: inverse of minus the second derivatives.
  /// ln of the integral of the density by Laplace: what the data and the model's freedom weigh.
  double log_evidence = 0.0;
  bool converged = false;
  int iterations = 0;
  std::string message;
};

/// Climbs from `start` by the quasi-Newton method of Broyden, Fletcher, Goldfarb and Shanno, its
/// first second derivatives those of Gauss and Newton, and stops where a full step promises less
/// than 1e-4 of ln density. `covariance` and `log_evidence` are left for `add_curvature`.
[[nodiscard]] Mode find_mode(const Density& density,
                             const Eigen::VectorXd& start,
                             const Progress& progress);

/// Second derivatives by central differences of the exact gradient over a third of a standard
/// deviation, symmetric; a direction in which the density does not fall gets the curvature of a
/// tenth of its Gauss-Newton value.
void add_curvature(const Density& density, Mode& mode, const Progress& progress);

}  // namespace myoid::identification
