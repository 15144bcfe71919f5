#pragma once

#include <Eigen/Core>

#include "myoid/math/least_squares.h"

namespace myoid::identification {

/// Minimizes C(x) = 1/2 |r(x)|^2 without bounds by Gauss-Newton steps, each halved until the cost falls. `converged`:
/// the cost can fall no further, within 1e-12 of it or round-off. Throws InvalidInput if r or its Jacobian is not
/// finite at the start, Interrupted if `progress` says so.
[[nodiscard]] math::LeastSquaresResult minimize_by_halved_steps(const math::LeastSquaresProblem& problem,
                                                                const Eigen::VectorXd& start,
                                                                const Progress& progress = {});

}  // namespace myoid::identification
