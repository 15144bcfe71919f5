#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/math/natural_basis.h"

namespace myoid::inline ground::math {

struct SplineValue {
  double value = 0.0;
  double first = 0.0;   ///< d/dt
  double second = 0.0;  ///< d2/dt2
};

/// Values and derivatives at many times.
struct SplineValues {
  Eigen::VectorXd value, first, second;
};

struct SmoothingOptions {
  /// Frequency [Hz] at which the spline passes 1/sqrt(2) of the amplitude, for evenly spaced samples.
  std::optional<double> cutoff_hz;
  /// Standard deviation of the noise in y's unit; the penalty is the largest whose residual does not exceed it.
  std::optional<double> noise_sd;
};

/// A natural spline of degree 2m - 1 (m = 1, 2, 3: linear, cubic, quintic) over strictly increasing, possibly uneven
/// knots. It minimizes sum (y_i - s(t_i))^2 + lambda * integral (s^(m))^2; with lambda = 0 it interpolates. At both
/// ends and beyond, s^(m) and all higher derivatives vanish: a quintic continues as a parabola, a cubic as a line.
/// Values there say nothing about the data.
class Spline {
 public:
  /// Returns the natural spline through the points; OpenSim's tools differentiate a motion by it
  /// (degree 5). Degree 1, 3 or 5; needs at least (degree + 1)/2 + 1 points. Throws InvalidInput if
  /// values are not finite, sizes differ or times do not strictly increase. O(n).
  [[nodiscard]] static Spline interpolate(const Eigen::Ref<const Eigen::VectorXd>& t,
                                          const Eigen::Ref<const Eigen::VectorXd>& y,
                                          int degree = 5);

  /// Returns the quintic smoothing spline. In the middle of evenly spaced data, with interval h, it
  /// passes a frequency f with the gain
  ///   1 / (1 + lambda h (2 pi f)^6).
  /// Exactly one option must be given. Throws like `interpolate`.
  [[nodiscard]] static Spline smooth(const Eigen::Ref<const Eigen::VectorXd>& t,
                                     const Eigen::Ref<const Eigen::VectorXd>& y,
                                     const SmoothingOptions& options);

  [[nodiscard]] SplineValue at(double t) const;
  [[nodiscard]] SplineValues evaluate(const Eigen::Ref<const Eigen::VectorXd>& t) const;

 private:
  friend class SplineKnots;
  Spline(const NaturalBasis& basis, const Eigen::VectorXd& g, const Eigen::VectorXd& c);

  Eigen::VectorXd knots_;
  Eigen::MatrixXd coefficients_;  ///< 2m x (n + 1): one column for each interval and for both
                                  ///< outsides, by increasing power of (t - left knot).
};

/// Splines of many columns over one clock: computations on the times alone are done once.
class SplineKnots {
 public:
  /// Throws as Spline::interpolate.
  explicit SplineKnots(const Eigen::Ref<const Eigen::VectorXd>& t, int degree = 5);
  /// Returns the natural spline through y at these times; throws if a value is not finite.
  [[nodiscard]] Spline interpolate(const Eigen::Ref<const Eigen::VectorXd>& y) const;

 private:
  NaturalBasis basis_;
  BandFactor system_;
};

}  // namespace myoid::inline ground::math
