#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

#include "myoid/fit/posterior/density.h"
#include "myoid/ground/core/progress.h"

namespace myoid::fit {

constexpr double kFinePromise = 1e-4;   ///< Promise of a mode that is reported, in ln density.
constexpr double kRoughPromise = 0.05;  ///< Promise that tells one mode from another.

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

inline constexpr const char* kFits = "fits the muscles";  ///< The step that a search tells.

/// Climbs from `start.x` by the quasi-Newton method of Broyden, Fletcher, Goldfarb and Shanno. The first inverse of the
/// second derivatives is `start.covariance`, or Gauss and Newton's where this is empty. Stops where a full step
/// promises less than `promise` of ln density; kFinePromise is tried with Gauss and Newton's second derivatives, too,
/// which may promise ten times as much. `covariance` is the search's; `add_curvature` replaces it and adds
/// `log_evidence`. Where `is_known`(x) the search gives up, not converged.
[[nodiscard]] Mode find_mode(const Density& density,
                             const Mode& start,
                             const Progress& progress,
                             double promise = kFinePromise,
                             const std::function<bool(const Eigen::VectorXd&)>& is_known = {});

/// Adds covariance and evidence from second derivatives: if `exact`, central differences of the
/// exact gradient over a third of a standard deviation, made symmetric, else Gauss and Newton's. A
/// direction in which the density does not fall gets a tenth of its Gauss-Newton curvature.
void add_curvature(const Density& density, bool exact, Mode& mode, const Progress& progress);

}  // namespace myoid::fit
