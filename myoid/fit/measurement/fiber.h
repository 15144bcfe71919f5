#pragma once

#include <array>

#include <Eigen/Core>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/measurement/muscle_rows.h"
#include "myoid/fit/measurement/parameters.h"

namespace myoid::fit {

/// Length of a muscle's fibers and its partial derivatives.
struct Fiber {
  double length_m = 0.0;
  double by_force = 0.0;                             ///< By the tension [m/N]: the tendon's stretch.
  double by_length = 0.0;                            ///< By the musculotendon length, at the same tension.
  std::array<double, kMuscleFieldCount> by_field{};  ///< At the same tension.
};

/// Returns the fibers' length at a tension F >= 0 [N] and a musculotendon length [m], by the tendon of `tension`:
///
///   l cos(alpha) = l_mt - l_ts (1 + strain),   strain = e0 ln(1 + 5 F / F_max) / ln 6,   l sin(alpha) = l0 sin(alpha0)
///
/// A rigid tendon has no strain. Fibers without room beside the tendon stand across it.
[[nodiscard]] Fiber fiber(double force_n, double length_m, const MuscleValues& values);

/// Fibers of one muscle over n samples.
struct FiberRows {
  Eigen::VectorXd length_m;     ///< n
  Eigen::VectorXd by_force;     ///< n: by the tension [m/N].
  Eigen::VectorXd by_length;    ///< n: by the musculotendon length, at the same tension.
  Eigen::MatrixXd by_variable;  ///< v x n: by each of MuscleRows::variables, the tension's change with it [m].
};

/// Returns the fibers at the tension of `rows`, which has the derivatives by `of_muscle` first (evaluate_muscle).
[[nodiscard]] FiberRows fiber_rows(const MuscleRows& rows,
                                   const Eigen::Ref<const Eigen::VectorXd>& length_m,
                                   const MuscleValues& values,
                                   const std::vector<ParameterMap::Chain>& of_muscle);

}  // namespace myoid::fit
