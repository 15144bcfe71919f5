#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/ground/core/progress.h"

namespace myoid::body {

/// The length of one muscle as a polynomial of the coordinates that move it:
///
///   l(q) = sum_k c_k prod_i T_{e_ki}(x_i),   x_i = (2 q_i - lower_i - upper_i) / (upper_i -
///   lower_i)
///
/// with Chebyshev polynomials T, summed over all exponents with sum_i e_ki <= degree. Moment arms
/// are the exact derivatives, r_i = -dl/dq_i. With couplers q are the independent coordinates, and
/// r_i includes the motion of the dependent coordinates.
struct PathSurrogate {
  std::string muscle;
  std::vector<int> coordinates;  ///< Indices in the model; none: the length is constant.
  Eigen::VectorXd lower, upper;  ///< Range of the fit [rad | m].
  std::vector<int> held;         ///< Coordinates that change the path and were held (locked ones).
  Eigen::VectorXd held_at;       ///< Their values.
  int degree = 0;
  Eigen::VectorXd coefficient_m;  ///< In the order of `exponents(coordinates, degree)`.
  /// Greatest and root mean square errors at postures outside of the fit.
  double length_error_m = 0.0, length_rms_m = 0.0;
  double arm_error_m = 0.0, arm_rms_m = 0.0;
  bool within_tolerance = false;
};

struct SurrogateOptions {
  double length_tolerance_m = 2e-4;
  double arm_tolerance_m = 1e-3;
  int max_degree = 9;
  int max_terms = 500;  ///< Limit for one muscle; keeps the degree low if many coordinates act.
  std::uint64_t seed = 1;
  Progress progress;
};

/// Returns the exponents of the terms, one row each, in order of their sum: terms x coordinates.
[[nodiscard]] Eigen::MatrixXi exponents(int coordinates, int degree);

/// Returns the coordinates that may change the path: those of the joints between its bodies and of its moving and
/// conditional points, with dependent ones replaced by the coordinates that drive them.
[[nodiscard]] std::vector<int> acting_coordinates(const body::BodyModel& model, const body::MusclePath& path);

/// Fits one surrogate per muscle, in the model's order and the mode of `model.compat`: length and moment arms together
/// by least squares at Sobol points of the coordinates' ranges (at most 3 rad or 1 m to either side of the default),
/// with locked coordinates at their default. The degree rises from 1 until both greatest errors are within tolerance;
/// otherwise the best degree stays and is marked. No polynomial follows a path that jumps. Parallel over muscles, with
/// equal results for every number of threads.
[[nodiscard]] std::vector<PathSurrogate> fit_surrogates(const body::BodyModel& model,
                                                        const SurrogateOptions& options = {});

/// Space for `evaluate`, reused without allocation for muscles of one degree and one number of
/// coordinates; one per thread.
struct SurrogateWorkspace {
  Eigen::MatrixXd value, slope;  ///< Chebyshev polynomials and derivatives: degree x coordinate.
  Eigen::MatrixXi exponents;
  std::vector<Eigen::Index> nested;  ///< The terms in the order of their exponents, last fastest.
  Eigen::MatrixXd sums;              ///< Per coordinate: a sum and its derivatives.
  int degree = -1, dimensions = -1;
};

/// Returns true if q lies in the range of the fit, held coordinates have their values (1e-12), and
/// dependent coordinates obey their couplers (1e-6).
[[nodiscard]] bool covers(const body::BodyModel& model,
                          const PathSurrogate& surrogate,
                          const Eigen::Ref<const Eigen::VectorXd>& q);

/// Computes length, moment arms (zero for coordinates that do not act) and speed of the polynomial.
void evaluate(const PathSurrogate& surrogate,
              const Eigen::Ref<const Eigen::VectorXd>& q,
              const Eigen::Ref<const Eigen::VectorXd>& qdot,
              SurrogateWorkspace& workspace,
              body::PathResult& result);

}  // namespace myoid::body
