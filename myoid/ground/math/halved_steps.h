#pragma once

#include <Eigen/Core>

#include "myoid/ground/math/least_squares.h"

namespace myoid::inline ground::math {

/// Minimizes C(x) = 1/2 |r(x)|^2 without bounds by Gauss-Newton steps, each halved until the cost falls. `converged`:
/// the cost can fall no further, within 1e-12 of it or round-off. Throws InvalidInput if r or its Jacobian is not
/// finite at the start.
[[nodiscard]] LeastSquaresResult minimize_by_halved_steps(const LeastSquaresProblem& problem,
                                                          const Eigen::VectorXd& start);

}  // namespace myoid::inline ground::math
